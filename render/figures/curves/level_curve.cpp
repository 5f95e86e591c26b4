#include "render/figures/curves/level_curve.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace mapproof {

Figure level_curve_figure(const LevelCurveSpec& spec) {
  ErrorLinesSpec lines;
  lines.id = spec.id;
  lines.title = spec.title;
  lines.y_label = spec.y_label;
  lines.quantity = spec.quantity;
  lines.record_ids = spec.record_ids;
  const bool banded =
      std::ranges::any_of(spec.methods, [](const ErrorLine& line) { return !line.low.empty(); });
  lines.caption = fmt::format("Lines: {} over {}, mean over runs{}", spec.quantity, spec.x_label,
                              banded ? "; bands: its 95 % interval." : ".");
  lines.log_from = spec.log_from;
  ErrorPanel& panel = lines.panels.emplace_back();
  panel.x.label = spec.x_label;
  panel.x.scale = spec.x_scale;
  panel.lines = spec.methods;
  return error_lines_figure(lines);
}

}  // namespace mapproof
