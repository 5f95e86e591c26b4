#pragma once

#include <string>
#include <vector>

#include "render/figures/curves/error_lines.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

struct LevelCurveSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::string x_label;  ///< With its unit: "bearing noise [°]", "missing entries [%]".
  Scale x_scale = Scale::kLinear;
  std::string y_label = "MPE [m]";
  std::string quantity = "mean position error";
  std::vector<ErrorPoint> points = {};  ///< Such as single runs.
  std::string remark = {};              ///< As of ErrorLinesSpec.
  bool has_runs = true;                 ///< As of ErrorLinesSpec.
  std::vector<ErrorLine> methods;       ///< `x` holds the level.
  std::vector<std::string> record_ids;
  double log_from = 20.0;    ///< As in ErrorLinesSpec.
  bool great_errors = true;  ///< As in ErrorLinesSpec.
};

/// Error over the level of a disturbance, a line with its 95 % band a method.
/// @throws InvalidInput as error_lines_figure.
Figure level_curve_figure(const LevelCurveSpec& spec);

}  // namespace mapproof
