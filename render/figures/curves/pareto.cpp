#include "render/figures/curves/pareto.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/parts.hpp"
#include "render/figures/words.hpp"

namespace mapproof {
namespace {

constexpr int kMostNamedSettings = 14;  // Of more settings only those on the front are named.

bool usable(const CostedSetting& setting) {
  return setting.seconds > 0.0 && !std::isnan(setting.mpe_m);
}

/// "0.3 ms", "12 s".
std::string duration(double seconds) {
  if (seconds < 1e-3) return significant(1e6 * seconds, 2) + " µs";
  if (seconds < 1.0) return significant(1e3 * seconds, 2) + " ms";
  return significant(seconds, 2) + " s";
}

/// The points of a Pareto figure and the words on them.
struct ParetoLayers {
  Polyline steps{.label = "Pareto front",
                 .colour = ThemeColour::kSeries2,
                 .dash = Dash::kDashed,
                 .mark = {"front", {}}};
  Scatter best{
      .label = "on the front", .colour = ThemeColour::kSeries2, .marker = Marker::kDiamond};
  Scatter beaten{.label = "dominated", .colour = ThemeColour::kSeries1, .filled = false};
  PointLabels names;
  std::vector<std::string> words;  ///< Of those on the front.
};

void add_setting(Scatter& points, const CostedSetting& one, std::size_t i) {
  add_point(points, {one.seconds, one.mpe_m});
  points.marks.push_back({fmt::format("setting-{}", i + 1),
                          {{"setting", one.label}, {"error", data_number(one.mpe_m)}}});
}

ParetoLayers layers_of(const std::vector<CostedSetting>& settings) {
  ParetoLayers layers;
  const std::vector<std::size_t> front = pareto_front(settings);
  for (const std::size_t i : front) {
    const CostedSetting& one = settings[i];
    if (!layers.steps.x.empty()) add_point(layers.steps, {one.seconds, layers.steps.y.back()});
    add_point(layers.steps, {one.seconds, one.mpe_m});
    add_setting(layers.best, one, i);
    add_label(layers.names, {one.seconds, one.mpe_m}, one.label);
    layers.words.push_back(
        fmt::format("{} ({} m in {})", one.label, significant(one.mpe_m), duration(one.seconds)));
  }
  const bool crowded = std::ranges::count_if(settings, usable) > kMostNamedSettings;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const CostedSetting& one = settings[i];
    if (!usable(one) || std::ranges::find(front, i) != front.end()) continue;
    add_setting(layers.beaten, one, i);
    if (!crowded) add_label(layers.names, {one.seconds, one.mpe_m}, one.label);
  }
  return layers;
}

void require_costs(const ParetoSpec& spec) {
  for (const CostedSetting& one : spec.settings)
    if (std::isinf(one.seconds) || std::isinf(one.mpe_m) || one.seconds < 0.0 || one.mpe_m < 0.0)
      throw InvalidInput("figure " + printable(spec.id) + ": " + printable(one.label) +
                         ": a value is infinite or negative");
}

}  // namespace

std::vector<std::size_t> pareto_front(const std::vector<CostedSetting>& settings) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < settings.size(); ++i)
    if (usable(settings[i])) order.push_back(i);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return std::pair(settings[a].seconds, settings[a].mpe_m) <
           std::pair(settings[b].seconds, settings[b].mpe_m);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || settings[i].mpe_m < settings[front.back()].mpe_m) front.push_back(i);
  return front;
}

Figure pareto_figure(const ParetoSpec& spec) {
  require_costs(spec);
  std::vector<double> errors;
  for (const CostedSetting& one : spec.settings)
    if (usable(one)) errors.push_back(one.mpe_m);
  const ErrorAxis axis = error_axis(errors, {}, 8.0);
  const ParetoLayers layers = layers_of(spec.settings);

  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  figure.varies = true;
  Panel& panel = figure.panels.emplace_back();
  panel.x.label = "seconds a map";
  panel.x.scale = Scale::kLog;
  panel.y.label = spec.y_label;
  panel.y.scale = axis.scale;
  panel.y.limits = axis.limits;
  panel.layers = {layers.steps, layers.beaten, layers.best, layers.names};
  std::erase_if(panel.layers, is_empty);

  figure.caption =
      "Mean error against the median seconds of a map, those of the maps it starts from included, "
      "a point a setting; filled: no other is both faster and better. Seconds are of one run of "
      "the program and differ from run to run.";
  figure.alt = fmt::format("{} against seconds a map for {}.", spec.y_label,
                           counted(static_cast<long long>(errors.size()), "setting"));
  if (!layers.words.empty())
    figure.alt += " On the Pareto front: " + listed(layers.words, 12) + ".";
  if (errors.empty()) figure.notes.push_back({"There are no settings.", ThemeColour::kWarning});
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
