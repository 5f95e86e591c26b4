#include "render/figures/diagrams/fit.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/layer_shapes.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostTestRows = 16;
constexpr double kLeastRatio = 0.03;  ///< Smaller ratios are drawn here.

/// Those that are drawn, the greatest first.
std::vector<FitTestRow> drawn_rows(const FitTestsSpec& spec) {
  std::vector<FitTestRow> rows;
  for (const FitTestRow& row : spec.rows)
    if (std::isfinite(row.ratio)) rows.push_back(row);
  std::ranges::stable_sort(rows, std::greater<>(), &FitTestRow::ratio);
  if (rows.size() > kMostTestRows) rows.resize(kMostTestRows);
  return rows;
}

bool is_off_axis(const FitTestRow& row) { return row.ratio < kLeastRatio; }

/// The rows between two ratios, the lower one among them.
Scatter test_marks(const std::vector<FitTestRow>& rows, Range ratios, Scatter points) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].ratio < ratios.low || rows[i].ratio >= ratios.high) continue;
    add_point(points, {std::max(rows[i].ratio, kLeastRatio), static_cast<double>(i)});
    points.marks.push_back({rows[i].key,
                            {{"test", rows[i].label},
                             {"ratio", data_number(rows[i].ratio)},
                             {"cause", rows[i].is_cause ? "yes" : "no"}}});
  }
  return points;
}

constexpr double kMostSigmas = 6.0, kFarSigmas = 3.0;
constexpr std::size_t kMostRangesDrawn = 2000;
constexpr std::size_t kMostColours = 6;

Panel residual_panel(const FitResidualsSpec& spec, bool over_time, double start_s) {
  Panel panel;
  panel.x = {.label = over_time ? "time [s]" : "range [m]"};
  panel.y = {.label = "residual [sigma]", .limits = Range{-kMostSigmas - 0.5, kMostSigmas + 0.5}};
  const bool has_colours = spec.landmarks.size() <= kMostColours;
  std::vector<Scatter> points(has_colours ? spec.landmarks.size() : 1);
  for (std::size_t n = 0; n < points.size(); ++n)
    points[n] = {.label = has_colours ? spec.landmarks[n] : "ranges",
                 .colour = series_colour(n),
                 .size = 0.4};
  const std::size_t step = (spec.ranges.size() + kMostRangesDrawn - 1) / kMostRangesDrawn;
  double low = 0.0, high = 1.0;
  bool is_first = true;
  for (std::size_t i = 0; i < spec.ranges.size(); i += std::max<std::size_t>(step, 1)) {
    const FittedRange& range = spec.ranges[i];
    if (!std::isfinite(range.normalised)) continue;
    const double x = over_time ? range.time_s - start_s : range.range_m;
    low = is_first ? x : std::min(low, x);
    high = is_first ? x : std::max(high, x);
    is_first = false;
    const auto n = has_colours ? static_cast<std::size_t>(range.landmark) : 0;
    if (n < points.size())
      add_point(points[n], {x, std::clamp(range.normalised, -kMostSigmas, kMostSigmas)});
  }
  Segments zero{.colour = ThemeColour::kText, .width = 0.6};
  add_line(zero, {low, 0.0}, {std::max(high, low + 1e-9), 0.0});
  panel.layers.emplace_back(std::move(zero));
  for (Scatter& layer : points) panel.layers.emplace_back(std::move(layer));
  std::erase_if(panel.layers, is_empty);
  return panel;
}

/// Where residuals beyond the axis are drawn; empty if there are none.
std::string edge_words(std::span<const FittedRange> ranges) {
  const bool any = std::ranges::any_of(
      ranges, [](const FittedRange& range) { return std::abs(range.normalised) > kMostSigmas; });
  return any ? fmt::format(
                   " Residuals of more than {0:g} standard deviations are drawn at {0:g}, negative "
                   "ones at \u2212{0:g}.",
                   kMostSigmas)
             : "";
}

}  // namespace

std::string far_residuals_text(std::span<const FittedRange> ranges) {
  const auto far = std::ranges::count_if(
      ranges, [](const FittedRange& range) { return std::abs(range.normalised) > kFarSigmas; });
  return fmt::format("{} of {} beyond {:g} sigma", far, counted(std::ssize(ranges), "range"),
                     kFarSigmas);
}

