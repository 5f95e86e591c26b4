#include "core/trials/online.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/align/laid_on.hpp"
#include "core/base/random.hpp"
#include "core/follow/followed_map.hpp"
#include "core/simulate/sensors.hpp"
#include "core/trials/trial_means.hpp"

namespace mapproof {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::pair<const char*, Sensor> kSensors[] = {{"bearing", Sensor::kBearing},
                                                       {"visibility", Sensor::kVisibility}};
constexpr const char* kCarriedOn = "carried-on";
constexpr const char* kAnew = "anew";
const MethodSetting kSetting{Method::kSmacof, std::nullopt};

TrialDesign design(const TrialExperiment& experiment) {
  TrialDesign design;
  design.question = fmt::format(
      "Observations arrive one by one, and every {:g} of them the map by {} is carried on from "
      "sums "
      "over pairs and from its last state. How far is it from the map that all observations so far "
      "make anew, and how many iterations does each take?",
      number_option(experiment, "every"), label(kSetting));
  for (const auto& [id, sensor] : kSensors)
    design.setups.push_back({id, fmt::format("Maps from {}, carried on", name(sensor)),
                             "observations so far", list_option(experiment, "observations")});
  design.series = {{kCarriedOn, "carried on"}, {kAnew, "made anew"}};
  design.quantities = {{"gap_percent", "From the map made anew, of its size", "%", true},
                       {"greatest_gap_percent", "The same, at most so far", "%", true},
                       {"beyond_percent", "Updates so far beyond 1 % of its size", "%", true},
                       {"iterations", "Iterations an update", "", true}};
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

/// What the updates since the last level came to.
struct Span {
  double gap = std::numeric_limits<double>::quiet_NaN();  ///< Of the last.
  double greatest = 0.0;                                  ///< Of all so far.
  int beyond = 0;                                         ///< Updates so far, beyond the bound.
  int updates_so_far = 0;
  int updates = 0;
  int carried_on = 0;  ///< Iterations.
  int anew = 0;
};

void add(TrialPart& part, const char* setup, double level, Span& span) {
  const double updates = std::max(span.updates, 1);
  part.trials.push_back({.setup = setup,
                         .series = kCarriedOn,
                         .level = level,
                         .values = {100.0 * span.gap, 100.0 * span.greatest,
                                    100.0 * span.beyond / std::max(span.updates_so_far, 1),
                                    span.carried_on / updates},
                         .statuses = {}});
  part.trials.push_back({.setup = setup,
                         .series = kAnew,
                         .level = level,
                         .values = {0.0, 0.0, 0.0, span.anew / updates},
                         .statuses = {}});
  span.updates = span.carried_on = span.anew = 0;
}

/// Follows one history from its first step to its last.
void follow(const TrialContext& context, const char* setup, const ObservationHistory& history,
            TrialPart& part) {
  const auto every = static_cast<Eigen::Index>(number_option(context.experiment, "every"));
  const std::vector<double>& levels = list_option(context.experiment, "observations");
  FollowedMap map(history.sensor, {.setting = kSetting, .embedder = {}});
  map.grow(history.landmarks());
  Span span;
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
    const Embedding whole = HistoryEmbedder(history, t).embed(kSetting);
    anew_s += seconds_since(start);
    span.gap = relative_gap(update.coordinates, whole.coordinates);
    span.greatest = std::max(span.greatest, span.gap);
    span.beyond += span.gap > kFollowedWithin ? 1 : 0;
    ++span.updates_so_far;
    span.carried_on += update.iterations;
    span.anew += whole.iterations;
    ++span.updates;
    if (asked) add(part, setup, static_cast<double>(t), span);
  }
  add_seconds(part, kCarriedOn, carried_on_s);
  add_seconds(part, kAnew, anew_s);
}

TrialPart make(const TrialContext& context) {
  TrialPart part;
  for (const auto& [id, sensor] : kSensors) {
    SensorOptions options;
    options.sensor = sensor;
    Random noise(derive_seed(context.seed, {static_cast<std::uint64_t>(sensor)}));
    follow(context, id, observe(*context.world, *context.path, options, noise), part);
  }
  return part;
}

std::vector<std::string> conclude(const TrialStudy& study) {
  std::vector<std::string> sentences;
  for (const TrialSetup& setup : study.design.setups) {
    const double last = setup.levels.back();
    double greatest = 0.0;
    for (const double gap : trial_values(study, setup.id, kCarriedOn, last, "greatest_gap_percent"))
      greatest = std::max(greatest, gap);
    sentences.push_back(fmt::format(
        "{}: at {:g} observations the map carried on is {:.3f} % of its size from the map made "
        "anew on average, {:.3f} % at most over all updates, and beyond 1 % in {:.2f} % of them; "
        "it takes {:.1f} iterations an update "
        "instead of {:.1f}.",
        setup.title, last, trial_mean(study, setup.id, kCarriedOn, last, "gap_percent"), greatest,
        trial_mean(study, setup.id, kCarriedOn, last, "beyond_percent"),
        trial_mean(study, setup.id, kCarriedOn, last, "iterations"),
        trial_mean(study, setup.id, kAnew, last, "iterations")));
  }
  return sentences;
}

}  // namespace

const Topic kOnlineTopic = {
    .name = "online",
    .of_data = false,
    .options = {{"observations", {200, 500, 1000, 2000, 4000}, 10, 100000, true, true},
                {"every", {20}, 1, 100000, true, false}},
    .design = design,
    .make = make,
    .conclude = conclude};

}  // namespace mapproof
