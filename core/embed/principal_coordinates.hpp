#pragma once

#include <Eigen/Core>

#include "core/model/embedding.hpp"

namespace mapproof {

/// The two directions of most spread behind centred inner products: v_k sqrt(lambda_k) of the two
/// largest eigenpairs.
///
/// @param B     n x n, n >= 3, symmetric, finite, rows and columns summing to zero.
/// @param size  The largest value that B was computed from, for a bound on its rounding.
/// @return Columns orthogonal, in descending order of spread; kRankDeficient if fewer than two
///         eigenvalues are above 1e-12 of the largest and of `size` (the missing columns are zero);
///         kUndetermined if the third largest equals the second; kNotConverged if the eigenvalues'
///         solver gave up. The spectrum holds up to 10 eigenvalues.
/// @note O(n^3) time up to n = 80, above that O(n^2) an iteration (see symmetric_eigen.hpp).
Embedding principal_coordinates(const Eigen::MatrixXd& B, double size);

}  // namespace mapproof
