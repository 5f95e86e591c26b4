#include "core/linalg/cholesky.hpp"

#include <Eigen/Cholesky>

namespace mapproof {
namespace {

using Eigen::Index;

constexpr Index kLeaf = 48;  // A multiple of the tiles of packed_product.

/// About half of n, in whole leaves.
Index half(Index n) { return (n / 2 + kLeaf - 1) / kLeaf * kLeaf; }

/// B L'^-1, in place.
void divide_by_transpose(const ConstBlock& L, Block B) {
  const Index n = L.rows();
  if (n <= kLeaf) {
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(n, n);
    L.triangularView<Eigen::Lower>().solveInPlace(inverse);
    const Eigen::MatrixXd undivided = B;
    B.setZero();
    add_product(undivided, inverse, 1.0, B);
    return;
  }
  const Index k = half(n);
  divide_by_transpose(L.topLeftCorner(k, k), B.leftCols(k));
  add_product(B.leftCols(k), L.bottomLeftCorner(n - k, k), -1.0, B.rightCols(n - k));
  divide_by_transpose(L.bottomRightCorner(n - k, n - k), B.rightCols(n - k));
}

}  // namespace

bool factor_cholesky(Block A) {
  const Index n = A.rows();
  if (n <= kLeaf) {
    Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> leaf(A);
    // Eigen takes a NaN for a success.
    return leaf.info() == Eigen::Success && (A.diagonal().array() > 0.0).all();
  }
  const Index k = half(n);
  if (!factor_cholesky(A.topLeftCorner(k, k))) return false;
  divide_by_transpose(A.topLeftCorner(k, k), A.bottomLeftCorner(n - k, k));
  add_gram(A.bottomLeftCorner(n - k, k), -1.0, A.bottomRightCorner(n - k, n - k));
  return factor_cholesky(A.bottomRightCorner(n - k, n - k));
}

Eigen::VectorXd solve_cholesky(const Eigen::MatrixXd& L, const Eigen::VectorXd& b) {
  Eigen::VectorXd x = L.triangularView<Eigen::Lower>().solve(b);
  L.triangularView<Eigen::Lower>().transpose().solveInPlace(x);
  return x;
}

}  // namespace mapproof
