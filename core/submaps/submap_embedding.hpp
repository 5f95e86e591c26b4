#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/embed/embedder.hpp"
#include "core/model/submaps.hpp"

namespace mapproof {

/// How landmarks are divided.
struct GroupOptions {
  int size = 20;  ///< Most landmarks of a group, >= 6.
  /// Share of a group that it borrows from its neighbours, in [0, 0.8].
  double overlap_share = 0.5;
  int neighbours = 8;  ///< K of the graph along which distances are measured, >= 1.
};

/// A group: its own landmarks and all of its members.
struct LandmarkGroup {
  std::vector<Eigen::Index> own;      ///< Ascending; each landmark is in one group's own part.
  std::vector<Eigen::Index> members;  ///< Ascending: these, and the nearest others.
};

/// Divides landmarks into overlapping groups of neighbours: halved repeatedly between two that are
/// far from each other along the neighbour graph, until a group's own part is small enough; then
/// each group adds the nearest others.
///
/// @param distances  M x M, symmetric, zero diagonal, >= 0; infinite: nothing is known.
/// @return One group of all if M <= size.
/// @throws InvalidInput if the options are out of bounds.
/// @note O(M^2 K log M) time. Deterministic.
std::vector<LandmarkGroup> overlapping_groups(const Eigen::MatrixXd& distances,
                                              const GroupOptions& options = {});

/// How a map is made of sub-maps.
struct SubmapOptions {
  GroupOptions groups;
  EmbedderOptions embedder;
  ProximityRule rule;  ///< Of each group's observations alone; empty: proximities().
};

/// A whole map made of sub-maps.
struct SubmapEmbedding {
  Embedding embedding;  ///< M rows; its statuses include those of sub-maps and joins.
  JoinedSubmaps joined;
  double median_residual = 0.0;  ///< Of the joins, relative; NaN without any.
};

/// Maps overlapping groups of landmarks separately, by any method, and joins the maps [yairi2007,
/// sections 5.1 and 5.2]. LLE, LEM, HLLE and KPCA are joined by affine maps, the others by
/// similarities.
///
/// A step that shows none of a group's landmarks is left out of its observations. A method's
/// parameter is taken as it is, K at most one below a group's size.
/// @param history  Landmarks never observed get NaN rows and a status.
/// @throws InvalidInput if `steps` or the options are out of bounds.
/// @note O(M^2 N) time for the distances that groups are made by, and a method's own for each group
///       of n instead of M.
SubmapEmbedding embed_submaps(const ObservationHistory& history, Eigen::Index steps,
                              const MethodSetting& setting, const SubmapOptions& options = {});

/// The type of transformation that joins a method's sub-maps.
bool joined_by_affine(Method method);

}  // namespace mapproof
