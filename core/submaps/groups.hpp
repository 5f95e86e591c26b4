#pragma once

#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// How landmarks are divided.
struct GroupOptions {
  int size = 20;  ///< Most landmarks of a group, >= 6.
  /// Share of a group that it borrows from its neighbours, in [0, 0.8].
  double overlap_share = 0.5;
  int neighbours = 8;  ///< K of the graph along which distances are measured, >= 1.
};

/// A group with what it has for itself.
struct LandmarkGroup {
  std::vector<Eigen::Index> own;      ///< Ascending; each landmark is one group's own.
  std::vector<Eigen::Index> members;  ///< Ascending: these, and the nearest others.
};

/// Divides landmarks into overlapping groups of neighbours: halved again and again between two that
/// are far from each other along the neighbour graph, until a group's own part is small enough;
/// then each group takes in the nearest others.
///
/// @param distances  M x M, symmetric, zero diagonal, >= 0; infinite: nothing is known.
/// @return One group of all if M <= size.
/// @throws InvalidInput if the options are out of bounds.
/// @note O(M^2 K log M) time. Deterministic.
std::vector<LandmarkGroup> overlapping_groups(const Eigen::MatrixXd& distances,
                                              const GroupOptions& options = {});

}  // namespace mapproof
