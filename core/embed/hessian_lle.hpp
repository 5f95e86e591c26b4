#pragma once

#include <Eigen/Core>

#include "core/graph/neighbours.hpp"
#include "core/model/embedding.hpp"

namespace mapproof {

/// Hessian LLE needs this many neighbours for a map of the plane: 1, x, y and their three products
/// must be told apart.
inline constexpr int kFewestHessianNeighbours = 6;

/// Hessian LLE: the functions over the landmarks whose Hessian, estimated in the tangent plane of
/// each neighbourhood, is least [donoho2003].
///
/// Tangent coordinates are the two largest eigenvectors of the neighbourhood's centred Gram matrix.
/// The quadratic form is that of the directions which x^2, xy and y^2 add to 1, x and y, by
/// Gram-Schmidt; one that adds none (neighbours on a conic) is left out.
/// @param squared_distances  n x n, symmetric, zero diagonal, finite, n > 6.
/// @param neighbours  At least 6 of each landmark (see nearest_neighbours), in one piece.
/// @return Columns of length 1, which the paper's last step would turn and scale to be orthonormal
///         over a neighbourhood: an affine map, left to the alignment. Statuses as of
///         bottom_eigenmap, and kRankDeficient if neighbourhoods spread in one direction alone and
///         so have no tangent plane.
/// @throws InvalidInput if the bounds above are broken.
/// @note O(n K^3) time beside that of the eigenvalues.
Embedding hessian_lle(const Eigen::MatrixXd& squared_distances, const NeighbourLists& neighbours);

}  // namespace mapproof
