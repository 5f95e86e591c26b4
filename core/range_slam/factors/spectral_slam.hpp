#pragma once

#include <cstdint>
#include <optional>

#include "core/model/range_log.hpp"
#include "core/model/slam.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"
#include "core/range_slam/factors/windowed_ranges.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

struct SpectralSlamOptions {
  std::optional<KnownLandmarks> known{};  ///< Empty: no landmark is known.
  bool with_heading = false;              ///< By map_with_heading(): a factorisation of rank 7.
  std::optional<WindowOptions> window{};  ///< Empty: chosen by choose_window().
  double heading_step_m = 1.0;            ///< Travel from one column with heading to the next, > 0.
  int replicates = 0;      ///< Of bootstrap_landmarks(), blocks a window long; 0: no covariances.
  std::uint64_t seed = 1;  ///< Of the bootstrap.
};

/// The estimate, and how it came about.
struct SpectralSlam {
  SlamEstimate estimate;
  WindowSearch window;    ///< Without trials where the window was given.
  MetricUpgrade upgrade;  ///< Where no landmark was known and heading not asked for.
  Eigen::MatrixXd Y;      ///< 1/2 d^2 at the times of the path, m^2: N x its size.
};

/// Spectral SLAM on a log of single measurements [boots2013]: windowed ranges at the odometry's
/// times, factorisation, map, and positions by localise().
///
/// No landmark known: odometry determines the reflection and the scale, and the map is defined up
/// to a rigid motion. No ground truth is used.
/// @param odometry  The dead-reckoned path, with headings where `with_heading`.
/// @return `path` at those times of odometry at which every landmark's range is determined
/// (kUndetermined
///         counts the others). With known landmarks positions are localise() of the map and Y;
///         without, odometry gives them their scale, and they the landmarks and the ranges theirs.
///         `range_scale` is that of the window times this correction, and Y is free of it;
///         `upgrade` is as it came. kUndetermined also where odometry does not distinguish the map
///         from its mirror image. Empty path, NaN landmarks and a status where no map came out:
///         kTooFewObservations if too few poses are determined; kDegenerateGeometry with a map
///         whose landmarks lie nearly on one line.
/// @throws InvalidInput if a bound is broken: for ranges that check_ranges() refuses, a
///         path_problem(), a known_problem(), a windowed_size_problem().
SpectralSlam spectral_slam(const RangeLog& log, const Trajectory& odometry,
                           const SpectralSlamOptions& options = {});

}  // namespace mapproof
