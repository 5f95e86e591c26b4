#pragma once

#include <vector>

#include "core/model/status.hpp"
#include "core/model/submaps.hpp"
#include "core/submaps/join.hpp"

namespace mapproof {

/// The transformations that may fit a sub-map to the others; reflection always may.
enum class JoinKind {
  kRigid,       ///< Rotation and translation.
  kSimilarity,  ///< And scale: maps whose axes have one scale.
  kAffine,      ///< Any affine map: eigenmaps, each of whose axes has its own scale.
};

/// A joined map with its warnings.
struct JoinResult {
  JoinedSubmaps joined;
  std::vector<Status> statuses;  ///< kTooFewObservations: sub-maps that nothing ties to the others.
};

/// Joins sub-maps by the landmarks that they share, in four steps:
///  1. two that share 3 landmarks or more, not on one line, are fitted to each other, robustly;
///  2. similarity: the scales that agree best with all fits, in least squares of their logarithms;
///  3. a spanning tree of the best fits places all of them;
///  4. all of them together: each is fitted to the mean positions of its shared landmarks, and
/// these are computed again, robustly, until they converge.
/// The largest tree is placed; the other sub-maps are marked and named in the statuses.
///
/// @param maps       Finite positions; ascending landmarks, all < `landmarks`; one map or more.
/// @param kind       kSimilarity or kAffine.
/// @param landmarks  M of the whole map.
/// @throws InvalidInput if the bounds above are broken.
/// @note O(G^2 n + iterations G n) time for G maps of n landmarks. Deterministic.
JoinResult join_submaps(std::vector<Submap> maps, JoinKind kind, Eigen::Index landmarks);

}  // namespace mapproof
