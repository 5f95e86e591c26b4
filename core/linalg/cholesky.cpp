#include "core/linalg/cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/vectorised.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

constexpr Index kLeaf = 24;  // A multiple of both sides of a tile (tile_product.hpp).
using Leaf = Eigen::Matrix<double, kLeaf, kLeaf>;

/// About half of n, in whole leaves.
Index half(Index n) { return (n / 2 + kLeaf - 1) / kLeaf * kLeaf; }

/// Replaces the lower half of A by its factor, column by column; the values above the diagonal
/// are meaningless. False if there is no factor.
MAPPROOF_VECTORISED_WIDE bool factor_leaf(double* A) {
  for (Index j = 0; j < kLeaf; ++j) {
    double* const column = A + j * kLeaf;
    if (!(column[j] > 0.0 && std::isfinite(column[j]))) return false;  // nor for NaN
    const double root = std::sqrt(column[j]);
    for (Index i = 0; i < kLeaf; ++i) column[i] /= root;
    for (Index k = j + 1; k < kLeaf; ++k)
      for (Index i = 0; i < kLeaf; ++i) A[k * kLeaf + i] -= column[i] * column[k];
  }
  return std::isfinite(A[kLeaf * kLeaf - 1]);
}

/// Columns of L^-1, by forward substitution in those of the identity.
MAPPROOF_VECTORISED_WIDE void invert_leaf(const double* L, double* inverse) {
  for (Index j = 0; j < kLeaf; ++j) {
    const double* const column = L + j * kLeaf;
    const double reciprocal = 1.0 / column[j];
    for (Index c = 0; c <= j; ++c) {  // independent of each other, so none waits
      double* const x = inverse + c * kLeaf;
      const double entry = x[j] * reciprocal;
      for (Index i = 0; i < kLeaf; ++i) x[i] -= entry * column[i];
      x[j] = entry;
    }
  }
}

/// A factorisation of blocks on the diagonal, the inverses of whose leaves are kept: every block
/// off the diagonal is multiplied by some of them.
class Factorisation {
 public:
  explicit Factorisation(Index n)
      : n_(n), inverses_(static_cast<std::size_t>((n + kLeaf - 1) / kLeaf)) {}

  /// @param at  Where in the whole matrix A begins: a multiple of a leaf.
  bool factor(Block A, Index at) {
    const Index n = A.rows();
    if (n <= kLeaf) return factor_one(A, at);
    const Index k = half(n);
    if (!factor(A.topLeftCorner(k, k), at)) return false;
    divide(A.topLeftCorner(k, k), A.bottomLeftCorner(n - k, k), at);
    add_gram(A.bottomLeftCorner(n - k, k), -1.0, A.bottomRightCorner(n - k, n - k));
    return factor(A.bottomRightCorner(n - k, n - k), at + k);
  }

 private:
  Leaf& inverse(Index at) { return inverses_[static_cast<std::size_t>(at / kLeaf)]; }

  bool factor_one(Block A, Index at) {
    const Index n = A.rows();
    Leaf L = Leaf::Identity();
    L.topLeftCorner(n, n).triangularView<Eigen::Lower>() = A;
    if (!factor_leaf(L.data())) return false;
    L.triangularView<Eigen::StrictlyUpper>().setZero();
    A.triangularView<Eigen::Lower>() = L.topLeftCorner(n, n);
    if (at + n == n_) return true;  // nothing is below
    inverse(at).setIdentity();
    invert_leaf(L.data(), inverse(at).data());
    return true;
  }

  /// B L'^-1, in place, of the factor L that begins at `at`.
  void divide(const ConstBlock& L, Block B, Index at) {
    const Index n = L.rows();
    if (n <= kLeaf) {
      const Eigen::MatrixXd undivided = B;
      B.setZero();
      add_product(undivided, inverse(at).topLeftCorner(n, n), 1.0, B);
      return;
    }
    const Index k = half(n);
    divide(L.topLeftCorner(k, k), B.leftCols(k), at);
    add_product(B.leftCols(k), L.bottomLeftCorner(n - k, k), -1.0, B.rightCols(n - k));
    divide(L.bottomRightCorner(n - k, n - k), B.rightCols(n - k), at + k);
  }

  Index n_;
  std::vector<Leaf> inverses_;
};

}  // namespace

bool factor_cholesky(Block A) { return Factorisation(A.rows()).factor(A, 0); }

Eigen::VectorXd solve_cholesky(const Eigen::MatrixXd& L, const Eigen::VectorXd& b) {
  Eigen::VectorXd x = L.triangularView<Eigen::Lower>().solve(b);
  L.triangularView<Eigen::Lower>().transpose().solveInPlace(x);
  return x;
}

}  // namespace mapproof
