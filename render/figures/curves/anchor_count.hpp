#pragma once

#include <string>
#include <vector>

#include "render/figures/curves/error_lines.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// One sensor's or method's part: one line per way to place the anchors, `x` their number.
struct AnchorPanel {
  std::string title;
  std::vector<ErrorLine> placements;
};

struct AnchorCountSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::string y_label = "MPE [m]";
  std::string quantity = "mean position error";
  std::vector<AnchorPanel> panels;
  std::vector<std::string> record_ids;
};

/// Error over the number of anchors, a line with its 95 % band a placement.
/// @throws InvalidInput as error_lines_figure.
Figure anchor_count_figure(const AnchorCountSpec& spec);

}  // namespace mapproof
