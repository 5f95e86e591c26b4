#include "core/records/experiments/experiment_json.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"
#include "core/json/text_input.hpp"
#include "core/records/experiments/profiles.hpp"
#include "core/records/limits.hpp"

namespace mapproof {
namespace {

using Fault = std::optional<RecordFault>;

/// Discs dropped at random, one after another, jam when they cover some 0.547 of the plane
/// [feder1980]; above this share it takes too long to find a position for the next.
constexpr double kDensest = 0.45;
constexpr double kMostSubsteps = 1e4;        ///< Of one step.
constexpr double kMostSubstepsOfWalk = 1e9;  ///< Some minutes.

/// Why landmarks cannot be scattered over the room; empty: they can.
std::string room_problem(const WorldOptions& world) {
  const double spacing_m = world.landmark_diameter_m + world.gap_m;
  const double free_side_m = world.side_m - 2.0 * world.wall_margin_m - world.landmark_diameter_m;
  if (free_side_m <= 0.0)
    return fmt::format(
        "a room of {} m has no space for a landmark of {} m that keeps {} m from the walls",
        world.side_m, world.landmark_diameter_m, world.wall_margin_m);
  const double room = (free_side_m + spacing_m) * (free_side_m + spacing_m);
  const double each = std::numbers::pi / 4.0 * spacing_m * spacing_m;
  const double most = std::floor(kDensest * room / each);
  if (world.landmarks <= most) return "";
  return fmt::format(
      "{} landmarks of {} m, {} m apart, do not fit into a room of {} m: at most {:.0f} do",
      world.landmarks, world.landmark_diameter_m, world.gap_m, world.side_m, most);
}

std::string anchors_problem(const Experiment& experiment) {
  if (experiment.anchors < experiment.world.landmarks) return "";
  return fmt::format("{} anchors leave none of {} landmarks to be mapped", experiment.anchors,
                     experiment.world.landmarks);
}

std::string entries_problem(int landmarks, int steps) {
  if (static_cast<double>(landmarks) * steps <= kMostEntries) return "";
  return fmt::format("{} landmarks x {} steps are more than {} entries", landmarks, steps,
                     kMostEntries);
}

Fault walk_fault(const Experiment& experiment) {
  const WalkOptions& walk = experiment.walk;
  if (2.0 * walk.wall_margin_m >= experiment.world.side_m)
    return {{"walk/wall_margin_m",
             fmt::format("wall_margin_m = {} leaves the robot no room within walls of {} m",
                         walk.wall_margin_m, experiment.world.side_m)}};
  if (walk.substep_m > walk.step_m)
    return {{"walk", fmt::format("substep_m = {} is longer than step_m = {}", walk.substep_m,
                                 walk.step_m)}};
  const double substeps = walk.step_m / walk.substep_m;
  if (substeps > kMostSubsteps)
    return {{"walk", fmt::format("step_m = {} in substeps of substep_m = {} are {:.0f} a step; at "
                                 "most {:.0f}",
                                 walk.step_m, walk.substep_m, substeps, kMostSubsteps)}};
  int steps = 0;
  for (const SensorStudy& study : experiment.sensors)
    steps = std::max(steps, study.checkpoints.back());
  for (const Variation& variation : experiment.variations) steps = std::max(steps, variation.step);
  if (substeps * steps > kMostSubstepsOfWalk)
    return {{"walk", fmt::format("{:.0f} substeps a step x {} steps are more than {:.0f}", substeps,
                                 steps, kMostSubstepsOfWalk)}};
  return std::nullopt;
}

Fault grids_fault(const std::vector<MethodGrid>& grids, int landmarks, const std::string& pointer) {
  for (const MethodGrid& grid : grids) {
    if (!on_graph(grid.method)) continue;
    const auto at = std::ranges::lower_bound(grid.parameters, double(landmarks));
    if (at == grid.parameters.end()) continue;
    return {{fmt::format("{}/methods/{}/K/{}", pointer, info(grid.method).name,
                         at - grid.parameters.begin()),
             fmt::format("K must be below the number of landmarks, {}, got {}", landmarks, *at)}};
  }
  return std::nullopt;
}

std::string pointer_of(const SensorStudy& study) {
  return fmt::format("sensors/{}", name(study.sensor.sensor));
}

Fault sensors_fault(const Experiment& experiment) {
  const int landmarks = experiment.world.landmarks;
  for (const SensorStudy& study : experiment.sensors) {
    if (auto problem = entries_problem(landmarks, study.checkpoints.back()); !problem.empty())
      return {{pointer_of(study) + "/checkpoints", std::move(problem)}};
    if (auto fault = grids_fault(study.methods, landmarks, pointer_of(study))) return fault;
  }
  return std::nullopt;
}

/// Whether two sensors' tables get one id, those that go with them included.
Fault table_ids_fault(const Experiment& experiment) {
  for (const SensorStudy& study : experiment.sensors)
    for (const SensorStudy& other : experiment.sensors) {
      const std::string& id = study.published.table;
      const std::string& longer = other.published.table;
      // "table-1-half" is a table that goes with "table-1".
      if (&study == &other || id.empty() || !(longer + '-').starts_with(id + '-')) continue;
      return {{pointer_of(other) + "/published/table",
               fmt::format("{} begins as the table of {} does, {}", in_quotes(longer),
                           name(study.sensor.sensor), in_quotes(id))}};
    }
  return std::nullopt;
}

/// Names and ids of the methods of others, beside each sensor's own.
Fault external_fault(const Experiment& experiment) {
  for (const SensorStudy& study : experiment.sensors) {
    std::vector<MethodSetting> ours = settings_of(study);
    std::erase_if(ours, [&](const MethodSetting& setting) {
      return find_external(experiment, setting.method) != nullptr;
    });
    if (auto fault = name_fault_of(experiment.external_methods, ours))
      return {{fmt::format("external_methods/{}/name", fault->method), std::move(fault->what)}};
  }
  return std::nullopt;
}

std::string no_sensor(Sensor sensor) {
  return fmt::format("the experiment has no sensor {}", name(sensor));
}

Fault variation_fault(const Variation& variation, const Experiment& experiment,
                      const std::string& pointer) {
  if (find_sensor(experiment, variation.sensor) == nullptr)
    return {{pointer + "/sensor", no_sensor(variation.sensor)}};
  const FactorInfo& factor = info(variation.factor);
  double most = factor.maximum;
  if (variation.factor == Factor::kNoise) most = greatest_noise(variation.sensor);
  if (variation.factor == Factor::kAnchors) most = experiment.world.landmarks - 1;
  for (std::size_t i = 0; i < variation.levels.size(); ++i)
    if (const double level = variation.levels[i]; level > most)
      return {
          {fmt::format("{}/levels/{}", pointer, i),
           fmt::format("expected {} from {} to {}, got {}",
                       factor.integer ? "an integer" : "a number", factor.minimum, most, level)}};
  if (auto problem = entries_problem(experiment.world.landmarks, variation.step); !problem.empty())
    return {{pointer, std::move(problem)}};
  return grids_fault(grids_of(variation.settings), experiment.world.landmarks, pointer);
}

/// Why one of an experiment's runs cannot be simulated and mapped; empty: it can.
std::string run_problem(const Experiment& experiment) {
  if (std::string problem = anchors_problem(experiment); !problem.empty()) return problem;
  if (std::string problem = room_problem(experiment.world); !problem.empty()) return problem;
  if (2.0 * experiment.walk.wall_margin_m >= experiment.world.side_m)
    return fmt::format("walls of {} m leave the robot no room", experiment.world.side_m);
  const Fault fault = sensors_fault(experiment);
  return fault ? fault->what : "";
}

/// "landmarks = 50, side_m = 0.1".
std::string text_of(const Sweep& sweep, const std::vector<double>& levels) {
  std::string text;
  for (std::size_t i = 0; i < sweep.size(); ++i)
    text += fmt::format("{}{} = {:g}", i == 0 ? "" : ", ", sweep[i].factor, levels[i]);
  return text;
}

/// Every combination of a sweep's levels, the first factor's outermost.
std::vector<std::vector<double>> combinations_of(const Sweep& sweep) {
  std::vector<std::vector<double>> all = {{}};
  for (const SweptLevels& swept : sweep) {
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& levels : all)
      for (const double level : swept.levels) {
        longer.push_back(levels);
        longer.back().push_back(level);
      }
    all = std::move(longer);
  }
  return all;
}

std::string sweep_problem(const TopicExperiment& experiment, const Sweep& sweep) {
  bool has_sensor = false;
  for (const SensorStudy& sensor : experiment.sensors) {
    if (!has_factors(sensor.sensor.sensor, sweep)) continue;
    has_sensor = true;
    for (const std::vector<double>& levels : combinations_of(sweep))
      if (const std::string problem = run_problem(at_levels(experiment, sensor, sweep, levels));
          !problem.empty())
        return text_of(sweep, levels) + ": " + problem;
  }
  return has_sensor ? "" : "no sensor of the experiment has these factors";
}

}  // namespace

