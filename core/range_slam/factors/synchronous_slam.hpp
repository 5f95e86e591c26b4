#pragma once

#include <optional>
#include <vector>

#include "core/model/range_log.hpp"
#include "core/model/slam.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"
#include "core/range_slam/factors/squared_ranges.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

/// Ranges to all landmarks at common times.
struct SynchronousRanges {
  Eigen::VectorXd time_s;       ///< T, ascending.
  Eigen::MatrixXd ranges_m;     ///< N x T.
  Eigen::Index incomplete = 0;  ///< Other times at which some landmark was ranged to.
};

/// The times at which every landmark was ranged to; of two readings of one at one time the later
/// one in the list.
/// @param ranges  Ascending in time.
/// @throws InvalidInput if a reading is of no landmark.
SynchronousRanges synchronous_ranges(const std::vector<RangeReading>& ranges,
                                     Eigen::Index landmarks);

/// What comes of ranges at common times.
struct SynchronousSlam {
  SlamEstimate estimate;
  MetricUpgrade upgrade;  ///< Where no landmark was known.
};

/// Spectral SLAM as the paper has it [boots2013, algorithm 1], without odometry: factorisation, map
/// by known landmarks or by the metric upgrade, and positions by localise().
/// @param known  Empty: no landmark is known; the map is then free to move and mirror.
/// @param noise  What is taken off squared ranges.
/// @return Empty path, NaN landmarks and a status where no map came out.
/// @throws InvalidInput if a bound is broken.
/// @note O(N^2 T) time.
SynchronousSlam synchronous_slam(const SynchronousRanges& ranges,
                                 const std::optional<KnownLandmarks>& known,
                                 const RangeNoise& noise = {});

}  // namespace mapproof
