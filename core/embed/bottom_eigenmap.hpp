#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/model/embedding.hpp"

namespace mapproof {

/// The map whose columns are the two smallest eigenvectors of a matrix, beside a null vector that
/// every map has: what LLE, Laplacian eigenmaps and Hessian LLE come down to.
///
/// @param matrix       n x n, n >= 3, symmetric, positive semidefinite, finite.
/// @param null_vector  n, of length 1: the constant map.
/// @return Columns of length 1. The spectrum holds up to 5 eigenvalues, ascending, without that of
///         the null vector. kUndetermined if the third equals the second, up to 1e-9 of
///         itself and 1e-13 of the matrix's trace; kNotConverged if the eigenvalues' solver gave
///         up.
/// @note See smallest_eigenpairs.
Embedding bottom_eigenmap(const Eigen::SparseMatrix<double>& matrix,
                          const Eigen::VectorXd& null_vector);

}  // namespace mapproof
