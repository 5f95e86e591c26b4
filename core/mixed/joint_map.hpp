#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/model/embedding.hpp"

namespace mapproof {

struct JointMapOptions {
  int rounds = 20;  ///< >= 1.
};

struct JointMap {
  Embedding embedding;
  std::vector<double> shares;  ///< Of each sensor in the weights of all pairs; their sum is 1.
};

/// One map of several manifolds of observations that are the plane, each bent in its own way
/// [yairi2007, section 6]: of each sensor only the order of its distances is trusted.
///
/// In turn, each sensor's distances become the increasing function of them that fits the map's best
/// (monotone regression [kruskal1964]), with the variance about it that pairs of such a distance
/// have; and the map takes a few steps of SMACOF towards their mean over the sensors, weighted by
/// these variances' inverses. So a sensor that cannot tell far pairs apart has a say in near ones.
/// @param distances  Of each sensor, M x M; infinite: not known.
/// @param start      M x 2, finite.
/// @return kFailed if the pairs that some sensor knows leave the landmarks in pieces.
/// @throws InvalidInput if sizes differ or a bound is broken.
/// @note O(M^2 log M) a round and sensor, and O(M^3) for the sparse solve's factor.
JointMap joint_map(const std::vector<Eigen::MatrixXd>& distances, const Points& start,
                   const JointMapOptions& options = {});

/// How badly a map agrees with the order of the sensors' distances: the mean over all pairs that a
/// sensor knows of half the logarithm of the variance about the increasing fit, in units of the
/// map's mean square distance from its centre; at least half of log(1e-4) for each. What
/// joint_map() lowers, but for rounds; so maps from several starts can be compared.
/// @param map  M x 2, finite, no point.
/// @throws InvalidInput if sizes differ or a bound is broken.
double order_misfit(const std::vector<Eigen::MatrixXd>& distances, const Points& map);

/// The joint map from whichever start ends in the least order_misfit(); of equal ones the first. A
/// sensor whose bends the one start shares would confirm itself: so each has its start.
/// @param starts  One or more, as joint_map() needs them.
/// @throws InvalidInput without a start, or as joint_map().
JointMap best_joint_map(const std::vector<Eigen::MatrixXd>& distances,
                        const std::vector<Points>& starts, const JointMapOptions& options = {});

/// The increasing values nearest to `values` in least squares, in the order given (pool adjacent
/// violators).
std::vector<double> increasing_fit(const std::vector<double>& values);

}  // namespace mapproof
