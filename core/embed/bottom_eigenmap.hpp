#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/graph/neighbours.hpp"
#include "core/model/embedding.hpp"

namespace mapproof {

/// Laplacian eigenmap with weights 0 and 1: the two smallest solutions of L v = lambda D v except
/// the constant, with D the degrees and L = D - A [belkin2003].
///
/// @param graph  Of n >= 3 nodes, undirected, in one piece; lengths do not count.
/// @return Columns with v'Dv = 1; statuses as of bottom_eigenmap. The spectrum holds lambda.
/// @throws InvalidInput if there are fewer than 3 nodes, or one without an edge.
/// @note O(edges) time in addition to that of the eigenvalues.
Embedding laplacian_eigenmap(const Graph& graph);

/// The map whose columns are the two smallest eigenvectors of a matrix, except a null vector that
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
