#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/align/aligned_to.hpp"
#include "core/base/random.hpp"
#include "core/base/stopwatch.hpp"
#include "core/incremental/incremental_map.hpp"
#include "core/simulate/sensors.hpp"
#include "core/topics/topics.hpp"

namespace mapproof {
namespace {

constexpr Sensor kIncrementalSensors[] = {Sensor::kBearing, Sensor::kVisibility, Sensor::kRange};

/// Each has one setting for all histories, and two methods: incremental and from scratch.
const MethodSetting kIncrementalSettings[] = {
    {Method::kSmacof, std::nullopt}, {Method::kSmacofKnn, 6.0}, {Method::kIsomap, 6.0}};

/// Of the maps made from scratch; the incremental ones have slug(setting).
std::string resampled_method(const MethodSetting& setting) { return slug(setting) + "-whole"; }

TopicDesign incremental_design(const TopicExperiment& experiment) {
  TopicDesign design;
  for (const Sensor sensor : kIncrementalSensors)
    design.setups.push_back({std::string(name(sensor)),
                             fmt::format("Incremental maps from {}", name(sensor)),
                             {{std::string(kStepsFactor), "observations so far", "",
                               list_option(experiment, "observations")}}});
  for (const MethodSetting& setting : kIncrementalSettings) {
    design.methods.push_back({slug(setting), label(setting) + ", incremental"});
    design.methods.push_back({resampled_method(setting), label(setting) + ", from scratch"});
  }
  design.quantities = {
      study_quantity("gap_ppm", "Distance from the map from scratch", "ppm", Better::kLower),
      study_quantity("greatest_gap_ppm", "Peak distance from the map from scratch", "ppm",
                     Better::kLower),
      study_quantity("beyond_percent", "Share of updates beyond the bound", "%", Better::kLower),
      study_quantity("steps_gone_through", "Number of observations processed per update", "",
                     Better::kLower)};
  return design;
}

std::vector<StepEntry> step_of(const ObservationHistory& history, Eigen::Index t) {
  std::vector<StepEntry> step;
  for (Eigen::Index i = 0; i < history.landmarks(); ++i)
    if (!std::isnan(history.values(i, t))) step.push_back({i, history.values(i, t)});
  return step;
}

/// The results of the updates so far.
struct Differences {
  double last = 0.0;
  double greatest = 0.0;
  int updates = 0;
  int beyond = 0;  ///< The stated bound.

  void add(double gap) {
    last = gap;
    greatest = std::max(greatest, gap);
    ++updates;
    beyond += gap <= kIncrementalWithin ? 0 : 1;
  }
};

/// Maps one history incrementally from its first step to its last by one method.
void add_maps(const TopicTask& context, const MethodSetting& setting,
              const ObservationHistory& history, TopicPart& part) {
  const auto every = static_cast<Eigen::Index>(number_option(context.experiment, "every"));
  const std::vector<double>& levels = list_option(context.experiment, "observations");
  const std::string setup{name(history.sensor)};
  IncrementalMap map(history.sensor, {.setting = setting, .embedder = {}});
  map.grow(history.landmarks());
  Differences differences;
  Eigen::Index before = 0;
  double carried_on_s = 0.0, resampled_s = 0.0;
  for (Eigen::Index t = 1; t <= history.steps(); ++t) {
    Stopwatch stopwatch;
    map.add(step_of(history, t - 1));
    carried_on_s += stopwatch.seconds();
    const bool asked = std::ranges::find(levels, static_cast<double>(t)) != levels.end();
    if (t % every != 0 && !asked) continue;
    stopwatch = {};
    const Embedding update = map.update().embedding;
    carried_on_s += stopwatch.seconds();
    stopwatch = {};
    const Embedding whole = HistoryEmbedder(history, t).embed(setting);
    resampled_s += stopwatch.seconds();
    differences.add(relative_gap(update.coordinates, whole.coordinates));
    const auto outcome = [&](const std::string& method, std::map<std::string, double> values) {
      part.outcomes.push_back({.at = condition(setup, {{.factor = std::string(kStepsFactor),
                                                        .value = static_cast<double>(t)}}),
                               .method = method,
                               .values = std::move(values),
                               .statuses = {}});
    };
    if (asked) {
      outcome(slug(setting), {{"gap_ppm", 1e6 * differences.last},
                              {"greatest_gap_ppm", 1e6 * differences.greatest},
                              {"beyond_percent", 100.0 * differences.beyond /
                                                     static_cast<double>(differences.updates)},
                              {"steps_gone_through", static_cast<double>(t - before)}});
      outcome(resampled_method(setting), {{"gap_ppm", 0.0},
                                          {"greatest_gap_ppm", 0.0},
                                          {"beyond_percent", 0.0},
                                          {"steps_gone_through", static_cast<double>(t)}});
    }
    before = t;
  }
  add_seconds(part, slug(setting), carried_on_s);
  add_seconds(part, resampled_method(setting), resampled_s);
}

TopicPart make_incremental(const TopicTask& context) {
  TopicPart part;
  for (const Sensor sensor : kIncrementalSensors) {
    SensorOptions options;
    options.sensor = sensor;
    Random noise(derive_seed(context.seed, {static_cast<std::uint64_t>(sensor)}));
    const ObservationHistory history = observe(*context.world, *context.path, options, noise);
    for (const MethodSetting& setting : kIncrementalSettings)
      add_maps(context, setting, history, part);
  }
  return part;
}

}  // namespace

const Topic kIncrementalTopic = {
    .name = "incremental",
    .of_data = false,
    .options = {{"observations", {200, 500, 1000, 2000, 4000}, 10, 100000, true, true},
                {"every", {20}, 1, 100000, true, false}},
    .design = incremental_design,
    .make = make_incremental};

}  // namespace mapproof
