#include "render/figures/curves/error_curve.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "render/base/span.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/curves/thinning.hpp"
#include "render/figures/maps/path_styles.hpp"

namespace mapproof {
namespace {

constexpr int kBins = 80;          // Over the time; an error goes up and down in each.
constexpr double kLogFrom = 30.0;  // Greatest over least error from which the axis is logarithmic.
constexpr double kLeastShare = 0.02;  // Of each method's medians that may lie below a log axis.

ThinLine median_of(const SlamRecord& record) {
  return median_curve(record.estimate.path.time_s, record.error_m, kBins);
}

/// What is drawn of a record's errors, ascending.
std::vector<double> sorted_errors(const SlamRecord& record) {
  std::vector<double> errors;
  for (const double error : median_of(record).y)
    if (std::isfinite(error)) errors.push_back(error);
  std::ranges::sort(errors);
  return errors;
}

/// A few tiny errors, such as that of a given start, do not stretch the axis.
ErrorAxis axis_of(std::span<const SlamRecord* const> records) {
  std::vector<double> ends;
  for (const SlamRecord* record : records) {
    const std::vector<double> errors = sorted_errors(*record);
    if (errors.empty()) continue;
    ends.push_back(
        errors[static_cast<std::size_t>(kLeastShare * static_cast<double>(errors.size()))]);
    ends.push_back(errors.back());
  }
  return error_axis(ends, {}, kLogFrom);
}

double first_time(std::span<const SlamRecord* const> records) {
  Span times;
  for (const SlamRecord* record : records)
    if (record->estimate.path.size() > 0) times.see(record->estimate.path.time_s(0));
  return times.known() ? times.low : 0.0;
}

std::string label_with_error(const SlamRecord& record) {
  std::string label(info(record.method).label);
  if (record.errors.empty()) return label;
  const TrajectoryError& error = record.errors.front();
  return fmt::format("{}: {}, {}", label, error_text(error.mean_m),
                     alignment_words(error.alignment));
}

Polyline error_line(const SlamRecord& record, const ErrorAxis& axis, double start_s) {
  ThinLine thin = median_of(record);
  for (double& time : thin.x) time -= start_s;
  const Marker marker = thin.x.size() == 1 ? Marker::kCircle : Marker::kNone;
  const PathStyle style = path_style(record.method);
  return {.label = label_with_error(record),
          .x = std::move(thin.x),
          .y = axis.raised(std::move(thin.y)),
          .colour = style.colour,
          .dash = style.dash,
          .width = 1.2,
          .marker = marker,
          .mark = {fmt::format("error-{}", info(record.method).name),
                   {{"curve", label_with_error(record)}}}};
}

/// The root of the trace of a position's covariance: the RMS error that it makes one expect.
Polyline expected_line(const SlamRecord& record, const ErrorAxis& axis, double start_s) {
  const PathStyle style = path_style(record.method);
  Polyline line{.label = "expected by the covariance",
                .colour = style.colour,
                .dash = Dash::kDotted,
                .width = 0.9,
                .mark = {fmt::format("expected-{}", info(record.method).name),
                         {{"curve", "expected by the covariance"}}}};
  const SlamEstimate& estimate = record.estimate;
  for (std::size_t i = 0; i < estimate.position_cov_m2.size(); ++i) {
    const double variance_m2 = estimate.position_cov_m2[i].trace();
    line.x.push_back(estimate.path.time_s(estimate.position_cov_rows[i]) - start_s);
    line.y.push_back(variance_m2 >= 0.0 && std::isfinite(variance_m2) ? std::sqrt(variance_m2)
                                                                      : kNaN);
  }
  line.y = axis.raised(std::move(line.y));
  return line;
}

/// The error at the parameter, from the line if the value has none; NaN if neither knows.
double error_at(const ParameterValue& value, const ErrorLine& line) {
  if (std::isfinite(value.error)) return value.error;
  for (std::size_t i = 0; i < line.x.size() && i < line.mean.size(); ++i)
    if (line.x[i] == value.parameter) return line.mean[i];
  return kNaN;
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

std::string ends_of(const ErrorLine& curve) {
  const auto known = [](double value) { return std::isfinite(value); };
  const auto first = std::ranges::find_if(curve.mean, known);
  if (first == curve.mean.end()) return fmt::format(" {}: nothing known.", curve.label);
  const auto last = std::find_if(curve.mean.rbegin(), curve.mean.rend(), known);
  const auto step = [&curve](std::ptrdiff_t position) { return data_number(curve.x[position]); };
  return fmt::format(" {}: {} at {}, {} at {}.", curve.label, significant(*first),
                     step(first - curve.mean.begin()), significant(*last),
                     step(curve.mean.rend() - last - 1));
}

std::string alt_text(const ErrorCurveSpec& spec, Scale scale) {
  std::string text = fmt::format("{}: {} over observations, {}, {} axis. Mean over runs.",
                                 spec.y_label, spec.quantity, counted(spec.curves.size(), "curve"),
                                 scale == Scale::kLog ? "logarithmic" : "linear");
  for (const ErrorLine& curve : spec.curves) text.append(ends_of(curve));
  return text;
}

}  // namespace

std::optional<Panel> path_error_panel(std::span<const SlamRecord* const> records) {
  std::vector<const SlamRecord*> judged;
  for (const SlamRecord* record : records)
    if (std::ranges::any_of(record->error_m, [](double error) { return std::isfinite(error); }))
      judged.push_back(record);
  if (judged.empty()) return std::nullopt;
  const ErrorAxis axis = axis_of(judged);
  const double start_s = first_time(judged);
  Panel panel;
  panel.x.label = "time [s]";
  panel.y = {.label = "median error [m]", .scale = axis.scale, .limits = axis.limits};
  for (const SlamRecord* record : judged)
    panel.layers.push_back(error_line(*record, axis, start_s));
  for (const SlamRecord* record : judged)
    panel.layers.push_back(expected_line(*record, axis, start_s));
  std::erase_if(panel.layers, is_empty);
  return panel;
}

Figure anchor_count_figure(const AnchorCountSpec& spec) {
  ErrorLinesSpec lines;
  lines.id = spec.id;
  lines.title = spec.title;
  lines.y_label = spec.y_label;
  lines.quantity = spec.quantity;
  lines.record_ids = spec.record_ids;
  lines.over = " over the number of anchors";
  lines.remark = " There is one line per layout of the anchors.";
  for (const AnchorPanel& from : spec.panels) {
    ErrorPanel& panel = lines.panels.emplace_back();
    panel.title = from.title;
    panel.x.label = "number of anchors";
    panel.x.whole = true;
    panel.lines = from.placements;
  }
  return error_lines_figure(lines);
}

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
  lines.remark =
      " Large open circles: our optimum; open squares: the paper's optimum and its printed value.";
  return error_lines_figure(lines);
}

Figure error_curve_figure(const ErrorCurveSpec& spec) {
  ErrorLinesSpec lines;
  lines.id = spec.id;
  lines.title = spec.title;
  lines.y_label = spec.y_label;
  lines.quantity = spec.quantity;
  lines.caption = spec.caption;
  lines.record_ids = spec.record_ids;
  ErrorPanel& panel = lines.panels.emplace_back();
  panel.x.label = "observations (steps)";
  panel.lines = spec.curves;
  Figure figure = error_lines_figure(lines);
  figure.alt = alt_text(spec, figure.panels.front().y.scale);
  return figure;
}

}  // namespace mapproof
