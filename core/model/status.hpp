#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/model/method.hpp"

namespace mapproof {

/// Why a solve ended with a warning or failed. Data, never an exception: drawn on figures, listed
/// in reports.
enum class StatusCode {
  kBridged,              ///< The neighbour graph was in pieces; joined by the shortest bridges.
  kNotConverged,         ///< The iteration limit came before the stop rule.
  kUncertified,          ///< The answer of a semidefinite program was not certified as the optimum.
  kRankDeficient,        ///< Fewer than two dimensions in the data: the map is flat or a point.
  kUndetermined,         ///< Other maps fit equally well; which of them came out is arbitrary.
  kArbitraryNeighbours,  ///< Landmarks with fewer than K others ever seen together with them.
  kLandmarkUnseen,       ///< Landmarks never observed; they are missing from the map.
  kDistancesCompleted,   ///< Pairs without a common step took the shortest path over the others.
  kNotEuclidean,         ///< No points have the observed distances; the nearest that some have were
                         ///< taken.
  kAnchorsMissing,       ///< Too few mapped anchors for an affine map: no score.
  kAnchorsDegenerate,    ///< Anchors nearly on one line in the embedding: the affine map is
                         ///< arbitrary.
  kDegenerateGeometry,   ///< Known landmarks or path in a special position, e.g. on one line or
                         ///< circle: the condition number shows it.
  kTooFewObservations,   ///< Fewer steps, landmarks or measurements than the method needs.
  kLeftOut,              ///< Landmarks to which a method of others gives no position.
  kFailed,               ///< No map came out at all; the reason gives the cause.
};

/// Why, in the order of kStatusReasons. The sentences are in render/figures/status_text.
enum class StatusReason {
  // Of the embeddings.
  kSameObservations,
  kGroupsNeverTogether,
  kTooFewLandmarks,
  kTooManyNeighbours,
  kNoSharedObservation,
  kNoCommonStep,
  kHessianNeighbours,
  kHessianNeighbourhoods,
  kNeverObserved,
  kFewSteps,
  kGraphInPieces,
  kClosedGroups,
  kLandmarksUntied,
  kFewSeenTogether,
  kBoundBelowZero,
  kNoBound,
  kVarianceTooGreat,
  kLooseBound,
  kDistancesNotKept,
  kDistancesFlat,
  kUnfoldedFlat,
  kEigenvaluesNotConverged,
  kEqualEigenvalues,
  kEqualSmallestEigenvalues,
  kNeighbourhoodsFlat,
  kNeighbourhoodsNotEuclidean,
  kNoTangentPlane,
  kStressFalling,
  kFlatMap,
  kEqualKernel,
  // Of the alignment to anchors.
  kFewAnchorsMapped,
  kAnchorsOnALine,
  kFewAnchorsSoFar,
  kFewKnownMapped,
  // Of sub-maps, missing data, pairs, several sensors and incremental maps.
  kNoSubmap,
  kSubmapsLeftOut,
  kLikelihoodRising,
  kLossFalling,
  kTrustedPairsInPieces,
  kNotCovisible,
  kNeverMeasuredTogether,
  kNotWithTheMapped,
  kFewPairs,
  kTooFewPairs,
  kNoSensorShares,
  kNoSensorObserved,
  kNotObservedSoFar,
  // Of range-only SLAM.
  kFilterLost,
  kFewStepsWithMotion,
  kFrameNotTied,
  kFlatInSpace,
  kFewCommonRanges,
  kFewLandmarksAtSteps,
  kLandmarksNearlyOnALine,
  kPathNearlyOnALine,
  kTooFewRanges,
  kNoQuadric,
  kOtherQuadric,
  kMappedOnALine,
  kRankOfRanges,
  kNoCovariances,
  kCovariancesOfFirstPose,
  kLeastSquaresNotConverged,
  kNoDecreasingStep,
  kFewStates,
  kStatesFlat,
  kFewKnownLandmarks,
  kKnownDegenerate,
  kRankOfPath,
  kStepsFlat,
  kMirrorImage,
  kFewPosesWithRanges,
  kPosesWithoutWindow,
  kNoKnownLandmark,
  kNoOdometry,
  kNoOdometryForHeadings,
  kNoStart,
  // Of the methods of others.
  kMethodLeftOut,
  kMethodNotStarted,
  kMethodTimeout,
  kMethodEnded,
  kMethodReply,
  kMethodNumbers,
  kMethodRefused,
  kMessage,
};

/// Whether a status names landmarks.
enum class StatusNames { kNone, kOne, kSome, kIfKnown };

/// What a reason is called in files, and what a status with it holds.
struct StatusReasonInfo {
  StatusReason reason;
  StatusCode code;  ///< Unless a part of a solve ended so, and the whole otherwise.
  std::string_view name;
  std::string_view values = {};  ///< What each value is: "neighbours, pieces".
  StatusNames names = StatusNames::kNone;

