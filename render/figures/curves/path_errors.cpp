#include "render/figures/curves/path_errors.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/base/span.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/curves/thinning.hpp"
#include "render/figures/maps/path_styles.hpp"
#include "render/figures/words.hpp"

namespace mapproof {
namespace {

constexpr int kBins = 300;         // Over the time: some two pixels each.
constexpr double kLogFrom = 30.0;  // Greatest over least error from which the axis is logarithmic.
constexpr double kLeastShare = 0.02;  // Of each method's errors that may lie below a log axis.

/// Errors of one record that are numbers, ascending.
std::vector<double> sorted_errors(const SlamRecord& record) {
  std::vector<double> errors;
  for (const double error : record.error_m)
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
  const std::string label(info(record.method).label);
  if (record.errors.empty()) return label;
  const TrajectoryError& error = record.errors.front();
  return fmt::format("{}: {} m, {}", label, significant(error.mean_m, 2),
                     alignment_words(error.alignment));
}

Polyline error_line(const SlamRecord& record, const ErrorAxis& axis, double start_s) {
  ThinLine thin = thin_curve(record.estimate.path.time_s, record.error_m, kBins);
  for (double& time : thin.x) time -= start_s;
  const Marker marker = thin.x.size() == 1 ? Marker::kCircle : Marker::kNone;
  const PathStyle style = path_style(record.method);
  return {.label = label_with_error(record),
          .x = std::move(thin.x),
          .y = axis.raised(std::move(thin.y)),
          .ink = style.ink,
          .dash = style.dash,
          .width = 0.8,
          .marker = marker,
          .mark = {fmt::format("error-{}", info(record.method).name),
                   {{"path", std::string(info(record.method).label)}}}};
}

/// The root of the trace of a position's covariance: the RMS error that it makes one expect.
Polyline expected_line(const SlamRecord& record, const ErrorAxis& axis, double start_s) {
  const PathStyle style = path_style(record.method);
  Polyline line{.label = "expected by the covariance",
                .ink = style.ink,
                .dash = Dash::kDotted,
                .width = 0.9,
                .mark = {fmt::format("expected-{}", info(record.method).name), {}}};
  const SlamEstimate& estimate = record.estimate;
  for (std::size_t i = 0; i < estimate.position_cov_m2.size(); ++i) {
    const double variance_m2 = estimate.position_cov_m2[i].trace();
    line.x.push_back(estimate.path.time_s(estimate.position_cov_rows[i]) - start_s);
    line.y.push_back(variance_m2 >= 0.0 && std::isfinite(variance_m2) ? std::sqrt(variance_m2)
                                                                      : NAN);
  }
  line.y = axis.raised(std::move(line.y));
  return line;
}

}  // namespace

std::optional<Panel> path_error_panel(std::span<const SlamRecord* const> records) {
  std::vector<const SlamRecord*> judged;
  for (const SlamRecord* record : records)
    if (!sorted_errors(*record).empty()) judged.push_back(record);
  if (judged.empty()) return std::nullopt;
  const ErrorAxis axis = axis_of(judged);
  const double start_s = first_time(judged);
  Panel panel;
  panel.x.label = "time [s]";
  panel.y = {.label = "error [m]", .scale = axis.scale, .limits = axis.limits};
  for (const SlamRecord* record : judged)
    panel.layers.push_back(error_line(*record, axis, start_s));
  for (const SlamRecord* record : judged)
    panel.layers.push_back(expected_line(*record, axis, start_s));
  std::erase_if(panel.layers, is_empty);
  return panel;
}

}  // namespace mapproof
