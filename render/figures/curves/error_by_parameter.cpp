#include "render/figures/curves/error_by_parameter.hpp"

#include <cmath>

#include <fmt/format.h>

#include "render/figures/words.hpp"

namespace mapproof {
namespace {

/// The error at the parameter, from the line if the value has none; NaN if neither knows.
double error_at(const ParameterValue& value, const ErrorLine& line) {
  if (std::isfinite(value.error)) return value.error;
  for (std::size_t i = 0; i < line.x.size() && i < line.mean.size(); ++i)
    if (line.x[i] == value.parameter) return line.mean[i];
  return NAN;
}

void add_optimum(ErrorPanel& panel, const ErrorLine& line,
                 const std::optional<ParameterValue>& value, const std::string& label,
                 Marker marker) {
  if (!value) return;
  const double error = error_at(*value, line);
  if (std::isfinite(error))
    panel.points.push_back({label, line.label, value->parameter, error, marker});
}

/// "SDE: 0.167 at K = 5, in the paper 0.138 at K = 7."
std::string words_of(const ParameterGroup& group, const ParameterLine& method) {
  const auto at = [&](const ParameterValue& value) {
    return fmt::format("{} at {} = {}", significant(error_at(value, method.line)), group.symbol,
                       data_number(value.parameter));
  };
  std::string text = " " + method.line.label + ":";
  if (method.ours) text += " " + at(*method.ours);
  if (!method.ours) text += " no optimum known";
  if (method.published) text += ", in the paper " + at(*method.published);
  return text + ".";
}

}  // namespace

Figure error_by_parameter_figure(const ErrorByParameterSpec& spec) {
  ErrorLinesSpec lines;
  lines.id = spec.id;
  lines.title = spec.title;
  lines.y_label = spec.y_label;
  lines.quantity = spec.quantity;
  lines.log_from = 6.0;  // The methods of one panel would else lie on each other.
  lines.record_ids = spec.record_ids;
  lines.ceiling = spec.ceiling;
  lines.alt = fmt::format("{} over each method's parameter, mean over runs. Least:", spec.y_label);
  for (const ParameterGroup& group : spec.groups) {
    ErrorPanel& panel = lines.panels.emplace_back();
    panel.title = spec.groups.size() > 1 ? group.title : "";
    panel.x.label = group.symbol;
    panel.x.scale = group.scale;
    panel.x.whole = group.whole;
    for (const ParameterLine& method : group.methods) {
      panel.lines.push_back(method.line);
      lines.alt += words_of(group, method);
    }
    // The paper's below ours, so that both are seen where they agree.
    for (const ParameterLine& method : group.methods)
      add_optimum(panel, method.line, method.published, "the paper's optimum", Marker::kSquare);
    for (const ParameterLine& method : group.methods)
      add_optimum(panel, method.line, method.ours, "our optimum", Marker::kCircle);
  }
  lines.caption = fmt::format(
      "Lines: {}, mean over runs; bands: its 95 % interval. Large open circles: our optimum; open "
      "squares: the paper's optimum and its printed value.",
      spec.quantity);
  return error_lines_figure(lines);
}

}  // namespace mapproof
