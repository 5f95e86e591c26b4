#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/graph/neighbours.hpp"

namespace mapproof {

/// What the methods over neighbourhoods share.

/// @throws InvalidInput unless `squared_distances` is n x n with n >= 3 and finite, and
///         `neighbours` lists at least `fewest` others for each landmark.
void check_neighbourhoods(const Eigen::MatrixXd& squared_distances,
                          const NeighbourLists& neighbours, int fewest);

/// Inner products (x_a - x_i)'(x_b - x_i) of the neighbours of i, from distances alone.
void gram_about(const Eigen::MatrixXd& squared_distances, Eigen::Index i,
                const std::vector<Edge>& edges, Eigen::MatrixXd& gram);

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

}  // namespace mapproof
