#include "core/linalg/symmetric_eigen.hpp"

#include <algorithm>

#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>

#include "core/base/errors.hpp"
#include "core/linalg/sign.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kDenseLimit = 300;

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

}  // namespace

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
