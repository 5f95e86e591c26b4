#include "render/figures/curves/fit_residuals.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/parts.hpp"
#include "render/figures/words.hpp"

namespace mapproof {
namespace {

constexpr double kMostSigmas = 6.0;
constexpr std::size_t kMostRangesDrawn = 2000;
constexpr std::size_t kMostColours = 6;

Panel residual_panel(const FitResidualsSpec& spec, bool over_time, double start_s) {
  Panel panel;
  panel.x = {.label = over_time ? "time [s]" : "range [m]"};
  panel.y = {.label = "residual [sigma]", .limits = Range{-kMostSigmas - 0.5, kMostSigmas + 0.5}};
  const bool has_colours = spec.landmarks.size() <= kMostColours;
  std::vector<Scatter> points(has_colours ? spec.landmarks.size() : 1);
  for (std::size_t n = 0; n < points.size(); ++n)
    points[n] = {.label = has_colours ? printable(spec.landmarks[n], 20) : "ranges",
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

}  // namespace

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
  std::size_t far = 0;
  for (const FittedRange& range : spec.ranges) far += std::abs(range.normalised) > 3.0 ? 1 : 0;
  const std::string shares =
      fmt::format("{} of {} beyond 3 sigma", far, counted(std::ssize(spec.ranges), "range"));
  figure.caption = fmt::format(
      "Prediction less measured range over its standard deviation, over time from the first range "
      "and over the range; {}. Residuals beyond {:g} stand there.",
      shares, kMostSigmas);
  figure.alt = fmt::format("Residuals of the ranges of the fit: {}. {}", shares, spec.verdict);
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
