#include "core/model/topic_study.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr double kRadOfDegree = std::numbers::pi / 180.0;

const std::array kSweptFactors = {
    SweptFactor{"side_m", "side of the room", "m", Factor::kSide},
    SweptFactor{"landmarks", "landmarks", "", Factor::kLandmarks},
    SweptFactor{"landmark_diameter_m", "diameter of landmarks", "m", Factor::kDiameter},
    SweptFactor{"reach_m", "reach of the sensor", "m", Factor::kReach},
    SweptFactor{"visibility_errors_percent", "share of wrong visibility entries", "%",
                Factor::kNoise, 0.01, Sensor::kVisibility, 50.0},
    SweptFactor{"bearing_noise_deg", "noise of bearings", "\u00B0", Factor::kNoise, kRadOfDegree,
                Sensor::kBearing, 180.0},
    SweptFactor{"range_noise_m", "noise of ranges", "m", Factor::kNoise, 1.0, Sensor::kRange},
    SweptFactor{"steps", "observations", "", Factor::kSteps},
    SweptFactor{"anchors", "anchors", "", Factor::kAnchors},
};

void add_conditions(const TopicSetup& setup, std::vector<Level> levels,
                    std::vector<Condition>& conditions) {
  if (levels.size() == setup.factors.size()) {
    conditions.push_back(condition(setup.id, std::move(levels)));
    return;
  }
  const SetupFactor& factor = setup.factors[levels.size()];
  for (const double level : factor.levels) {
    std::vector<Level> more = levels;
    more.push_back({.factor = factor.id, .value = level});
    add_conditions(setup, std::move(more), conditions);
  }
}

void check_single(const TopicSetup& setup) {
  if (setup.factors.size() > 1)
    throw InvalidInput("a level of the setup " + setup.id + ", which has several factors");
}

}  // namespace

std::span<const SweptFactor> swept_factors() { return kSweptFactors; }

const SweptFactor* swept_factor_named(std::string_view name) {
  const auto found = std::ranges::find(kSweptFactors, name, &SweptFactor::name);
  return found == kSweptFactors.end() ? nullptr : &*found;
}

bool has_factors(Sensor sensor, const Sweep& sweep) {
  return std::ranges::all_of(sweep, [&](const SweptLevels& swept) {
    const SweptFactor* factor = swept_factor_named(swept.factor);
    return factor != nullptr && factor->sensor.value_or(sensor) == sensor;
  });
}

Experiment at_levels(const TopicExperiment& experiment, const SensorStudy& sensor,
                     const Sweep& sweep, const std::vector<double>& levels) {
  Experiment at;
  at.name = experiment.name;
  at.seed = experiment.seed;
  at.layouts = experiment.layouts;
  at.poses = experiment.poses;
  at.world = experiment.world;
  at.walk = experiment.walk;
  at.anchors = experiment.anchors;
  at.sensors = {sensor};
  for (const SweptFactor& factor : swept_factors())
    for (std::size_t i = 0; i < sweep.size(); ++i)
      if (sweep[i].factor == factor.name)
        set_level(at, sensor.sensor.sensor, factor.factor, factor.scale * levels.at(i));
  return at;
}

SetupFactor steps_factor(std::vector<double> steps) {
  return {.id = std::string(kStepsFactor),
          .label = "observations",
          .unit = {},
          .levels = std::move(steps)};
}

std::vector<Condition> conditions_of(const TopicSetup& setup) {
  std::vector<Condition> conditions;
  add_conditions(setup, {}, conditions);
  return conditions;
}

std::vector<double> levels_of(const TopicSetup& setup) {
  check_single(setup);
  return setup.factors.empty() ? std::vector{0.0} : setup.factors.front().levels;
}

Condition condition_at(const TopicSetup& setup, double level) {
  check_single(setup);
  if (setup.factors.empty()) return condition(setup.id);
  return condition(setup.id, {{.factor = setup.factors.front().id, .value = level}});
}

void add_seconds(TopicPart& part, std::string_view method, double seconds) {
  const auto found = std::ranges::find(part.seconds, method, &MethodSeconds::method);
  if (found == part.seconds.end())
    part.seconds.push_back({part.id, std::string(method), seconds});
  else
    found->seconds += seconds;
}

std::vector<double> list_option(const TopicExperiment& experiment, const std::string& name) {
  const auto found = experiment.options.find(name);
  if (found == experiment.options.end() || found->second.empty())
    throw InvalidInput(fmt::format("a study of {} without its option {}", experiment.topic, name));
  return found->second;
}

double number_option(const TopicExperiment& experiment, const std::string& name) {
  return list_option(experiment, name).front();
}

}  // namespace mapproof
