#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// How poses of two paths are associated by their times.
struct TimeAssociation {
  double offset_s = 0.0;        ///< Added to the times of the estimate.
  double largest_gap_s = 0.01;  ///< Poses farther apart in time are not associated, >= 0.
};

/// A pose of the ground truth and the one of the estimate that belongs to it.
struct PosePair {
  Eigen::Index ground_truth = 0;
  Eigen::Index estimate = 0;

  bool operator==(const PosePair&) const = default;
};

/// For each pose of the path with fewer poses (of the estimate if both have as many) the nearest in
/// time of the other one, the earlier of two as near; as evo associates them [grupp2017].
/// @param ground_truth_s, estimate_s  Times, not descending.
/// @return In the order of the shorter path. A pose of the longer one may be in several pairs.
/// @throws InvalidInput unless the largest gap is finite and >= 0, and the offset finite.
/// @note O(n log m) for n poses of the shorter path.
std::vector<PosePair> associate_times(const Eigen::VectorXd& ground_truth_s,
                                      const Eigen::VectorXd& estimate_s,
                                      const TimeAssociation& association);

}  // namespace mapproof
