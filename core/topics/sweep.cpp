#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/stopwatch.hpp"
#include "core/embed/embedder.hpp"
#include "core/experiment/run.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/topics/topics.hpp"

namespace mapproof {
namespace {

/// A setup: one sensor's part of a sweep.
struct SweptSetup {
  const SensorStudy& sensor;
  const Sweep& sweep;
  TopicSetup setup;
};

TopicSetup setup_of(Sensor sensor, const Sweep& sweep) {
  TopicSetup setup{.id = std::string(name(sensor)), .title = {}};
  for (const SweptLevels& swept : sweep) {
    const SweptFactor& factor = *swept_factor_named(swept.factor);
    setup.id += "-" + std::string(factor.name);
    setup.title += (setup.title.empty() ? "" : " and ") + std::string(factor.label);
    setup.factors.push_back({.id = std::string(factor.name),
                             .label = std::string(factor.label),
                             .unit = std::string(factor.unit),
                             .levels = swept.levels});
  }
  std::ranges::replace(setup.id, '_', '-');
  setup.title = fmt::format("Maps from {} by {}", name(sensor), setup.title);
  return setup;
}

std::vector<SweptSetup> setups_of(const TopicExperiment& experiment) {
  std::vector<SweptSetup> setups;
  for (const Sweep& sweep : experiment.sweeps)
    for (const SensorStudy& sensor : experiment.sensors)
      if (has_factors(sensor.sensor.sensor, sweep))
        setups.push_back({sensor, sweep, setup_of(sensor.sensor.sensor, sweep)});
  return setups;
}

TopicDesign sweep_design(const TopicExperiment& experiment) {
  TopicDesign design;
  for (SweptSetup& swept : setups_of(experiment)) design.setups.push_back(std::move(swept.setup));
  for (const SensorStudy& sensor : experiment.sensors)
    for (const MethodSetting& setting : settings_of(sensor))
      if (std::ranges::find(design.methods, slug(setting), &StudiedMethod::id) ==
          design.methods.end())
        design.methods.push_back({slug(setting), label(setting)});
  design.quantities = {known_quantity("mpe_m"), known_quantity("moe_percent")};
  return design;
}

/// Makes and scores the maps of one sensor under one condition.
void map_at(const Experiment& experiment, const TopicTask& context, const Condition& at,
            TopicPart& part) {
  const SensorStudy& sensor = experiment.sensors.front();
  const RunWorld made = make_run_world(experiment, context.run);
  const ObservationHistory history = observed_in(experiment, context.run, made, sensor.sensor);
  HistoryEmbedder embedder(history, history.steps(), embedder_options(experiment.solver));
  for (const MethodSetting& setting : settings_of(sensor)) {
    const Stopwatch stopwatch;
    const ScoredMap map = scored_map(embedder.embed(setting), made.world.landmarks_m, made.anchors,
                                     experiment.affine_fit);
    add_seconds(part, slug(setting), stopwatch.seconds());
    part.outcomes.push_back({.at = at,
                             .method = slug(setting),
                             .values = {{"mpe_m", map.score ? map.score->mpe_m : kNaN},
                                        {"moe_percent", map.score ? map.score->moe_percent : kNaN}},
                             .statuses = map.statuses});
  }
}

TopicPart make_sweep(const TopicTask& context) {
  TopicPart part;
  for (const SweptSetup& swept : setups_of(context.experiment))
    for (const Condition& at : conditions_of(swept.setup)) {
      std::vector<double> levels;
      for (const SweptLevels& factor : swept.sweep)
        levels.push_back(
            std::get<double>(std::ranges::find(at.levels, factor.factor, &Level::factor)->value));
      map_at(at_levels(context.experiment, swept.sensor, swept.sweep, levels), context, at, part);
    }
  return part;
}

}  // namespace

const Topic kSweepTopic = {
    .name = "sweep", .sweeps = true, .options = {}, .design = sweep_design, .make = make_sweep};

}  // namespace mapproof
