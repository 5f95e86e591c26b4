#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/range_slam/factors/metric_upgrade.hpp"
#include "core/range_slam/factors/spectral_map.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

/// Spectral SLAM that takes squared ranges a column at a time and forgets them.
///
/// Kept are the Gram matrix and the sum of all columns, and the fourth moments of min(N, 8) of
/// their coordinates: those along the Gram's leading eigenvectors, each scaled to mean square 1.
/// Known landmarks need the Gram alone; the metric upgrade needs fourth moments, of 4 coordinates
/// that are not known before the end. Eight, re-expressed every few columns as the eigenvectors
/// turn, lose nothing up to 8 landmarks, nor without noise, and beyond that only noise that moves
/// in and out of the leading eight; moments of all N would take O(N^4) memory.
class IncrementalSpectralMap {
 public:
  /// @throws InvalidInput unless landmarks >= 1.
  explicit IncrementalSpectralMap(Eigen::Index landmarks);

  /// Folds one step in.
  /// @param half_squares  N, 1/2 d^2, finite.
  /// @throws InvalidInput if a bound is broken.
  /// @note O(N^2) time on average, O(N^2) memory whatever the number of steps.
  void add(const Eigen::VectorXd& half_squares);

  Eigen::Index steps() const { return steps_; }

  /// What map_from_known_landmarks() of factorize() would give for all steps so far, with its
  /// statuses, but that X is left empty. Positions come from localise(). kTooFewObservations below
  /// 4 landmarks or steps, which factorize() refuses.
  /// @throws InvalidInput for a known_problem().
  /// @note O(N^3) time and O(N^2) memory: steps that wait are folded into a copy.
  SpectralMap map(const KnownLandmarks& known) const;

  /// What metric_upgrade() of factorize() would give for all steps so far, with its statuses, but
  /// that X is left empty. Singular values are roots of moments and so known to 1e-7 of the largest
  /// alone: what is smaller is rounding here, when it need not be there.
  /// @note As above.
  SpectralMap map() const;

 private:
  void fold();
  /// Singular values of all steps, with condition and statuses, without factors.
  Factorization spectrum() const;
  /// Rank 4 factors with as few states as have the mean and mean square of all.
  Factorization factors() const;
  Eigen::Vector4d mean_state() const;
  /// An empty map and its statuses, if there are too few steps or they span too little.
  std::optional<SpectralMap> without_map(Eigen::Index least_steps, StatusCode flat) const;

  Eigen::Index steps_ = 0;
  Eigen::MatrixXd gram_;     ///< N x N, of folded columns.
  Eigen::VectorXd sum_;      ///< N, of folded columns.
  Eigen::MatrixXd pending_;  ///< N x block; the first `pending_count_` columns wait.
  Eigen::Index pending_count_ = 0;
  Eigen::MatrixXd frame_;     ///< N x q: y = frame_ z for whitened coordinates z.
  Eigen::MatrixXd to_frame_;  ///< q x N.
  Eigen::MatrixXd moments_;   ///< Sum of outer products of the monomials of z.
};

}  // namespace mapproof
