#include "render/figures/curves/refinement_starts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/layer_shapes.hpp"
#include "render/figures/maps/path_styles.hpp"

namespace mapproof {
namespace {

constexpr double kSame = 1.01;  // Costs up to this factor of the least are the same optimum.

/// Each with a smaller mark than the one before: they often lie on one point.
constexpr std::array kKinds = {SlamMethod::kRefined, SlamMethod::kRefinedFromOdometry,
                               SlamMethod::kRefinedFromRandom};
constexpr std::array kSizes = {2.2, 1.3, 0.7};

std::string label_of(SlamMethod method) {
  return method == SlamMethod::kRefined ? "from spectral"
                                        : std::string(info(method).label).substr(9);
}

bool is_positive(double value) { return value > 0.0 && std::isfinite(value); }

double least_cost(std::span<const RefinementStart> starts) {
  double least = kInfinity;
  for (const RefinementStart& start : starts)
    if (start.cost >= 0.0) least = std::min(least, start.cost);
  return least;
}

std::string count_words(std::span<const RefinementStart> starts) {
  std::vector<std::string> parts;
  for (const SlamMethod kind : kKinds)
    if (const StartCount count = starts_at_optimum(starts, kind); count.of > 0)
      parts.push_back(fmt::format("{} {} of {}", label_of(kind), count.reached, count.of));
  return parts.empty() ? "no start" : listed(parts, 3);
}

}  // namespace

StartCount starts_at_optimum(std::span<const RefinementStart> starts, SlamMethod method) {
  const double least = least_cost(starts);
  StartCount count;
  for (const RefinementStart& start : starts) {
    if (start.method != method) continue;
    ++count.of;
    count.reached += start.cost >= 0.0 && start.cost <= kSame * least ? 1 : 0;
  }
  return count;
}

Figure refinement_starts_figure(const RefinementStartsSpec& spec) {
  const bool judged = std::ranges::any_of(spec.starts, [](const RefinementStart& start) {
    return start.mean_m && is_positive(*start.mean_m);
  });
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = {spec.record_id};
  Panel& panel = figure.panels.emplace_back();
  panel.x = {.label = "final cost", .scale = Scale::kLog};
  panel.y = judged ? Axis{.label = "mean position error [m]", .scale = Scale::kLog}
                   : Axis{.label = "iterations", .whole = true};
  int without = 0;
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    const SlamMethod kind = kKinds[i];
    const PathStyle style = path_style(kind);
    Scatter points{.label = label_of(kind),
                   .colour = style.colour,
                   .marker = kind == SlamMethod::kRefined ? Marker::kCircle : style.marker,
                   .filled = kind == SlamMethod::kRefinedFromRandom,
                   .size = kSizes[i]};
    for (const RefinementStart& start : spec.starts) {
      if (start.method != kind) continue;
      const double y = judged ? start.mean_m.value_or(kNaN) : start.iterations;
      if (!is_positive(start.cost) || !(judged ? is_positive(y) : y >= 0.0)) {
        ++without;
        continue;
      }
      add_point(points, {start.cost, y});
      points.marks.push_back({fmt::format("{}-{}", info(kind).name, start.number),
                              {{"cost", data_number(start.cost)},
                               {"iterations", std::to_string(start.iterations)},
                               {"converged", start.converged ? "yes" : "no"}}});
    }
    panel.layers.emplace_back(std::move(points));
  }
  std::erase_if(panel.layers, is_empty);
  const std::string reached = count_words(spec.starts);
  figure.notes.push_back({"Within 1 % of the least cost: " + reached + "."});
  if (without > 0)
    figure.notes.push_back(
        {counted(without, "start") + " without a result to show.", ThemeColour::kWarning});
  figure.caption = fmt::format(
      "Final cost (half the sum of robust squared residuals) and {} of every start of the "
      "refinement. Within 1 % of the least cost: {}.",
      judged ? "mean position error" : "iterations", reached);
  figure.alt = fmt::format("{} of the refinement; least cost {}. Within 1 % of it: {}.",
                           counted(std::ssize(spec.starts), "start"),
                           significant(least_cost(spec.starts)), reached);
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
