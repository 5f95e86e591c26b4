#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/model/status.hpp"

namespace mapproof {

/// Y = U V up to noise: the leading singular vectors of squared ranges.
struct Factorization {
  Eigen::MatrixXd U;                ///< N x rank, orthonormal columns, signs fixed (see sign.hpp).
  Eigen::MatrixXd V;                ///< rank x T: singular values times right singular vectors.
  Eigen::VectorXd singular_values;  ///< All min(N, T) of them, descending.
  double condition = 1.0;           ///< Largest kept over smallest kept; infinite if that is 0.
  double noise_floor = 0.0;         ///< Largest left out; 0 if none is.
  std::vector<Status> statuses;     ///< kRankDeficient: some of `rank` are no more than noise.
};

/// Sets condition, noise floor and the status of a factorisation from its singular values.
/// @param rank  How many of them are kept, 1 to all of them.
void judge_rank(Factorization& result, Eigen::Index rank);

/// The thin SVD cut at `rank` [boots2013, algorithm 1, line 2].
///
/// A wide Y is brought to a triangle first, by Householder reflections: as fast as its Gram matrix
/// Y Y', without squaring the condition number.
/// @param Y     N x T, finite.
/// @param rank  1 to min(N, T).
/// @throws InvalidInput if a bound is broken.
/// @note O(N^2 T + N^3) time, O(N T) memory.
Factorization factorize(const Eigen::MatrixXd& Y, Eigen::Index rank);

/// The same with U of Y Y' - T diag(variances), free of what noise adds to the Gram matrix.
///
/// Where rows differ in noise, as far landmarks do from near ones, their own shares turn the
/// singular vectors of Y by an angle that more steps do not lessen; the paper assumes it away ("the
/// noise in M-hat is zero-mean"). Without effect for N = rank.
/// @param variances  N, of the noise of Y's rows, >= 0 (see half_square_variances()).
/// @return Singular values are roots of the Gram matrix's eigenvalues, 0 where noise was overrated.
/// @throws InvalidInput if a bound is broken.
Factorization factorize_without_noise(const Eigen::MatrixXd& Y, const Eigen::VectorXd& variances,
                                      Eigen::Index rank);

}  // namespace mapproof
