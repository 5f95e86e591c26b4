#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/records/experiment_values.hpp"
#include "core/records/json_values.hpp"

namespace mapproof {
namespace {

/// Discs dropped at random, one after another, jam when they cover some 0.547 of the plane
/// [feder1980]; above this share it takes too long to find a place for the next.
constexpr double kDensest = 0.45;
constexpr double kMostSubsteps = 1e4;        ///< Of one step.
constexpr double kMostSubstepsOfWalk = 1e9;  ///< Some minutes.

void check_walk(const Experiment& experiment, const JsonCursor& document) {
  const WalkOptions& walk = experiment.walk;
  const JsonCursor place = document.find("walk").value_or(document);  // Defaults break bounds too.
  if (2.0 * walk.wall_margin_m >= experiment.world.side_m)
    place.find("wall_margin_m")
        .value_or(place)
        .fail(fmt::format("wall_margin_m = {} leaves the robot no room within walls of {} m",
                          walk.wall_margin_m, experiment.world.side_m));
  if (walk.substep_m > walk.step_m)
    place.fail(
        fmt::format("substep_m = {} is longer than step_m = {}", walk.substep_m, walk.step_m));
  const double substeps = walk.step_m / walk.substep_m;
  if (substeps > kMostSubsteps)
    place.fail(
        fmt::format("step_m = {} in substeps of substep_m = {} are {:.0f} a step; at most "
                    "{:.0f}",
                    walk.step_m, walk.substep_m, substeps, kMostSubsteps));
  int steps = 0;
  for (const SensorStudy& study : experiment.sensors)
    steps = std::max(steps, study.checkpoints.back());
  for (const Variation& variation : experiment.variations) steps = std::max(steps, variation.step);
  if (substeps * steps > kMostSubstepsOfWalk)
    place.fail(fmt::format("{:.0f} substeps a step x {} steps are more than {:.0f}", substeps,
                           steps, kMostSubstepsOfWalk));
}

std::string anchors_problem(const Experiment& experiment) {
  if (experiment.anchors < experiment.world.landmarks) return "";
  return fmt::format("{} anchors leave none of {} landmarks to be mapped", experiment.anchors,
                     experiment.world.landmarks);
}

void check_variation(const Variation& variation, int landmarks, const JsonCursor& object) {
  if (static_cast<double>(landmarks) * variation.step > kMostEntries)
    object.fail(fmt::format("{} landmarks x {} steps are more than {} entries", landmarks,
                            variation.step, kMostEntries));
}

void check_sensor(const SensorStudy& study, int landmarks, const JsonCursor& object) {
  if (static_cast<double>(landmarks) * study.checkpoints.back() > kMostEntries)
    object.at("checkpoints")
        .fail(fmt::format("{} landmarks x {} steps are more than {} entries", landmarks,
                          study.checkpoints.back(), kMostEntries));
  check_grids(study.methods, landmarks, object.at("methods"));
}

}  // namespace

std::string room_problem(const WorldOptions& world) {
  const double spacing_m = world.landmark_diameter_m + world.gap_m;
  const double free_side_m = world.side_m - 2.0 * world.wall_margin_m - world.landmark_diameter_m;
  if (free_side_m <= 0.0)
    return fmt::format(
        "a room of {} m has no place for a landmark of {} m that keeps {} m from the walls",
        world.side_m, world.landmark_diameter_m, world.wall_margin_m);
  const double room = (free_side_m + spacing_m) * (free_side_m + spacing_m);
  const double each = std::numbers::pi / 4.0 * spacing_m * spacing_m;
  const double most = std::floor(kDensest * room / each);
  if (world.landmarks <= most) return "";
  return fmt::format(
      "{} landmarks of {} m, {} m apart, do not fit into a room of {} m: at most {:.0f} do",
      world.landmarks, world.landmark_diameter_m, world.gap_m, world.side_m, most);
}

std::string run_problem(const Experiment& experiment) {
  const int landmarks = experiment.world.landmarks;
  if (std::string problem = anchors_problem(experiment); !problem.empty()) return problem;
  if (std::string problem = room_problem(experiment.world); !problem.empty()) return problem;
  if (2.0 * experiment.walk.wall_margin_m >= experiment.world.side_m)
    return fmt::format("walls of {} m leave the robot no room", experiment.world.side_m);
  for (const SensorStudy& study : experiment.sensors) {
    if (static_cast<double>(landmarks) * study.checkpoints.back() > kMostEntries)
      return fmt::format("{} landmarks x {} steps are more than {} entries", landmarks,
                         study.checkpoints.back(), kMostEntries);
    for (const MethodGrid& grid : study.methods)
      if (on_graph(grid.method) && grid.parameters.back() >= landmarks)
        return fmt::format("K = {} of {} is not below the number of landmarks, {}",
                           grid.parameters.back(), info(grid.method).name, landmarks);
  }
  return "";
}

void check_experiment(const Experiment& experiment, const JsonCursor& document) {
  if (static_cast<long>(experiment.layouts) * experiment.poses > kMostRuns)
    document.fail(fmt::format("{} layouts x {} poses are more than {} runs", experiment.layouts,
                              experiment.poses, kMostRuns));
  if (const std::string problem = anchors_problem(experiment); !problem.empty())
    document.fail(problem);
  if (const std::string problem = room_problem(experiment.world); !problem.empty())
    document.at("world").fail(problem);
  check_walk(experiment, document);
  check_table_ids(experiment, document);
  for (const SensorStudy& study : experiment.sensors)
    check_sensor(study, experiment.world.landmarks,
                 document.at("sensors").at(std::string(name(study.sensor.sensor))));
  for (std::size_t i = 0; i < experiment.variations.size(); ++i)
    check_variation(experiment.variations[i], experiment.world.landmarks,
                    document.at("variations").element(i));
}

}  // namespace mapproof
