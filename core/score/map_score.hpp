#pragma once

#include <optional>
#include <vector>

#include "core/model/embedding.hpp"
#include "core/model/experiment.hpp"
#include "core/model/score.hpp"

namespace mapproof {

/// An embedding brought into the frame of its anchors.
struct AlignedMap {
  Points positions_m;            ///< M x 2; NaN rows where a landmark has no place.
  bool aligned = false;          ///< False: the positions are the embedding's own coordinates.
  std::vector<Status> statuses;  ///< kAnchorsMissing, kAnchorsDegenerate.
};

/// Fits the affine map over the anchors that were mapped and applies it to all landmarks.
/// @param coordinates  M x 2; NaN rows where a landmark has no place.
/// @param anchors_m    M x 2 true positions, read at the rows `anchors` alone.
/// @throws InvalidInput if the rows differ in number, an anchor is none of them, or 3 anchors or
///         more are mapped but lie on one line in `anchors_m`.
AlignedMap align_to_anchors(const Points& coordinates, const Points& anchors_m,
                            const std::vector<Eigen::Index>& anchors, AffineFit fit);

/// Scores a map against the truth over the landmarks that both hold (NaN rows do not count).
/// @return Empty if fewer than 3 landmarks can be compared. Single numbers are NaN where they have
///         nothing to stand on (see score.hpp).
/// @throws InvalidInput if the rows differ in number, or an anchor is none of them.
std::optional<Score> score_map(const Points& estimate_m, const Points& truth_m,
                               const std::vector<Eigen::Index>& anchors, AffineFit fit);

}  // namespace mapproof
