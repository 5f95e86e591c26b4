#pragma once

#include <vector>

#include "core/model/status.hpp"
#include "core/model/submaps.hpp"
#include "core/submaps/join.hpp"

namespace mapproof {

/// What may be done to a sub-map to fit it to the others; a mirror image always may.
enum class JoinKind {
  kRigid,       ///< Turn and shift.
  kSimilarity,  ///< And scale: maps whose axes have one scale.
  kAffine,      ///< Any affine map: eigenmaps, whose axes have a scale each.
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
///  4. all of them together: each is fitted to the mean places of its shared landmarks, and these
///     are taken again, robustly, until they rest.
/// The largest tree is placed; the other sub-maps are marked and named in the statuses.
///
/// @param maps       Finite positions; ascending landmarks, all < `landmarks`; one map or more.
/// @param kind       kSimilarity or kAffine.
/// @param landmarks  M of the whole map.
/// @throws InvalidInput if the bounds above are broken.
/// @note O(G^2 n + iterations G n) time for G maps of n landmarks. Deterministic.
JoinResult join_submaps(std::vector<Submap> maps, JoinKind kind, Eigen::Index landmarks);

}  // namespace mapproof
