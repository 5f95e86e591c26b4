#pragma once

#include <optional>
#include <vector>

#include "core/model/embedding.hpp"
#include "core/model/experiment.hpp"
#include "core/model/points.hpp"
#include "core/model/score.hpp"

namespace mapproof {

/// Mean orientation error: the share, in percent, of landmark triples whose orientation differs
/// from that in the ground truth [yairi2007, section 4.1]. Triples on one line in the ground truth,
/// to 1e-12 of the sine at their first landmark, do not count; a triple that the estimate flattens
/// counts as wrong.
///
/// @param ground truth, estimate  n x 2, finite, row by row the same landmarks.
/// @return NaN if there is no triple to judge.
/// @throws InvalidInput if the sizes differ.
/// @note O(n^3) time up to 5000 landmarks. Above that over ten million triples, drawn by a fixed
/// seed:
///       a standard error of 0.016 percentage points or less.
double orientation_error_percent(const Points& ground_truth, const Points& estimate);

/// An embedding brought into the frame of its anchors.
struct AlignedMap {
  Points positions_m;            ///< M x 2; NaN rows where a landmark has no position.
  bool aligned = false;          ///< False: the positions are the embedding's own coordinates.
  std::vector<Status> statuses;  ///< kAnchorsMissing, kAnchorsDegenerate.
};

/// Fits the affine map over the anchors that were mapped and applies it to all landmarks.
/// @param coordinates  M x 2; NaN rows where a landmark has no position.
/// @param anchors_m    M x 2 true positions, read at the rows `anchors` alone.
/// @throws InvalidInput if the rows differ in number, an anchor is none of them, or 3 anchors or
///         more are mapped but lie on one line in `anchors_m`.
AlignedMap align_to_anchors(const Points& coordinates, const Points& anchors_m,
                            const std::vector<Eigen::Index>& anchors, AffineFit fit);

/// Scores a map against the ground truth over the landmarks that both hold (NaN rows do not count).
/// @return Empty if fewer than 3 landmarks can be compared. Single numbers are NaN where they are
///         undefined (see score.hpp).
/// @throws InvalidInput if the rows differ in number, or an anchor is none of them.
std::optional<Score> score_map(const Points& estimate_m, const Points& ground_truth_m,
                               const std::vector<Eigen::Index>& anchors, AffineFit fit);

}  // namespace mapproof
