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

/// The increasing values nearest to `values` in least squares, in the order given (pool adjacent
/// violators).
std::vector<double> increasing_fit(const std::vector<double>& values);

}  // namespace mapproof
