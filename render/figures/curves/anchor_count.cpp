#include "render/figures/curves/anchor_count.hpp"

#include <fmt/format.h>

namespace mapproof {

Figure anchor_count_figure(const AnchorCountSpec& spec) {
  ErrorLinesSpec lines;
  lines.id = spec.id;
  lines.title = spec.title;
  lines.y_label = spec.y_label;
  lines.quantity = spec.quantity;
  lines.record_ids = spec.record_ids;
  lines.caption = fmt::format(
      "Lines: {} over the number of anchors, mean over runs, one line per way to place them; "
      "bands: "
      "its 95 % interval.",
      spec.quantity);
  for (const AnchorPanel& from : spec.panels) {
    ErrorPanel& panel = lines.panels.emplace_back();
    panel.title = from.title;
    panel.x.label = "number of anchors";
    panel.x.whole = true;
    panel.lines = from.placements;
  }
  return error_lines_figure(lines);
}

}  // namespace mapproof
