#include "core/linalg/symmetric_eigen.hpp"

#include <algorithm>
#include <cmath>

#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include "core/base/errors.hpp"
#include "core/linalg/sign.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kDenseLimit = 100;

EigenPairs dense(const Eigen::MatrixXd& matrix, Eigen::Index k) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {.values = solver.eigenvalues().tail(k).reverse(),
          .vectors = solver.eigenvectors().rightCols(k).rowwise().reverse(),
          .converged = solver.info() == Eigen::Success};
}

EigenPairs lanczos(const Eigen::MatrixXd& matrix, Eigen::Index k) {
  Spectra::DenseSymMatProd<double> product(matrix);
  const Eigen::Index basis = std::min(matrix.rows(), std::max<Eigen::Index>(4 * k, 24));
  Spectra::SymEigsSolver<Spectra::DenseSymMatProd<double>> solver(product, k, basis);
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge, 1000, 1e-12);
  if (solver.info() != Spectra::CompInfo::Successful)
    return {.values = {}, .vectors = {}, .converged = false};
  return {.values = solver.eigenvalues(), .vectors = solver.eigenvectors(), .converged = true};
}

using Sparse = Eigen::SparseMatrix<double>;

/// The null vector's eigenvalue goes from zero to above all others.
EigenPairs dense_smallest(const Sparse& matrix, Eigen::Index k, const Eigen::VectorXd& null) {
  Eigen::MatrixXd A = matrix;
  A += (1.0 + 2.0 * A.trace()) * null * null.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return {.values = solver.eigenvalues().head(k),
          .vectors = solver.eigenvectors().leftCols(k),
          .converged = solver.info() == Eigen::Success};
}

/// x -> P (A + shift I)^-1 P x, with P the projection off the null vector: the form that Spectra
/// takes an operator in.
class ShiftedInverse {
 public:
  using Scalar = double;

  ShiftedInverse(const Sparse& matrix, const Eigen::VectorXd& null, double shift) : null_(null) {
    Sparse identity(matrix.rows(), matrix.rows());
    identity.setIdentity();
    factor_.compute(matrix + shift * identity);
  }

  bool usable() const { return factor_.info() == Eigen::Success; }
  Eigen::Index rows() const { return null_.size(); }
  Eigen::Index cols() const { return null_.size(); }

  void perform_op(const double* in, double* out) const {
    const Eigen::Map<const Eigen::VectorXd> x(in, rows());
    Eigen::Map<Eigen::VectorXd> y(out, rows());
    y = factor_.solve(x - null_ * null_.dot(x));
    y -= null_ * null_.dot(y);
  }

 private:
  const Eigen::VectorXd& null_;
  Eigen::SimplicialLLT<Sparse> factor_;
};

double largest_row_sum(const Sparse& matrix) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(matrix.rows());
  for (Eigen::Index j = 0; j < matrix.outerSize(); ++j)
    for (Sparse::InnerIterator entry(matrix, j); entry; ++entry)
      sums(entry.row()) += std::abs(entry.value());
  return sums.size() > 0 ? sums.maxCoeff() : 0.0;
}

EigenPairs inverse_lanczos(const Sparse& matrix, Eigen::Index k, const Eigen::VectorXd& null) {
  EigenPairs none{.values = {}, .vectors = {}, .converged = false};
  const double size = largest_row_sum(matrix);
  // Off zero, where the factor would not exist; far below what separates the eigenvectors.
  ShiftedInverse inverse(matrix, null, 1e-11 * size);
  if (!inverse.usable()) return none;
  Spectra::SymEigsSolver<ShiftedInverse> solver(inverse, k, std::max<Eigen::Index>(4 * k, 20));
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge, 300, 1e-12);
  if (solver.info() != Spectra::CompInfo::Successful) return none;

  // The inverse gives the directions; the matrix itself the values, and the residuals.
  const Eigen::MatrixXd V = solver.eigenvectors();
  const Eigen::MatrixXd AV = matrix * V;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> small(V.transpose() * AV);
  EigenPairs pairs{.values = small.eigenvalues(), .vectors = V * small.eigenvectors()};
  const Eigen::MatrixXd residuals =
      AV * small.eigenvectors() - pairs.vectors * pairs.values.asDiagonal();
  pairs.converged = residuals.colwise().norm().maxCoeff() <= 1e-9 * size;
  return pairs;
}

}  // namespace

EigenPairs smallest_eigenpairs(const Eigen::SparseMatrix<double>& matrix, Eigen::Index k,
                               const Eigen::VectorXd& null_vector) {
  const Eigen::Index n = matrix.rows();
  if (matrix.cols() != n || null_vector.size() != n || k < 1 || k >= n)
    throw InvalidInput("eigenpairs: need a square matrix, its null vector and 1 <= k < n");
  if (!matrix.coeffs().allFinite() || !null_vector.allFinite())
    throw InvalidInput("eigenpairs: the matrix holds NaN or infinity");

  EigenPairs pairs{.values = {}, .vectors = {}, .converged = false};
  if (n > kDenseLimit && 8 * k < n) pairs = inverse_lanczos(matrix, k, null_vector);
  if (!pairs.converged) pairs = dense_smallest(matrix, k, null_vector);
  fix_signs(pairs.vectors);
  return pairs;
}

EigenPairs largest_eigenpairs(const Eigen::MatrixXd& matrix, Eigen::Index k) {
  if (matrix.rows() != matrix.cols() || k < 1 || k > matrix.rows())
    throw InvalidInput("eigenpairs: need a square matrix and 1 <= k <= n");
  if (!matrix.allFinite()) throw InvalidInput("eigenpairs: the matrix holds NaN or infinity");

  EigenPairs pairs{.values = {}, .vectors = {}, .converged = false};
  if (matrix.rows() > kDenseLimit && 8 * k < matrix.rows()) pairs = lanczos(matrix, k);
  if (!pairs.converged) pairs = dense(matrix, k);
  fix_signs(pairs.vectors);
  return pairs;
}

}  // namespace mapproof