std::string experiment_json(const Experiment& experiment) { return to_json_text(experiment); }

Experiment parse_experiment(std::string_view text, const std::string& source,
                            const std::string& profile) {
  const JsonDocument document = parse_with_profile(text, source, "mapproof.experiment", profile);
  return from_json_value<Experiment>(document.cursor());
}

std::optional<RecordFault> fault_of(const Experiment& experiment) {
  if (static_cast<long>(experiment.layouts) * experiment.poses > kMostRuns)
    return {{"", fmt::format("{} layouts x {} poses are more than {} runs", experiment.layouts,
                             experiment.poses, kMostRuns)}};
  if (std::string problem = anchors_problem(experiment); !problem.empty())
    return {{"", std::move(problem)}};
  if (std::string problem = room_problem(experiment.world); !problem.empty())
    return {{"world", std::move(problem)}};
  if (auto fault = walk_fault(experiment)) return fault;
  if (auto fault = table_ids_fault(experiment)) return fault;
  if (auto fault = sensors_fault(experiment)) return fault;
  if (auto fault = external_fault(experiment)) return fault;
  for (std::size_t i = 0; i < experiment.variations.size(); ++i)
    if (auto fault =
            variation_fault(experiment.variations[i], experiment, fmt::format("variations/{}", i)))
      return fault;
  for (std::size_t i = 0; i < experiment.figures.size(); ++i)
    if (const Sensor sensor = experiment.figures[i].sensor;
        find_sensor(experiment, sensor) == nullptr)
      return {{fmt::format("figures/{}/sensor", i), no_sensor(sensor)}};
  return std::nullopt;
}