Figure fit_tests_figure(const FitTestsSpec& spec) {
  std::vector<FitTestRow> rows = drawn_rows(spec);
  std::ranges::reverse(rows);  // The first one is uppermost.
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  figure.notes.push_back(
      {spec.verdict, spec.is_alarm ? ThemeColour::kWarning : ThemeColour::kText});
  Panel& panel = figure.panels.emplace_back();
  panel.x = {.label = "statistic / bound", .scale = Scale::kLog};
  panel.y = {.label = ""};
  const double last = std::max(1.0, static_cast<double>(rows.size())) - 0.4;
  panel.y.limits = Range{-0.6, last};
  double most = 3.0;
  std::vector<std::string> above;
  Segments from_bound{.colour = ThemeColour::kMuted, .width = 0.6};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    panel.y.names.push_back(rows[i].label);
    most = std::max(most, 1.5 * rows[i].ratio);
    const double y = static_cast<double>(i);
    add_line(from_bound, {1.0, y}, {std::max(rows[i].ratio, kLeastRatio), y});
    if (rows[i].ratio > 1.0)
      above.push_back(fmt::format("{} {}", rows[i].label, significant(rows[i].ratio, 2)));
  }
  panel.x.limits = Range{kLeastRatio / 1.3, most};
  Segments bound{.label = "bound", .colour = ThemeColour::kText, .dash = Dash::kDashed};
  add_line(bound, {1.0, -0.6}, {1.0, last});
  const double above_bound = std::nextafter(1.0, 2.0);
  panel.layers = {from_bound, bound,
                  test_marks(rows, {-kInfinity, kLeastRatio},
                             {.label = fmt::format("below {:g}, off the axis", kLeastRatio),
                              .colour = ThemeColour::kSeries1,
                              .marker = Marker::kTriangleDown,
                              .filled = false}),
                  test_marks(rows, {kLeastRatio, above_bound},
                             {.label = "within its bound",
                              .colour = ThemeColour::kSeries1,
                              .marker = Marker::kCircle,
                              .filled = false}),
                  test_marks(rows, {above_bound, kInfinity},
                             {.label = "above its bound",
                              .colour = ThemeColour::kSeries2,
                              .marker = Marker::kDiamond,
                              .filled = true})};
  std::erase_if(panel.layers, is_empty);
  std::ranges::reverse(above);
  if (rows.size() < spec.rows.size())
    figure.notes.push_back(
        {fmt::format("The {} greatest of {} tests.", rows.size(), spec.rows.size())});
  if (const auto off = std::ranges::count_if(rows, is_off_axis); off > 0)
    figure.notes.push_back({fmt::format("{} below {:g} of the bound: drawn at the axis as {}.",
                                        counted(off, "statistic"), kLeastRatio,
                                        off == 1 ? "a triangle" : "triangles")});
  figure.caption = fmt::format(
      "Tests of the fit of the map to its data: the statistic of each over its bound, which "
      "fault-free "
      "data exceed rarely, the greatest first. {}",
      spec.verdict);
  figure.alt =
      fmt::format("{} of the fit. Above the bound: {}.", counted(std::ssize(spec.rows), "test"),
                  above.empty() ? "none" : listed(above, 6));
  require_valid(figure);
  return figure;
}

Figure fit_residuals_figure(const FitResidualsSpec& spec) {
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = {spec.record_id};
  figure.notes.push_back(
      {spec.verdict, spec.is_alarm ? ThemeColour::kWarning : ThemeColour::kText});
  const double start_s = spec.ranges.empty() ? 0.0 : spec.ranges.front().time_s;
  figure.panels = {residual_panel(spec, true, start_s), residual_panel(spec, false, start_s)};
  figure.columns = 1;
  figure.shared_y = true;
  const std::string shares = far_residuals_text(spec.ranges);
  figure.caption = fmt::format(
      "Prediction less measured range over its standard deviation, over time from the first range "
      "and over the range.{}",
      edge_words(spec.ranges));
  figure.alt = fmt::format("Residuals of the ranges of the fit: {}. {}", shares, spec.verdict);
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
