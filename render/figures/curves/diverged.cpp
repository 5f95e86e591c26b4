#include "render/figures/curves/diverged.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/text/error_text.hpp"
#include "core/base/text/words.hpp"
#include "render/plot/axis_map.hpp"

namespace mapproof {

double divergence_in(std::string_view unit, bool great_errors) {
  return great_errors ? greatest_error(unit) : kInfinity;
}

double axis_ceiling(std::span<const double> values, double divergence) {
  const bool any = std::ranges::any_of(values, [&](double value) { return value <= divergence; });
  return any ? divergence : kInfinity;
}

std::vector<double> without_diverged(std::vector<double> values, double divergence) {
  const double ceiling = axis_ceiling(values, divergence);
  std::erase_if(values, [ceiling](double value) { return value > ceiling; });
  return values;
}

void DivergedCount::see(double value, double divergence) {
  if (!std::isfinite(value)) return;
  ++known;
  diverged += value > divergence ? 1 : 0;
}

void note_diverged(const std::vector<DivergedCount>& counts, std::string_view preposition,
                   std::string_view of, std::vector<Note>& notes) {
  constexpr std::size_t kMostNamed = 4;
  std::vector<std::string> words;
  for (const auto& [label, diverged, known] : counts)
    if (diverged > 0)
      words.push_back(diverged == known ? label
                                        : fmt::format("{} {} {} of {} {}", label, preposition,
                                                      diverged, known, of));
  if (!words.empty())
    notes.push_back({fmt::format("Diverged, {}: {}.", kGreatErrorText, listed(words, kMostNamed)),
                     ThemeColour::kMuted});
}

double near_end(Scale scale, const Range& limits) {
  constexpr double kShare = 0.97;
  const auto& [low, high] = limits;
  return scale == Scale::kLog ? low * std::pow(high / low, kShare) : std::lerp(low, high, kShare);
}

DotAxis dot_axis(const std::vector<double>& values, Scale scale, double divergence) {
  DotAxis axis{.ceiling = axis_ceiling(values, divergence)};
  std::vector<double> shown = without_diverged(values, divergence);
  if (shown.size() == values.size()) return axis;
  Panel panel;  // With the limits that it would have without the others.
  panel.x.scale = scale;
  panel.layers.emplace_back(Scatter{.x = shown, .y = std::vector<double>(shown.size())});
  axis.limits = panel_limits(panel).x;
  axis.end = near_end(scale, *axis.limits);
  return axis;
}

Scatter diverged_dots(ThemeColour colour) {
  return {.label = kGreatErrorText,
          .colour = colour,
          .marker = Marker::kTriangle,
          .filled = false,
          .size = 1.6};
}

}  // namespace mapproof