std::optional<RecordFault> fault_of(const TopicExperiment& experiment) {
  const int landmarks = experiment.world.landmarks;
  if (experiment.anchors > landmarks)
    return {{"anchors", fmt::format("{} anchors of {} landmarks", experiment.anchors, landmarks)}};
  if (static_cast<double>(landmarks) * experiment.steps > kMostEntries)
    return {{"steps", fmt::format("{} landmarks at {} steps are more than {:g} entries", landmarks,
                                  experiment.steps, kMostEntries)}};
  const auto observations = experiment.options.find("observations");
  if (observations != experiment.options.end() && observations->second.back() > experiment.steps)
    return {{"options/observations", fmt::format("{:g} observations of {} steps",
                                                 observations->second.back(), experiment.steps)}};
  std::vector<std::set<std::string>> swept;
  for (std::size_t i = 0; i < experiment.sweeps.size(); ++i) {
    const std::string pointer = fmt::format("sweeps/{}", i);
    if (std::string problem = sweep_problem(experiment, experiment.sweeps[i]); !problem.empty())
      return {{pointer, std::move(problem)}};
    std::set<std::string> factors;
    for (const SweptLevels& one : experiment.sweeps[i]) factors.insert(one.factor);
    if (const auto same = std::ranges::find(swept, factors); same != swept.end())
      return {{pointer, fmt::format("varies the same factors as sweeps/{}", same - swept.begin())}};
    swept.push_back(std::move(factors));
  }
  return std::nullopt;
}

}  // namespace mapproof
