#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/base/not_finite.hpp"
#include "core/model/histories/history_blocks.hpp"
#include "core/model/observation_history.hpp"
#include "core/observe/features.hpp"

namespace mapproof {

/// The similarity of the observation histories of each pair of landmarks.
struct Proximities {
  Eigen::MatrixXd inner_products;     ///< M x M; of normalised vectors for visibility.
  Eigen::MatrixXd squared_distances;  ///< M x M, zero diagonal; infinite: no common step.
  /// The squared distance of landmarks never seen together, 2 for visibility: which of several is
  /// nearer is not determined. Infinite for other sensors.
  double apart_squared = kInfinity;
};

/// Euclidean proximities of the observation vectors (see features.hpp). With missing entries the
/// sums are pairwise-complete and are scaled to the full length.
///
/// @param steps  How many observations to use, from the first.
/// @return For visibility, squared distances are 2 - 2 cos of the angle between the vectors; the
///         rows of landmarks never seen are meaningless (see unseen_landmarks).
/// @throws InvalidInput if `steps` is out of bounds.
/// @note O(M^2 N) time; O(M^2) memory in addition to a few thousand steps, or N M bytes for
/// visibility.
Proximities proximities(const HistoryBlocks& history, Eigen::Index steps);

/// In how many of the first `steps` observations both landmarks of a pair were observed, M x M.
Eigen::MatrixXd steps_observed_together(const HistoryBlocks& history, Eigen::Index steps);

/// The same, but of visibility: in how many both were seen.
Eigen::MatrixXd steps_seen_together(const HistoryBlocks& history, Eigen::Index steps);

/// The same of given vectors (see features).
Proximities proximities(const Features& rows, Sensor sensor);

/// The same of vectors of which only the inner products are known, M x M; their diagonal is > 0 for
/// visibility.
Proximities proximities_of_products(Eigen::MatrixXd inner_products, Sensor sensor);

/// Rows without any information in the first `steps` observations: nothing but missing entries or,
/// for visibility, nothing but "not seen". Ascending.
/// @throws InvalidInput if `steps` is out of bounds.
std::vector<Eigen::Index> unseen_landmarks(const HistoryBlocks& history, Eigen::Index steps);

/// The other landmarks, ascending: those that a map can hold.
/// @throws InvalidInput if `steps` is out of bounds.
std::vector<Eigen::Index> seen_landmarks(const HistoryBlocks& history, Eigen::Index steps);

/// The rows of `count` that are not among those. @param rows  Ascending.
std::vector<Eigen::Index> other_rows(const std::vector<Eigen::Index>& rows, Eigen::Index count);

/// Whether a value of the first `steps` observations is missing.
bool misses_any(const HistoryBlocks& history, Eigen::Index steps);

/// The history of some landmarks alone, in the order given.
ObservationHistory with_rows(const ObservationHistory& history,
                             const std::vector<Eigen::Index>& rows);

}  // namespace mapproof
