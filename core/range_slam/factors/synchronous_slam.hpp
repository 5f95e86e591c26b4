#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/model/range_log.hpp"
#include "core/model/slam/slam.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"
#include "core/range_slam/factors/squared_ranges.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

/// Landmarks in space whose position is given.
struct KnownSpaceLandmarks {
  std::vector<Eigen::Index> rows;  ///< In the map, all different.
  SpacePoints positions_m;         ///< As many as rows, finite.
};

/// Spectral SLAM in space: squared ranges have rank 5 there, [|m|^2/2, m, 1] times
/// [1, -p, |p|^2/2]', and all else is as in the plane [boots2013, algorithm 1 and section 2].
/// @param ranges_m  N x T, finite: all landmarks at all times.
/// @param known     Empty: no landmark is known; the map is then defined up to a rigid motion and a
/// reflection.
/// @param noise     What is taken off squared ranges.
/// @return An empty path, NaN landmarks and a status where no map came out: kTooFewObservations
///         below 5 landmarks, 5 known ones, or 13 steps; kRankDeficient and kDegenerateGeometry
///         where landmarks or path keep to a plane or sphere, or come nearer to one than noise
///         allows to detect. kUndetermined with a map where another quadric fits nearly as well.
/// @throws InvalidInput if a bound is broken.
/// @note O(N^2 T) time.
SpaceEstimate space_slam(const Eigen::MatrixXd& ranges_m,
                         const std::optional<KnownSpaceLandmarks>& known,
                         const RangeNoise& noise = {});

/// Ranges to all landmarks at common times.
struct SynchronousRanges {
  Eigen::VectorXd time_s;       ///< T, ascending.
  Eigen::MatrixXd ranges_m;     ///< N x T.
  Eigen::Index incomplete = 0;  ///< Other times at which some landmark was ranged to.
};

/// The times at which every landmark was ranged to; of two measurements of one at one time the
/// later one in the list.
/// @param ranges  Ascending in time.
/// @throws InvalidInput if a measurement is of no landmark.
SynchronousRanges synchronous_ranges(const std::vector<RangeMeasurement>& ranges,
                                     Eigen::Index landmarks);

/// What comes of ranges at common times.
struct SynchronousSlam {
  SlamEstimate estimate;
  MetricUpgrade upgrade;  ///< Where no landmark was known.
};

/// Spectral SLAM as the paper has it [boots2013, algorithm 1], without odometry: factorisation, map
/// by known landmarks or by the metric upgrade, and positions by localise().
/// @param known  Empty: no landmark is known; the map is then defined up to a rigid motion and a
/// reflection.
/// @param noise  What is taken off squared ranges.
/// @return Empty path, NaN landmarks and a status where no map came out.
/// @throws InvalidInput if a bound is broken.
/// @note O(N^2 T) time.
SynchronousSlam synchronous_slam(const SynchronousRanges& ranges,
                                 const std::optional<KnownLandmarks>& known,
                                 const RangeNoise& noise = {});

}  // namespace mapproof
