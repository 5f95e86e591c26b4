#include "render/figures/curves/level_curve.hpp"

namespace mapproof {

Figure level_curve_figure(const LevelCurveSpec& spec) {
  ErrorLinesSpec lines;
  lines.id = spec.id;
  lines.title = spec.title;
  lines.y_label = spec.y_label;
  lines.quantity = spec.quantity;
  lines.record_ids = spec.record_ids;
  lines.over = " over " + spec.x_label;
  lines.remark = spec.remark;
  lines.has_runs = spec.has_runs;
  lines.log_from = spec.log_from;
  lines.great_errors = spec.great_errors;
  ErrorPanel& panel = lines.panels.emplace_back();
  panel.x.label = spec.x_label;
  panel.x.scale = spec.x_scale;
  panel.lines = spec.methods;
  panel.points = spec.points;
  return error_lines_figure(lines);
}

}  // namespace mapproof
