#include "core/trials/online.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/align/laid_on.hpp"
#include "core/base/random.hpp"
#include "core/follow/followed_map.hpp"
#include "core/simulate/sensors.hpp"

namespace mapproof {
namespace {

using Clock = std::chrono::steady_clock;

constexpr Sensor kFollowedSensors[] = {Sensor::kBearing, Sensor::kVisibility, Sensor::kRange};

/// A method, with one setting for all histories, and its two series.
struct Followed {
  MethodSetting setting;
  const char* carried_on;
  const char* anew;
};

const Followed kMethods[] = {
    {{Method::kSmacof, std::nullopt}, "smacof", "smacof-anew"},
    {{Method::kSmacofKnn, 6.0}, "smacof-knn", "smacof-knn-anew"},
    {{Method::kIsomap, 6.0}, "isomap", "isomap-anew"},
};

TrialDesign online_design(const TrialExperiment& experiment) {
  TrialDesign design;
  for (const Sensor sensor : kFollowedSensors)
    design.setups.push_back({std::string(name(sensor)),
                             fmt::format("Maps from {}, carried on", name(sensor)),
                             {{std::string(kStepsFactor), "observations so far", "",
                               list_option(experiment, "observations")}}});
  for (const Followed& method : kMethods) {
    design.series.push_back({method.carried_on, label(method.setting) + ", carried on"});
    design.series.push_back({method.anew, label(method.setting) + ", anew"});
  }
  design.quantities = {
      study_quantity("gap_ppm", "Off the map made anew", "ppm", Better::kLower),
      study_quantity("greatest_gap_ppm", "The same, at most over all updates so far", "ppm",
                     Better::kLower),
      study_quantity("beyond_percent", "Updates so far beyond the stated bound", "%",
                     Better::kLower),
      study_quantity("steps_gone_through", "Observations gone through for the update", "",
                     Better::kLower)};
  return design;
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<StepEntry> step_of(const ObservationHistory& history, Eigen::Index t) {
  std::vector<StepEntry> step;
  for (Eigen::Index i = 0; i < history.landmarks(); ++i)
    if (!std::isnan(history.values(i, t))) step.push_back({i, history.values(i, t)});
  return step;
}

/// What the updates so far came to.
struct Gaps {
  double last = 0.0;
  double greatest = 0.0;
  int updates = 0;
  int beyond = 0;  ///< The stated bound.

  void add(double gap) {
    last = gap;
    greatest = std::max(greatest, gap);
    ++updates;
    beyond += gap <= kFollowedWithin ? 0 : 1;
  }
};

/// Follows one history from its first step to its last by one method.
void follow(const TrialContext& context, const Followed& method, const ObservationHistory& history,
            TrialPart& part) {
  const auto every = static_cast<Eigen::Index>(number_option(context.experiment, "every"));
  const std::vector<double>& levels = list_option(context.experiment, "observations");
  const std::string setup{name(history.sensor)};
  FollowedMap map(history.sensor, {.setting = method.setting, .embedder = {}});
  map.grow(history.landmarks());
  Gaps gaps;
  Eigen::Index before = 0;
  double carried_on_s = 0.0, anew_s = 0.0;
  for (Eigen::Index t = 1; t <= history.steps(); ++t) {
    Clock::time_point start = Clock::now();
    map.add(step_of(history, t - 1));
    carried_on_s += seconds_since(start);
    const bool asked = std::ranges::find(levels, static_cast<double>(t)) != levels.end();
    if (t % every != 0 && !asked) continue;
    start = Clock::now();
    const Embedding update = map.update().embedding;
    carried_on_s += seconds_since(start);
    start = Clock::now();
    const Embedding whole = HistoryEmbedder(history, t).embed(method.setting);
    anew_s += seconds_since(start);
    gaps.add(relative_gap(update.coordinates, whole.coordinates));
    const auto trial = [&](const char* series, std::map<std::string, double> values) {
      part.trials.push_back({.at = condition(setup, {{.factor = std::string(kStepsFactor),
                                                      .value = static_cast<double>(t)}}),
                             .series = series,
                             .values = std::move(values),
                             .statuses = {}});
    };
    if (asked) {
      trial(method.carried_on,
            {{"gap_ppm", 1e6 * gaps.last},
             {"greatest_gap_ppm", 1e6 * gaps.greatest},
             {"beyond_percent", 100.0 * gaps.beyond / static_cast<double>(gaps.updates)},
             {"steps_gone_through", static_cast<double>(t - before)}});
      trial(method.anew, {{"gap_ppm", 0.0},
                          {"greatest_gap_ppm", 0.0},
                          {"beyond_percent", 0.0},
                          {"steps_gone_through", static_cast<double>(t)}});
    }
    before = t;
  }
  add_seconds(part, method.carried_on, carried_on_s);
  add_seconds(part, method.anew, anew_s);
}

TrialPart make_online(const TrialContext& context) {
  TrialPart part;
  for (const Sensor sensor : kFollowedSensors) {
    SensorOptions options;
    options.sensor = sensor;
    Random noise(derive_seed(context.seed, {static_cast<std::uint64_t>(sensor)}));
    const ObservationHistory history = observe(*context.world, *context.path, options, noise);
    for (const Followed& method : kMethods) follow(context, method, history, part);
  }
  return part;
}

}  // namespace

const Topic kOnlineTopic = {
    .name = "online",
    .of_data = false,
    .options = {{"observations", {200, 500, 1000, 2000, 4000}, 10, 100000, true, true},
                {"every", {20}, 1, 100000, true, false}},
    .design = online_design,
    .make = make_online};

}  // namespace mapproof
