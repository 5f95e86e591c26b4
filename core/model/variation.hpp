#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/anchor_placement.hpp"
#include "core/model/method.hpp"
#include "core/model/score.hpp"
#include "core/model/sensor.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// What a variation changes from one level to the next, everything else being as in the study.
enum class Factor {
  kNoise,             ///< SensorOptions::noise.
  kDropoutShare,      ///< SensorOptions::dropout_share.
  kAnchors,           ///< Experiment::anchors.
  kSmacofFall,        ///< SolverOptions::smacof_relative_fall.
  kSmacofKnnFall,     ///< SolverOptions::smacof_knn_relative_fall.
  kOnlySeenTogether,  ///< SolverOptions::only_seen_together: 0 or 1.
  kSide,              ///< WorldOptions::side_m.
  kLandmarks,         ///< WorldOptions::landmarks.
  kDiameter,          ///< WorldOptions::landmark_diameter_m.
  kReach,             ///< How far a landmark may be and still be observed, m.
  kSteps,             ///< The only checkpoint.
};

/// Everything about a factor that its readers ask.
struct FactorInfo {
  Factor factor;
  std::string_view name;  ///< In files: "dropout_share".
  bool integer;
  double minimum;  ///< Inclusive.
  double maximum;  ///< Inclusive.
  bool of_world;   ///< Another level makes another world or walk: no variation, only a sweep.
};

const FactorInfo& info(Factor factor);

/// The names of these factors, in their order.
std::vector<std::string_view> factor_names();

struct Experiment;

/// Sets the factor, of the sensor if it is one of a sensor, to that level. A reach of visibility is
/// the visual angle of a landmark that far away.
/// @throws InvalidInput if the experiment does not have the sensor.
void set_level(Experiment& experiment, Sensor sensor, Factor factor, double level);

/// A side study: some methods over the levels of one factor, at one step of every run.
struct Variation {
  std::string id;  ///< [a-z][a-z0-9-]*, unique in the experiment.
  Sensor sensor = Sensor::kVisibility;
  Factor factor = Factor::kNoise;
  std::vector<double> levels;  ///< Ascending.
  int step = 0;
  /// Where the anchors stand; empty: as in the experiment.
  std::optional<AnchorPlacement> placement;
  std::vector<MethodSetting> settings;
};

/// How one map of a variation came out.
struct VariationRecord {
  std::string variation;  ///< Its id.
  double level = 0.0;
  MethodSetting setting;
  std::vector<Status> statuses;
  std::optional<Score> score;  ///< Empty if no map came out.
};

}  // namespace mapproof
