#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/figures/curves/error_lines.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// A line of the slope that theory predicts, to be compared by eye: a little above the data.
struct SlopeGuide {
  std::string label;  ///< "slope −1/2".
  double slope = 0.0;
};

struct LogLogPanel {
  std::string title;
  std::string x_label;  ///< With its unit.
  std::string y_label;
  std::vector<ErrorLine>
      lines;  ///< Their intervals are drawn as bars; `key` is unique in the figure.
  std::optional<SlopeGuide> guide;
  std::vector<ErrorLine> bounds;  ///< Drawn dashed, without markers: what theory allows.
};

struct LogLogSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::string caption;
  std::vector<LogLogPanel> panels;
  std::vector<std::string> record_ids;
  std::vector<Note> notes;
  bool varies = false;
  std::size_t columns = 0;  ///< As Figure::columns.
};

/// Slope of log y over log x by least squares over the points where both are positive; NaN below
/// two different x.
double log_log_slope(const std::vector<double>& x, const std::vector<double>& y);

/// A slope in words: "−0.49" with a true minus; "unknown" if it is none.
std::string slope_words(double slope);

/// Panels with two logarithmic axes each; values that are not positive are left out, and bars that
/// reach to zero, or to less than a third of all means, end in arrows at the frame. The alt text
/// gives each line's ends and its slope.
/// @throws InvalidInput if a line's vectors disagree in length.
Figure log_log_figure(const LogLogSpec& spec);

}  // namespace mapproof
