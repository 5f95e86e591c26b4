#include "render/figures/diagrams/value_dots.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "render/base/span.hpp"
#include "render/figures/curves/diverged.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/layer_shapes.hpp"

namespace mapproof {
namespace {

constexpr double kSizeAmongRuns = 1.5;
constexpr double kIntervalWidth = 2.5;

/// Those with a value, the uppermost one last: row 0 is lowest.
std::vector<MethodValue> rows_of(const ValueDotsPanel& panel, const ValueDotsSpec& spec) {
  std::vector<MethodValue> rows;
  for (const MethodValue& method : panel.methods)
    if (std::isfinite(method.value)) rows.push_back(method);
  if (!spec.ranked)
    std::ranges::reverse(rows);
  else if (spec.higher_is_better)
    std::ranges::stable_sort(rows, std::less<>(), &MethodValue::value);
  else
    std::ranges::stable_sort(rows, std::greater<>(), &MethodValue::value);
  return rows;
}

/// Calls `visit` with the row's label and the value, for each run of the figure, and for each value
/// without runs.
template <typename Visit>
void for_each_run(const ValueDotsSpec& spec, const Visit& visit) {
  for (const ValueDotsPanel& panel : spec.panels)
    for (const MethodValue& method : panel.methods) {
      for (const double run : method.runs) visit(method.label, run);
      if (method.runs.empty()) visit(method.label, method.value);
    }
}

double divergence_of(const ValueDotsSpec& spec) {
  return divergence_in(spec.unit, spec.great_errors);
}

/// What all panels have in common.
struct SharedAxis {
  Scale scale = Scale::kLinear;
  DotAxis dots;
};

SharedAxis axis_of(const ValueDotsSpec& spec) {
  std::vector<double> values;
  for_each_run(spec, [&](const std::string& /*label*/, double run) { values.push_back(run); });
  for (const ValueDotsPanel& panel : spec.panels)
    for (const MethodValue& method : panel.methods)
      if (method.interval)
        values.insert(values.end(), {method.interval->low, method.interval->high});
  Span span;
  span.see(without_diverged(values, divergence_of(spec)));
  const bool is_wide = span.known() && span.low > 0.0 && span.high > kWideSpan * span.low;
  const Scale scale = is_wide ? Scale::kLog : Scale::kLinear;
  SharedAxis axis{scale, dot_axis(values, scale, divergence_of(spec))};
  if (spec.x_limits) axis.dots.limits = spec.x_limits;
  return axis;
}

/// The interval of a row that is on the axis as a whole; equal values have none.
Segments interval_of(const MethodValue& method, double y, const DotAxis& axis) {
  Segments bar{.colour = series_style(method.series).colour, .width = kIntervalWidth};
  if (!method.interval || !(method.interval->low < method.interval->high) ||
      method.interval->high > axis.ceiling)
    return bar;
  add_line(bar, {method.interval->low, y}, {method.interval->high, y});
  bar.marks.push_back({"", {{"method", method.label}, {"kind", "interval"}}});
  return bar;
}

/// The runs of a row that are on the axis.
Scatter runs_of(const MethodValue& method, double y, const DotAxis& axis) {
  Scatter runs{.colour = series_style(method.series).colour,
               .marker = Marker::kCircle,
               .filled = false,
               .size = 0.7};
  for (const double run : method.runs) {
    if (!std::isfinite(run) || run > axis.ceiling) continue;
    add_point(runs, {run, y});
    runs.marks.push_back(
        {"", {{"method", method.label}, {"kind", "single runs"}, {"x", data_number(run)}}});
  }
  return runs;
}

/// The value of a row, or the triangle that stands for one that diverged.
Scatter value_of(const MethodValue& method, double y, const DotAxis& axis, const std::string& id) {
  const SeriesStyle style = series_style(method.series);
  const bool diverged = method.value > axis.ceiling;
  Scatter value = diverged ? diverged_dots(style.colour)
                           : Scatter{.colour = style.colour,
                                     .marker = style.marker,
                                     .size = method.runs.empty() ? 1.0 : kSizeAmongRuns};
  add_point(value, {axis.place_of(method.value), y});
  value.marks.push_back(
      {id,
       {{"method", method.label}, {"x", diverged ? kGreatErrorText : data_number(method.value)}}});
  return value;
}

/// A triangle for the runs of a row that diverged, unless that of its value stands for them, too.
Scatter diverged_runs_of(const MethodValue& method, double y, const DotAxis& axis) {
  Scatter runs = diverged_dots(series_style(method.series).colour);
  const auto has_diverged = [&](double value) { return value > axis.ceiling; };
  if (has_diverged(method.value) || std::ranges::none_of(method.runs, has_diverged)) return runs;
  add_point(runs, {axis.end, y});
  runs.marks.push_back(
      {"", {{"method", method.label}, {"kind", "single runs"}, {"x", kGreatErrorText}}});
  return runs;
}

/// @param prefix  Of the ids of marks.
Panel panel_of(const ValueDotsPanel& from, const ValueDotsSpec& spec, const SharedAxis& axis,
               const std::string& prefix) {
  Panel panel;
  panel.title = from.title;
  panel.x = {.label = spec.x_label, .scale = axis.scale, .limits = axis.dots.limits};
  const std::vector<MethodValue> rows = rows_of(from, spec);
  panel.y.limits = Range{-0.6, std::max(1.0, static_cast<double>(rows.size())) - 0.4};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const MethodValue& method = rows[i];
    const double y = static_cast<double>(i);
    panel.y.names.push_back(method.label);
    panel.layers.emplace_back(interval_of(method, y, axis.dots));
    panel.layers.emplace_back(runs_of(method, y, axis.dots));
    panel.layers.emplace_back(diverged_runs_of(method, y, axis.dots));
    panel.layers.emplace_back(value_of(method, y, axis.dots, prefix + method.key));
  }
  std::erase_if(panel.layers, is_empty);
  return panel;
}

/// How many runs of each method diverged.
std::vector<DivergedCount> count_diverged(const ValueDotsSpec& spec) {
  std::vector<DivergedCount> counts;
  for_each_run(spec, [&](const std::string& label, double run) {
    auto count = std::ranges::find(counts, label, &DivergedCount::label);
    if (count == counts.end()) count = counts.insert(count, {.label = label});
    count->see(run, divergence_of(spec));
  });
  return counts;
}

std::string alt_of(const ValueDotsSpec& spec) {
  std::string text = spec.title + ".";
  for (const ValueDotsPanel& panel : spec.panels) {
    std::vector<MethodValue> rows = rows_of(panel, spec);
    std::ranges::reverse(rows);
    text += panel.title.empty() ? "" : " " + panel.title + ":";
    for (const MethodValue& method : rows)
      text +=
          fmt::format(" {} {};", method.label,
                      method.value > divergence_of(spec) ? kGreatErrorText
                                                         : quantity_text(method.value, spec.unit));
    if (rows.empty()) text += " nothing;";
    text.back() = '.';
  }
  return text;
}

}  // namespace

Figure value_dots_figure(const ValueDotsSpec& spec) {
  Figure figure{.id = spec.id,
                .title = spec.title,
                .caption = spec.caption,
                .alt = alt_of(spec),
                .record_ids = spec.record_ids,
                .notes = {},
                .panels = {}};
  note_diverged(count_diverged(spec), "in", "runs", figure.notes);
  const SharedAxis axis = axis_of(spec);
  for (std::size_t i = 0; i < spec.panels.size(); ++i) {
    const std::string prefix =
        spec.panels.size() == 1 ? "value-" : fmt::format("panel-{}-value-", i + 1);
    figure.panels.push_back(panel_of(spec.panels[i], spec, axis, prefix));
  }
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
