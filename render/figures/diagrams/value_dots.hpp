#pragma once

#include <cstddef>
#include <optional>
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
  std::vector<double> runs = {};  ///< Of which `value` is the middle; empty: they are not shown.
  std::optional<Range> interval = {};  ///< That of `value` at 95 %, a bar behind it.
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
  bool ranked = true;        ///< The best row is uppermost; else the first one.
  bool great_errors = true;  ///< As of ErrorLinesSpec.
  std::optional<Range> x_limits = {};  ///< Empty: what the values need.
  std::vector<ValueDotsPanel> panels = {};
  std::vector<std::string> record_ids = {};
};

/// Values of methods as dots, a row each; small circles for the runs, bars for the intervals. The
/// axis is logarithmic where the values span widely. Of what diverged see curves/diverged.hpp.
Figure value_dots_figure(const ValueDotsSpec& spec);

}  // namespace mapproof
