#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/graph/neighbours.hpp"
#include "core/model/embedding.hpp"

namespace mapproof {

/// What the methods over neighbourhoods share.

/// @throws InvalidInput unless `squared_distances` is n x n with n >= 3 and finite, and
///         `neighbours` lists at least `fewest` others for each landmark.
void check_neighbourhoods(const Eigen::MatrixXd& squared_distances,
                          const NeighbourLists& neighbours, int fewest);

/// The squared distance between two landmarks.
using SquaredDistance = std::function<double(Eigen::Index, Eigen::Index)>;

/// Inner products (x_a - x_i)'(x_b - x_i) of the neighbours of i, from distances alone. Neighbours
/// at infinite distance from each other count as far as the way over i.
void gram_about(const SquaredDistance& squared, Eigen::Index i, const std::vector<Edge>& edges,
                Eigen::MatrixXd& gram);

/// A sum of squared linear forms, each over a few landmarks: a sparse matrix M with z'Mz their sum.
class QuadraticForms {
 public:
  explicit QuadraticForms(Eigen::Index n) : n_(n) {}

  /// Adds c c' on the rows and columns of `support`, for each column c of `coefficients`.
  void add(const std::vector<Eigen::Index>& support, const Eigen::MatrixXd& coefficients);

  Eigen::SparseMatrix<double> matrix() const;

 private:
  Eigen::Index n_;
  std::vector<Eigen::Triplet<double>> entries_;
};

/// Hessian LLE needs this many neighbours for a map of the plane: 1, x, y and their three products
/// must be distinguishable.
inline constexpr int kFewestHessianNeighbours = 6;

/// Hessian LLE: the functions over the landmarks whose Hessian, estimated in the tangent plane of
/// each neighbourhood, is least [donoho2003].
///
/// Tangent coordinates are the two largest eigenvectors of the neighbourhood's centred Gram matrix.
/// The quadratic form is that of the directions which x^2, xy and y^2 add to 1, x and y, by
/// Gram-Schmidt; one that adds none (neighbours on a conic) is left out.
/// @param squared_distances  n x n, symmetric, zero diagonal, finite, n > 6.
/// @param neighbours  At least 6 of each landmark (see nearest_neighbours), in one piece.
/// @return Columns of length 1, which the paper's last step would rotate and scale to be
///         orthonormal over a neighbourhood: an affine map, left to the alignment. Statuses as of
///         bottom_eigenmap, and kRankDeficient if neighbourhoods spread in one direction alone and
///         so have no tangent plane.
/// @throws InvalidInput if the bounds above are broken.
/// @note O(n K^3) time in addition to that of the eigenvalues.
Embedding hessian_lle(const Eigen::MatrixXd& squared_distances, const NeighbourLists& neighbours);

struct LleOptions {
  /// Added to the diagonal of each local Gram matrix, as a share of its trace, > 0: with more
  /// neighbours than dimensions the weights would not be unique.
  double regularization = 1e-3;
};

/// How well a map keeps the weights: y'My = |(I - W) y|^2 for each of its columns.
struct BlendForm {
  Eigen::SparseMatrix<double> matrix;
  bool are_all_flat = true;  ///< In every neighbourhood the data spread in one direction alone.
  int not_euclidean = 0;     ///< Neighbourhoods whose distances no points have; nearest ones taken.
};

/// The weights that sum to one and blend each landmark from its neighbours best [roweis2000].
/// @param neighbours  Of each landmark, one at least.
/// @note O(n K^3) time.
BlendForm blend_form(const SquaredDistance& squared, const NeighbourLists& neighbours,
                     const LleOptions& options);

/// Locally linear embedding: the map in which the weights that blend each landmark from its
/// neighbours in the data blend it best, too [roweis2000].
///
/// @param squared_distances  n x n, symmetric, zero diagonal, finite, n >= 3.
/// @param neighbours  Those of each landmark (see nearest_neighbours), one at least, in one piece.
/// @return Columns of length 1; statuses as of bottom_eigenmap, kRankDeficient if in every
///         neighbourhood the data spread in one direction alone, and kNotEuclidean if in some no
///         points have such distances: the negative eigenvalues of their Gram matrix are cut.
/// @throws InvalidInput if the bounds above are broken.
/// @note O(n K^3) time in addition to that of the eigenvalues.
Embedding lle(const Eigen::MatrixXd& squared_distances, const NeighbourLists& neighbours,
              const LleOptions& options = {});

}  // namespace mapproof
