#pragma once

#include <Eigen/Core>

#include "core/model/embedding.hpp"

namespace mapproof {

/// Linear PCA of the observation vectors by classical scaling of their distances, which gives the
/// same coordinates [torgerson1952].
///
/// @param squared_distances  n x n, symmetric, zero diagonal, finite, n >= 3.
/// @return Centred, columns orthogonal, in descending order of spread; kRankDeficient if the data
///         spread in fewer than two directions (the missing columns are zero); kUndetermined and
///         kNotConverged as of principal_coordinates. The spectrum holds up to 10 eigenvalues.
/// @throws InvalidInput if the matrix breaks the bounds above.
/// @note O(n^3) time, O(n^2) memory.
Embedding lpca(const Eigen::MatrixXd& squared_distances);

}  // namespace mapproof
