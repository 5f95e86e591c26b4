#pragma once

#include <string>
#include <vector>

#include "render/figures/curves/error_lines.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

struct ErrorCurveSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::string y_label = "MPE [m]";
  std::string quantity = "mean position error";  ///< In words, for the alt text.
  std::vector<ErrorLine> curves;                 ///< `x` holds the number of observations.
  std::string caption;                           ///< Empty: one is made.
  std::vector<std::string> record_ids;
};

/// Mean error over steps, a line with a 95 % band for each curve.
/// @throws InvalidInput as error_lines_figure.
Figure error_curve_figure(const ErrorCurveSpec& spec);

}  // namespace mapproof
