#pragma once

#include <optional>
#include <string>

#include "core/model/trial_study.hpp"

namespace mapproof {

/// What no single value of a record shows to be wrong, and where: "walk/wall_margin_m".
struct RecordFault {
  std::string pointer;
  std::string what;
};

/// Room for the landmarks, K below their number, sizes of the whole, ids of tables that others
/// could take: the first that is wrong.
std::optional<RecordFault> fault_of(const Experiment& experiment);

/// Sizes of the whole, and every combination of levels of every sweep.
std::optional<RecordFault> fault_of(const TrialExperiment& experiment);

/// SensorOptions::noise is at most this.
inline double greatest_noise(Sensor sensor) {
  return sensor == Sensor::kVisibility ? 0.5 : info(Factor::kNoise).maximum;
}

}  // namespace mapproof
