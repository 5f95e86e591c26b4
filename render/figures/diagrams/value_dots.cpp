#include "render/figures/diagrams/value_dots.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/number_text.hpp"
#include "render/base/span.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/layer_shapes.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLongestName = 30;  ///< Characters on an axis; the rest of a name is cut.
constexpr double kSizeAmongRuns = 1.5;

/// Those with a value, the best one last: row 0 is lowest.
std::vector<MethodValue> rows_of(const ValueDotsPanel& panel, bool higher_is_better) {
  std::vector<MethodValue> rows;
  for (const MethodValue& method : panel.methods)
    if (std::isfinite(method.value)) rows.push_back(method);
  if (higher_is_better)
    std::ranges::stable_sort(rows, std::less<>(), &MethodValue::value);
  else
    std::ranges::stable_sort(rows, std::greater<>(), &MethodValue::value);
  return rows;
}

Scale scale_of(const ValueDotsSpec& spec) {
  Span span;
  for (const ValueDotsPanel& panel : spec.panels)
    for (const MethodValue& method : panel.methods) {
      span.see(method.value);
      span.see(method.runs);
    }
  const bool is_wide = span.known() && span.low > 0.0 && span.high > kWideSpan * span.low;
  return is_wide ? Scale::kLog : Scale::kLinear;
}

/// @param prefix  Of the ids of marks.
Panel panel_of(const ValueDotsPanel& from, const ValueDotsSpec& spec, const std::string& prefix) {
  Panel panel;
  panel.title = from.title;
  panel.x = {.label = spec.x_label, .scale = scale_of(spec)};
  const std::vector<MethodValue> rows = rows_of(from, spec.higher_is_better);
  panel.y.limits = Range{-0.6, std::max(1.0, static_cast<double>(rows.size())) - 0.4};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const MethodValue& method = rows[i];
    const double y = static_cast<double>(i);
    const SeriesStyle style = series_style(method.series);
    panel.y.names.push_back(printable(method.label, kLongestName));
    Scatter runs{.colour = style.colour, .marker = Marker::kCircle, .filled = false, .size = 0.7};
    for (const double run : method.runs) {
      if (!std::isfinite(run)) continue;
      add_point(runs, {run, y});
      runs.marks.push_back(
          {"", {{"method", method.label}, {"kind", "single runs"}, {"x", data_number(run)}}});
    }
    if (!runs.x.empty()) panel.layers.emplace_back(std::move(runs));
    Scatter value{.x = {method.value},
                  .y = {y},
                  .colour = style.colour,
                  .marker = style.marker,
                  .size = method.runs.empty() ? 1.0 : kSizeAmongRuns};
    value.marks.push_back(
        {prefix + method.key, {{"method", method.label}, {"x", data_number(method.value)}}});
    panel.layers.emplace_back(std::move(value));
  }
  return panel;
}

std::string alt_of(const ValueDotsSpec& spec) {
  std::string text = spec.title + ".";
  for (const ValueDotsPanel& panel : spec.panels) {
    std::vector<MethodValue> rows = rows_of(panel, spec.higher_is_better);
    std::ranges::reverse(rows);
    text += panel.title.empty() ? "" : " " + panel.title + ":";
    for (const MethodValue& method : rows)
      text += fmt::format(" {} {};", method.label, quantity_text(method.value, spec.unit));
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
  for (std::size_t i = 0; i < spec.panels.size(); ++i) {
    const std::string prefix =
        spec.panels.size() == 1 ? "value-" : fmt::format("panel-{}-value-", i + 1);
    figure.panels.push_back(panel_of(spec.panels[i], spec, prefix));
  }
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
