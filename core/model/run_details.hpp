#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/model/measurement.hpp"
#include "core/model/method.hpp"
#include "core/model/observation_manifold.hpp"
#include "core/model/study.hpp"
#include "core/model/world.hpp"

namespace mapproof {

/// What figures show of one sensor in one run beyond its maps.
struct SensorDetails {
  Sensor sensor = Sensor::kVisibility;
  int scan_step = 1;            ///< The step of the scan, counted from 1.
  double reach_m = 0.0;         ///< See Measurement.
  std::vector<View> views;      ///< Of the scan; see Measurement.
  Eigen::VectorXd values;       ///< Of the scan: M; NaN: missing.
  Eigen::MatrixXd first_steps;  ///< M x at most 60: how the observation history begins.
  int step = 0;                 ///< The last checkpoint, which the rest is of.
  /// Distances of the observation vectors, M (M - 1) / 2: those of landmark 0 to all after it, then
  /// of landmark 1, and so on; NaN where a pair has no step in common or one was never seen.
  Eigen::VectorXd distances;
  std::optional<ObservationManifold> manifold;  ///< Of these distances; empty: too few are known.
  /// The leading eigenvalues of each setting that has some.
  std::vector<std::pair<MethodSetting, Eigen::VectorXd>> spectra;
};

/// What figures show of one run beyond its records and maps.
struct RunDetails {
  RunId id;
  Path path;
  std::vector<SensorDetails> sensors;
};

/// The scan of one sensor as a figure shows it.
/// @param world  Of the same run.
Measurement measurement(const RunDetails& run, const SensorDetails& sensor, const World& world);

}  // namespace mapproof