  constexpr std::size_t value_count() const {
    return values.empty() ? 0 : 1 + static_cast<std::size_t>(std::ranges::count(values, ','));
  }
};

inline constexpr std::array kStatusReasons = {
    StatusReasonInfo{StatusReason::kSameObservations, StatusCode::kRankDeficient,
                     "same_observations"},
    StatusReasonInfo{StatusReason::kGroupsNeverTogether, StatusCode::kUndetermined,
                     "groups_never_together", "groups"},
    StatusReasonInfo{StatusReason::kTooFewLandmarks, StatusCode::kFailed, "too_few_landmarks",
                     "landmarks"},
    StatusReasonInfo{StatusReason::kTooManyNeighbours, StatusCode::kFailed, "too_many_neighbours",
                     "neighbours, landmarks"},
    StatusReasonInfo{StatusReason::kNoSharedObservation, StatusCode::kFailed,
                     "no_shared_observation"},
    StatusReasonInfo{StatusReason::kNoCommonStep, StatusCode::kDistancesCompleted, "no_common_step",
                     "pairs"},
    StatusReasonInfo{StatusReason::kHessianNeighbours, StatusCode::kFailed, "hessian_neighbours",
                     "least_neighbours, neighbours"},
    StatusReasonInfo{StatusReason::kHessianNeighbourhoods, StatusCode::kFailed,
                     "hessian_neighbourhoods", "least_neighbours, landmarks_with_fewer"},
    StatusReasonInfo{StatusReason::kNeverObserved, StatusCode::kLandmarkUnseen, "never_observed",
                     "unobserved, landmarks", StatusNames::kIfKnown},
    StatusReasonInfo{StatusReason::kFewSteps, StatusCode::kTooFewObservations, "few_steps",
                     "steps, least_steps"},
    StatusReasonInfo{StatusReason::kGraphInPieces, StatusCode::kBridged, "graph_in_pieces",
                     "neighbours, pieces, longest_bridge"},
    StatusReasonInfo{StatusReason::kClosedGroups, StatusCode::kBridged, "closed_groups",
                     "neighbours_added"},
    StatusReasonInfo{StatusReason::kLandmarksUntied, StatusCode::kBridged, "landmarks_untied",
                     "landmarks"},
    StatusReasonInfo{StatusReason::kFewSeenTogether, StatusCode::kArbitraryNeighbours,
                     "few_seen_together", "landmarks, neighbours, pieces"},
    StatusReasonInfo{StatusReason::kBoundBelowZero, StatusCode::kNotEuclidean, "bound_below_zero",
                     "constraint_residual"},
    StatusReasonInfo{StatusReason::kNoBound, StatusCode::kUncertified, "no_bound",
                     "excess_residual"},
    StatusReasonInfo{StatusReason::kVarianceTooGreat, StatusCode::kUncertified,
                     "variance_too_great", "bound_percent, excess_residual"},
    StatusReasonInfo{StatusReason::kLooseBound, StatusCode::kUncertified, "loose_bound",
                     "gap_percent, excess_residual"},
    StatusReasonInfo{StatusReason::kDistancesNotKept, StatusCode::kUncertified,
                     "distances_not_kept", "excess_residual"},
    StatusReasonInfo{StatusReason::kDistancesFlat, StatusCode::kRankDeficient, "distances_flat",
                     "directions"},
    StatusReasonInfo{StatusReason::kUnfoldedFlat, StatusCode::kRankDeficient, "unfolded_flat",
                     "directions"},
    StatusReasonInfo{StatusReason::kEigenvaluesNotConverged, StatusCode::kNotConverged,
                     "eigenvalues_not_converged"},
    StatusReasonInfo{StatusReason::kEqualEigenvalues, StatusCode::kUndetermined,
                     "equal_eigenvalues", "eigenvalue"},
    StatusReasonInfo{StatusReason::kEqualSmallestEigenvalues, StatusCode::kUndetermined,
                     "equal_smallest_eigenvalues", "first, second, third"},
    StatusReasonInfo{StatusReason::kNeighbourhoodsFlat, StatusCode::kRankDeficient,
                     "neighbourhoods_flat"},
    StatusReasonInfo{StatusReason::kNeighbourhoodsNotEuclidean, StatusCode::kNotEuclidean,
                     "neighbourhoods_not_euclidean", "neighbourhoods, landmarks"},
    StatusReasonInfo{StatusReason::kNoTangentPlane, StatusCode::kRankDeficient, "no_tangent_plane",
                     "neighbourhoods, landmarks"},
    StatusReasonInfo{StatusReason::kStressFalling, StatusCode::kNotConverged, "stress_falling",
                     "iterations"},
    StatusReasonInfo{StatusReason::kFlatMap, StatusCode::kRankDeficient, "flat_map"},
    StatusReasonInfo{StatusReason::kEqualKernel, StatusCode::kUndetermined, "equal_kernel",
                     "second_over_mean_eigenvalue"},
    StatusReasonInfo{StatusReason::kFewAnchorsMapped, StatusCode::kAnchorsMissing,
                     "few_anchors_mapped", "mapped, anchors"},
    StatusReasonInfo{StatusReason::kAnchorsOnALine, StatusCode::kAnchorsDegenerate,
                     "anchors_on_a_line"},
    StatusReasonInfo{StatusReason::kFewAnchorsSoFar, StatusCode::kAnchorsMissing,
                     "few_anchors_so_far", "mapped"},
    StatusReasonInfo{StatusReason::kFewKnownMapped, StatusCode::kAnchorsMissing, "few_known_mapped",
                     "mapped"},
    StatusReasonInfo{StatusReason::kNoSubmap, StatusCode::kFailed, "no_submap"},
    StatusReasonInfo{StatusReason::kSubmapsLeftOut, StatusCode::kTooFewObservations,
                     "submaps_left_out", "left_out, submaps"},
    StatusReasonInfo{StatusReason::kLikelihoodRising, StatusCode::kNotConverged,
                     "likelihood_rising", "iterations"},
    StatusReasonInfo{StatusReason::kLossFalling, StatusCode::kNotConverged, "loss_falling",
                     "iterations"},
    StatusReasonInfo{StatusReason::kTrustedPairsInPieces, StatusCode::kFailed,
                     "trusted_pairs_in_pieces"},
    StatusReasonInfo{StatusReason::kNotCovisible, StatusCode::kDistancesCompleted, "not_covisible",
                     "pairs, without_common_step"},
    StatusReasonInfo{StatusReason::kNeverMeasuredTogether, StatusCode::kLandmarkUnseen,
                     "never_measured_together", "", StatusNames::kSome},
    StatusReasonInfo{StatusReason::kNotWithTheMapped, StatusCode::kTooFewObservations,
                     "not_with_the_mapped", "mapped", StatusNames::kSome},
    StatusReasonInfo{StatusReason::kFewPairs, StatusCode::kUndetermined, "few_pairs", "",
                     StatusNames::kSome},
    StatusReasonInfo{StatusReason::kTooFewPairs, StatusCode::kFailed, "too_few_pairs", "pairs"},
    StatusReasonInfo{StatusReason::kNoSensorShares, StatusCode::kFailed, "no_sensor_shares"},
    StatusReasonInfo{StatusReason::kNoSensorObserved, StatusCode::kLandmarkUnseen,
                     "no_sensor_observed", "landmarks"},
    StatusReasonInfo{StatusReason::kNotObservedSoFar, StatusCode::kLandmarkUnseen,
                     "not_observed_so_far", "unobserved, landmarks"},
    StatusReasonInfo{StatusReason::kFilterLost, StatusCode::kNotConverged, "filter_lost",
                     "gated_ranges, ranges"},
    StatusReasonInfo{StatusReason::kFewStepsWithMotion, StatusCode::kTooFewObservations,
                     "few_steps_with_motion", "landmarks, steps, least_landmarks, least_steps"},
    StatusReasonInfo{StatusReason::kFrameNotTied, StatusCode::kUndetermined, "frame_not_tied",
                     "known_with_ranges, known"},
    StatusReasonInfo{StatusReason::kFlatInSpace, StatusCode::kDegenerateGeometry, "flat_in_space",
                     "condition"},
    StatusReasonInfo{StatusReason::kFewCommonRanges, StatusCode::kTooFewObservations,
                     "few_common_ranges", "landmarks, times, least_landmarks, least_times"},
    StatusReasonInfo{StatusReason::kFewLandmarksAtSteps, StatusCode::kTooFewObservations,
                     "few_landmarks_at_steps", "landmarks, steps, least_landmarks, least_steps"},
    StatusReasonInfo{StatusReason::kLandmarksNearlyOnALine, StatusCode::kDegenerateGeometry,
                     "landmarks_nearly_on_a_line", "condition"},
    StatusReasonInfo{StatusReason::kPathNearlyOnALine, StatusCode::kUndetermined,
                     "path_nearly_on_a_line", "condition"},
    StatusReasonInfo{StatusReason::kTooFewRanges, StatusCode::kLandmarkUnseen, "too_few_ranges", "",
                     StatusNames::kSome},
    StatusReasonInfo{StatusReason::kNoQuadric, StatusCode::kDegenerateGeometry, "no_quadric",
                     "dimensions, condition"},
    StatusReasonInfo{StatusReason::kOtherQuadric, StatusCode::kUndetermined, "other_quadric",
                     "misfit_ratio, condition"},
    StatusReasonInfo{StatusReason::kMappedOnALine, StatusCode::kDegenerateGeometry,
                     "mapped_on_a_line"},
    StatusReasonInfo{StatusReason::kRankOfRanges, StatusCode::kRankDeficient, "rank_of_ranges",
                     "rank, least_rank, condition"},
    StatusReasonInfo{StatusReason::kNoCovariances, StatusCode::kUndetermined, "no_covariances"},
    StatusReasonInfo{StatusReason::kCovariancesOfFirstPose, StatusCode::kUndetermined,
                     "covariances_of_first_pose"},
    StatusReasonInfo{StatusReason::kLeastSquaresNotConverged, StatusCode::kNotConverged,
                     "least_squares_not_converged", "iterations"},
    StatusReasonInfo{StatusReason::kNoDecreasingStep, StatusCode::kFailed, "no_decreasing_step"},
    StatusReasonInfo{StatusReason::kFewStates, StatusCode::kTooFewObservations, "few_states",
                     "states, others, least_states, least_others"},
    StatusReasonInfo{StatusReason::kStatesFlat, StatusCode::kDegenerateGeometry, "states_flat",
                     "dimensions, condition"},
    StatusReasonInfo{StatusReason::kFewKnownLandmarks, StatusCode::kTooFewObservations,
                     "few_known_landmarks", "known, least_known"},
    StatusReasonInfo{StatusReason::kKnownDegenerate, StatusCode::kDegenerateGeometry,
                     "known_degenerate", "dimensions, condition"},
    StatusReasonInfo{StatusReason::kRankOfPath, StatusCode::kFailed, "rank_of_path", "dimensions"},
    StatusReasonInfo{StatusReason::kStepsFlat, StatusCode::kDegenerateGeometry, "steps_flat",
                     "dimensions, least_dimensions"},
    StatusReasonInfo{StatusReason::kMirrorImage, StatusCode::kUndetermined, "mirror_image",
                     "difference_percent"},
    StatusReasonInfo{StatusReason::kFewPosesWithRanges, StatusCode::kTooFewObservations,
                     "few_poses_with_ranges",
                     "landmarks, poses_with_all, poses, least_landmarks, least_poses, "
                     "poses_of_the_named",
                     StatusNames::kOne},
    StatusReasonInfo{StatusReason::kPosesWithoutWindow, StatusCode::kUndetermined,
                     "poses_without_window", "left_out, poses, poses_of_the_named",
                     StatusNames::kOne},
    StatusReasonInfo{StatusReason::kNoKnownLandmark, StatusCode::kFailed, "no_known_landmark"},
    StatusReasonInfo{StatusReason::kNoOdometry, StatusCode::kFailed, "no_odometry"},
    StatusReasonInfo{StatusReason::kNoOdometryForHeadings, StatusCode::kFailed,
                     "no_odometry_for_headings"},
    StatusReasonInfo{StatusReason::kNoStart, StatusCode::kFailed, "no_start"},
    StatusReasonInfo{StatusReason::kMethodLeftOut, StatusCode::kLeftOut, "method_left_out", "",
                     StatusNames::kSome},
    // The name is what the method said, or what is wrong with its answer.
    StatusReasonInfo{StatusReason::kMethodNotStarted, StatusCode::kFailed, "method_not_started", "",
                     StatusNames::kOne},
    StatusReasonInfo{StatusReason::kMethodTimeout, StatusCode::kFailed, "method_timeout",
                     "timeout_s"},
    StatusReasonInfo{StatusReason::kMethodEnded, StatusCode::kFailed, "method_ended", "",
                     StatusNames::kOne},
    StatusReasonInfo{StatusReason::kMethodReply, StatusCode::kFailed, "method_reply", "",
                     StatusNames::kOne},
    StatusReasonInfo{StatusReason::kMethodNumbers, StatusCode::kFailed, "method_numbers", "",
                     StatusNames::kOne},
    StatusReasonInfo{StatusReason::kMethodRefused, StatusCode::kFailed, "method_refused", "",
                     StatusNames::kOne},
    // The name is the message: of an error, or of somebody else's program.
    StatusReasonInfo{StatusReason::kMessage, StatusCode::kFailed, "message", "", StatusNames::kOne},
};

constexpr const StatusReasonInfo& info(StatusReason reason) {
  return kStatusReasons[static_cast<std::size_t>(reason)];
}

/// The names used in files ("bridged", "graph_in_pieces").
std::string_view name(StatusCode code);
std::string_view name(StatusReason reason);

/// Sub-maps that ended so, of all.
struct SubmapCount {
  int count = 0;
  int submaps = 0;

