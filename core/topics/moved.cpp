#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/association/moved.hpp"
#include "core/base/angle.hpp"
#include "core/base/random.hpp"
#include "core/base/stopwatch.hpp"
#include "core/model/detection_log.hpp"
#include "core/model/world.hpp"
#include "core/simulate/sensors.hpp"
#include "core/topics/topics.hpp"

namespace mapproof {
namespace {

/// A sensor of range and bearing.
struct DetectionSensor {
  double reach_m = 0.8;         ///< Landmarks farther away are not seen; > 0.
  double range_share = 0.02;    ///< Standard deviation of a range, as a share of it; >= 0.
  double bearing_rad = 0.0175;  ///< Of a bearing; >= 0.
};

/// A landmark that is at another position from some step on.
struct SimulatedMove {
  Eigen::Index landmark = 0;
  Eigen::RowVector2d by_m = Eigen::RowVector2d::Zero();
  Eigen::Index from_step = 0;
};

/// What the sensor sees along a path, one scan per step; nothing is occluded.
DetectionLog simulated_detections(const World& world, const Path& path,
                                  const DetectionSensor& sensor, const SimulatedMove& move,
                                  Random& random) {
  DetectionLog log;
  log.names = landmark_names(world.landmarks_m.rows());
  log.steps = static_cast<int>(path.positions_m.rows());
  for (int step = 0; step < log.steps; ++step)
    for (Eigen::Index k = 0; k < world.landmarks_m.rows(); ++k) {
      Eigen::RowVector2d to = world.landmarks_m.row(k) - path.positions_m.row(step);
      if (k == move.landmark && step >= move.from_step) to += move.by_m;
      const double range = to.norm();
      if (range > sensor.reach_m) continue;
      const double bearing = std::atan2(to.y(), to.x()) - path.headings_rad(step);
      log.detections.push_back(
          {.step = step,
           .landmark = static_cast<int>(k),
           .range_m = std::abs(range * (1.0 + sensor.range_share * random.normal())),
           .bearing_rad = wrapped(bearing + sensor.bearing_rad * random.normal())});
    }
  return log;
}

constexpr const char* kDistance = "distance";
constexpr const char* kNoise = "noise";
constexpr const char* kTest = "permutations";
constexpr const char* kMovedFactor = "moved_m";
constexpr const char* kNoiseShare = "range_noise_share";

TopicDesign moved_design(const TopicExperiment& experiment) {
  TopicDesign design;
  design.setups = {
      {kDistance,
       "Moves of several lengths",
       {{kMovedFactor, "length of the move", "m", list_option(experiment, "distances_m")}}},
      {kNoise,
       fmt::format("A move of {:g} m under noise", number_option(experiment, "distance_m")),
       {{kNoiseShare, "noise of the range, as a share of it", "",
         list_option(experiment, "noises")}}}};
  design.methods = {{kTest, "Permutation test of the position over time"}};
  design.quantities = {
      study_quantity("named_percent", "Share of moved landmarks named", "%", Better::kHigher),
      study_quantity("false_percent", "Share of logs that name another", "%", Better::kLower),
      study_quantity("step_error", "Error of the step", "", Better::kLower),
      study_quantity("length_error_m", "Error of the length of the move", "m", Better::kLower)};
  return design;
}

/// The results of several logs.
struct Tally {
  int tried = 0;
  int named = 0;
  int wrong = 0;
  double step_error = 0.0;
  double length_error_m = 0.0;

  void add(const MovedCheck& check, const SimulatedMove& move) {
    const double length = move.by_m.norm();
    bool other = false;
    ++tried;
    for (const MovedLandmark& moved : check.moved) {
      if (length == 0.0 || moved.landmark != move.landmark) {
        other = true;
        continue;
      }
      ++named;
      step_error += std::abs(static_cast<double>(moved.step) - static_cast<double>(move.from_step));
      length_error_m += std::abs(moved.distance_m - length);
    }
    wrong += other ? 1 : 0;
  }

  /// @param moves  False: nothing moved, so that no landmark should be named.
  std::map<std::string, double> values(bool moves) const {
    std::map<std::string, double> values{{"false_percent", 100.0 * wrong / tried}};
    if (moves) values["named_percent"] = 100.0 * named / tried;
    if (named == 0) return values;
    values["step_error"] = step_error / named;
    values["length_error_m"] = length_error_m / named;
    return values;
  }
};

SimulatedMove drawn_move(const TopicTask& context, double length, Random& random) {
  const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
  const auto M = static_cast<double>(context.world->landmarks_m.rows());
  const auto N = static_cast<double>(context.path->positions_m.rows());
  const auto landmark = static_cast<Eigen::Index>(random.uniform() * M);
  return {landmark,
          {length * std::cos(angle), length * std::sin(angle)},
          static_cast<Eigen::Index>(random.uniform(0.25, 0.75) * N)};
}

Tally tallied(const TopicTask& context, double length, double noise, Random& random,
              TopicPart& part) {
  Tally tally;
  const auto tried = static_cast<int>(number_option(context.experiment, "tried"));
  for (int k = 0; k < tried; ++k) {
    const SimulatedMove move = drawn_move(context, length, random);
    const DetectionLog log = simulated_detections(
        *context.world, *context.path,
        {.reach_m = number_option(context.experiment, "reach_m"), .range_share = noise}, move,
        random);
    const Stopwatch stopwatch;
    tally.add(find_moved(log, {.least_move = number_option(context.experiment, "least_move"),
                               .seed = random.next()}),
              move);
    part.seconds.push_back({part.id, kTest, stopwatch.seconds()});
  }
  return tally;
}

TopicPart make_moved(const TopicTask& context) {
  TopicPart part{.id = context.part, .run = context.run, .outcomes = {}, .maps = {}, .seconds = {}};
  Random random(context.seed);
  const double usual = number_option(context.experiment, "noise");
  for (const double length : list_option(context.experiment, "distances_m"))
    part.outcomes.push_back({condition(kDistance, {{kMovedFactor, length}}),
                             kTest,
                             tallied(context, length, usual, random, part).values(length > 0.0),
                             {}});
  const double length = number_option(context.experiment, "distance_m");
  for (const double noise : list_option(context.experiment, "noises"))
    part.outcomes.push_back({condition(kNoise, {{kNoiseShare, noise}}),
                             kTest,
                             tallied(context, length, noise, random, part).values(length > 0.0),
                             {}});
  return part;
}

}  // namespace

const Topic kMovedTopic = {
    .name = "moved",
    .of_data = false,
    .options = {{"distances_m", {0, 0.005, 0.01, 0.02, 0.05, 0.1, 0.5}, 0, 100, false, true},
                {"noises", {0.02, 0.05, 0.1, 0.2}, 0, 1, false, true},
                {"distance_m", {0.02}, 0, 100, false, false},
                {"noise", {0.02}, 0, 1, false, false},
                {"reach_m", {0.8}, 1e-3, 1e3, false, false},
                {"least_move", {0}, 0, 100, false, false},
                {"tried", {8}, 1, 1000, true, false}},
    .design = moved_design,
    .make = make_moved,
    .data_sets = nullptr};

}  // namespace mapproof
