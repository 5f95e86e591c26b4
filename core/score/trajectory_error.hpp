#pragma once

#include <optional>

#include "core/align/rigid.hpp"
#include "core/model/slam/slam.hpp"

namespace mapproof {

/// The map from the frame of `path` to that of `ground truth` which an error is taken after: fitted
/// over the true poses within the time of `path`, at their times. Landmarks are not used.
/// @return Empty if the two have fewer than 2 poses in common.
/// @throws InvalidInput for a times_problem() of either path.
std::optional<Similarity> path_alignment(const Trajectory& path, const Trajectory& ground_truth,
                                         Alignment alignment);

/// Position errors at the times of the true poses that lie within the time of the estimate, whose
/// path is straight between its poses. A tenth is a tenth of that time; the best and the worst one
/// are sought among all that begin at a true pose.
///
/// @param true_landmarks  N x 2, NaN rows: not surveyed; or empty.
/// @return Empty if fewer than 2 poses can be compared. Landmarks without an estimated position do
///         not count.
/// @throws InvalidInput as above, or if the landmarks differ in number.
/// @note O(T log T).
std::optional<TrajectoryError> trajectory_error(const SlamEstimate& estimate,
                                                const Trajectory& ground_truth,
                                                const std::optional<Points>& true_landmarks,
                                                Alignment alignment);

}  // namespace mapproof
