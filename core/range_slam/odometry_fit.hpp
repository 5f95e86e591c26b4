#pragma once

#include "core/model/points.hpp"

namespace mapproof {

/// What a dead-reckoned path says of a map that is known up to a motion, a mirror and a scale.
struct OdometryFit {
  double scale = 1.0;      ///< Length on the map over length by odometry.
  bool mirrored = false;   ///< The map turns the other way round than the robot did.
  double agreement = 0.0;  ///< 0 if mirror image and original fit odometry alike, 1 if one alone.
};

/// Compares short pieces of both paths, each free to turn and shift, so that the drift of odometry
/// over the whole does no harm: of each piece the similarity that takes the odometry to the map, by
/// least squares, as it is and mirrored.
/// @param positions_m, odometry_m  T x 2, the same times.
/// @param piece  Poses in a piece, >= 2.
/// @return Scale 1 and agreement 0 where nothing moves; scale 1 where the map does not.
/// @throws InvalidInput if a bound is broken.
OdometryFit fit_to_odometry(const Points& positions_m, const Points& odometry_m,
                            Eigen::Index piece);

}  // namespace mapproof