  bool operator==(const SubmapCount&) const = default;
};

/// One warning or failure, with what was done about it.
struct Status {
  StatusCode code;
  StatusReason reason;
  std::vector<double> values = {};                    ///< As many as info(reason) has.
  std::vector<std::string> names = {};                ///< Of landmarks; of kMessage the message.
  std::vector<Method> starts = {};                    ///< Empty: of the map itself; else of the map
                                                      ///< that it started from, or of that one's.
  std::optional<SubmapCount> submaps = std::nullopt;  ///< Of the first of these.

  bool operator==(const Status&) const = default;
};

/// A status for that reason.
template <StatusReason kReason, typename... Values>
Status status_of(std::vector<std::string> names, Values... values) {
  static_assert(sizeof...(Values) == info(kReason).value_count());
  Status status{
      .code = info(kReason).code, .reason = kReason, .values = {static_cast<double>(values)...}};
  status.names = std::move(names);
  return status;
}

template <StatusReason kReason, typename... Values>
requires((std::is_arithmetic_v<Values> && ...)) Status status_of(Values... values) {
  static_assert(info(kReason).names == StatusNames::kNone ||
                info(kReason).names == StatusNames::kIfKnown);
  return status_of<kReason>(std::vector<std::string>(), values...);
}

/// The message of another program, which has no reason code.
Status status_with_message(StatusCode code, std::string message);

}  // namespace mapproof
