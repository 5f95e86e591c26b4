#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/not_finite.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// Values that span more than this factor are on a logarithmic axis.
inline constexpr double kWideSpan = 20.0;

/// A method's row.
struct MethodValue {
  std::string label = {};
  std::string key = {};           ///< [a-z0-9-]+, unique in its panel.
  std::size_t series = 0;         ///< See series_style().
  double value = kNaN;            ///< A method without a finite one has no row.
  std::vector<double> runs = {};  ///< What `value` is the median of; empty: they are not shown.
};

struct ValueDotsPanel {
  std::string title = {};
  std::vector<MethodValue> methods = {};
};

struct ValueDotsSpec {
  std::string id = {};  ///< [a-z][a-z0-9-]*.
  std::string title = {};
  std::string caption = {};
  std::string x_label = {};  ///< "MPE [m]".
  std::string unit = {};     ///< Of the values.
  bool higher_is_better = false;
  bool great_errors = true;  ///< As of ErrorLinesSpec.
  std::vector<ValueDotsPanel> panels = {};
  std::vector<std::string> record_ids = {};
};

/// Values of methods as dots, a row each, the best one uppermost; small circles for the runs. The
/// axis is logarithmic where the values span widely. Of what diverged see curves/diverged.hpp.
Figure value_dots_figure(const ValueDotsSpec& spec);

}  // namespace mapproof
