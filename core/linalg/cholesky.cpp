#include "core/linalg/cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "core/base/not_finite.hpp"
#include "core/base/vectorised.hpp"
#include "core/linalg/gram.hpp"

namespace mapproof {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kLeaf = 24;  // A multiple of both sides of a tile.
constexpr Index kPanelsOfLeaf = kLeaf / kTileRows;
using Leaf = Eigen::Matrix<double, kLeaf, kLeaf>;

/// Up to here blocks of columns are the fastest; 900 rows take a fifth more by halves.
constexpr Index kMostByColumns = 1000;

/// About half of n, in whole leaves.
Index half(Index n) { return (n / 2 + kLeaf - 1) / kLeaf * kLeaf; }

/// Replaces the lower half of the first n rows and columns of A by its factor, column by column;
/// the values above the diagonal are meaningless. False if there is no factor.
MAPPROOF_VECTORISED_WIDE bool factor_leaf(double* A, Index n) {
  for (Index j = 0; j < n; ++j) {
    double* const column = A + j * kLeaf;
    if (!(column[j] > 0.0 && std::isfinite(column[j]))) return false;  // nor for NaN
    const double root = std::sqrt(column[j]);
    for (Index i = 0; i < kLeaf; ++i) column[i] /= root;
    for (Index k = j + 1; k < n; ++k)
      for (Index i = 0; i < kLeaf; ++i) A[k * kLeaf + i] -= column[i] * column[k];
  }
  return std::isfinite(A[(n - 1) * kLeaf + n - 1]);
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

/// Rows of A in panels of a tile's columns, each column by column, the last one filled with zeros.
void pack_columns(const ConstBlock& A, std::vector<double>& packed) {
  const Index panels = (A.rows() + kTileColumns - 1) / kTileColumns;
  const Index size = panels * kTileColumns * A.cols();
  if (std::ssize(packed) < size) packed.resize(static_cast<std::size_t>(size));
  double* out = packed.data();
  for (Index first = 0; first < A.rows(); first += kTileColumns) {
    const Index count = std::min(kTileColumns, A.rows() - first);
    for (Index k = 0; k < A.cols(); ++k, out += kTileColumns) {
      const double* const in = A.data() + k * A.outerStride() + first;
      for (Index r = 0; r < kTileColumns; ++r) out[r] = r < count ? in[r] : 0.0;
    }
  }
}

/// The factorisation of a block on the diagonal, one column of leaves after the other. Each row of
/// tiles is packed once, when it is done, for all that is right of it.
class ColumnFactorisation {
 public:
  /// @param inverses  Gets those of the leaves.
  /// @param is_last   Whether nothing is below A: the last leaf needs no inverse.
  ColumnFactorisation(Block A, Leaf* inverses, bool is_last)
      : A_(A), inverses_(inverses), is_last_(is_last), n_(A.rows()) {
    const Index size = panel((n_ + kLeaf - 1) / kLeaf * kPanelsOfLeaf);
    if (std::ssize(rows_) < size) rows_.resize(static_cast<std::size_t>(size));
  }

  bool run() {
    for (Index first = 0; first < n_; first += kLeaf)
      if (!factor_column(first)) return false;
    return true;
  }

 private:
  /// Where the packed row p of tiles begins: as long as what is left of its leaf on the diagonal.
  static Index panel(Index p) {
    const Index leaf = p / kPanelsOfLeaf;
    const Index shorter = kPanelsOfLeaf * (leaf * (leaf - 1) / 2) + p % kPanelsOfLeaf * leaf;
    return kTileRows * kLeaf * shorter;
  }

  bool factor_column(Index first) {
    const Index width = std::min(kLeaf, n_ - first);
    pack_columns(A_.block(first, 0, width, first), columns_);
    Leaf L = Leaf::Identity();
    alignas(64) double tiles[kTileRows * kLeaf];
    for (Index row = first; row < first + width; row += kTileRows) {
      reduce(row, first, width, tiles);
      const Index end = std::min(kTileRows, first + width - row);
      for (Index c = 0; c < width; ++c)
        for (Index r = std::max<Index>(0, first + c - row); r < end; ++r)
          L(row - first + r, c) = tiles[c * kTileRows + r];
    }
    if (!factor_leaf(L.data(), width)) return false;
    L.triangularView<Eigen::StrictlyUpper>().setZero();
    A_.block(first, first, width, width).triangularView<Eigen::Lower>() =
        L.topLeftCorner(width, width);
    if (is_last_ && first + width == n_) return true;
    Leaf& inverse = inverses_[first / kLeaf];
    inverse.setIdentity();
    invert_leaf(L.data(), inverse.data());
    divide_below(first, inverse);
    return true;
  }

  /// Rows of A right of what is done, less the products of what is done.
  void reduce(Index row, Index first, Index width, double* tiles) const {
    const Index count = std::min(kTileRows, n_ - row);
    const double* const rows = rows_.data() + panel(row / kTileRows);
    alignas(64) double tile[kTileRows * kTileColumns];
    for (Index column = 0; column < width; column += kTileColumns) {
      multiply_tile(rows, columns_.data() + column * first, first, tile);
      for (Index c = 0; c < std::min(kTileColumns, width - column); ++c) {
        const double* const in = A_.data() + (first + column + c) * A_.outerStride() + row;
        double* const out = tiles + (column + c) * kTileRows;
        for (Index r = 0; r < kTileRows; ++r)
          out[r] = (r < count ? in[r] : 0.0) - tile[c * kTileRows + r];
      }
    }
  }

  /// The rows below the leaf that begins at `first`, times the transpose of its inverse.
  void divide_below(Index first, const Leaf& inverse) {
    if (first + kLeaf >= n_) return;
    pack_columns(inverse, inverse_);
    alignas(64) double tiles[kTileRows * kLeaf];
    for (Index row = first + kLeaf; row < n_; row += kTileRows) {
      reduce(row, first, kLeaf, tiles);
      double* const out = rows_.data() + panel(row / kTileRows) + first * kTileRows;
      for (Index column = 0; column < kLeaf; column += kTileColumns)  // the others are zero
        multiply_tile(tiles, inverse_.data() + column * kLeaf, column + kTileColumns,
                      out + column * kTileRows);
      const Index count = std::min(kTileRows, n_ - row);
      for (Index c = 0; c < kLeaf; ++c)
        std::memcpy(A_.data() + (first + c) * A_.outerStride() + row, out + c * kTileRows,
                    static_cast<std::size_t>(count) * sizeof(double));
    }
  }

  Block A_;
  Leaf* inverses_;
  bool is_last_;
  Index n_;
  // Kept from one factorisation to the next: to get their memory takes longer than to fill it.
  static thread_local std::vector<double> rows_;     ///< Of the factor, packed for multiply_tile().
  static thread_local std::vector<double> columns_;  ///< Of the rows of one leaf.
  static thread_local std::vector<double> inverse_;
};

thread_local std::vector<double> ColumnFactorisation::rows_;
thread_local std::vector<double> ColumnFactorisation::columns_;
thread_local std::vector<double> ColumnFactorisation::inverse_;

/// A factorisation of blocks on the diagonal, the inverses of whose leaves are kept: every block
/// off the diagonal is multiplied by some of them.
class Factorisation {
 public:
  explicit Factorisation(Index n)
      : n_(n), inverses_(static_cast<std::size_t>((n + kLeaf - 1) / kLeaf)) {}

  /// @param at  Where in the whole matrix A begins: a multiple of a leaf.
  bool factor(Block A, Index at) {
    const Index n = A.rows();
    if (n <= kMostByColumns)
      return ColumnFactorisation(A, inverses_.data() + at / kLeaf, at + n == n_).run();
    const Index k = half(n);
    if (!factor(A.topLeftCorner(k, k), at)) return false;
    divide(A.topLeftCorner(k, k), A.bottomLeftCorner(n - k, k), at);
    add_gram(A.bottomLeftCorner(n - k, k), -1.0, A.bottomRightCorner(n - k, n - k));
    return factor(A.bottomRightCorner(n - k, n - k), at + k);
  }

 private:
  /// B L'^-1, in place, of the factor L that begins at `at`.
  void divide(const ConstBlock& L, Block B, Index at) {
    const Index n = L.rows();
    if (n <= kLeaf) {
      const Eigen::MatrixXd undivided = B;
      B.setZero();
      const Leaf& inverse = inverses_[static_cast<std::size_t>(at / kLeaf)];
      add_product(undivided, inverse.topLeftCorner(n, n), 1.0, B);
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

constexpr Index kColumns = 4;  // Taken together: x is read and written once for all of them.

/// Eight entries, which the compiler lays into the registers that there are.
using Eight [[gnu::vector_size(64), gnu::aligned(8), gnu::may_alias]] = double;

constexpr Index kEight = 8;

/// Replaces x by L^-1 x.
MAPPROOF_VECTORISED_WIDE void solve_lower(const double* L, Index stride, Index n, double* x) {
  Index j = 0;
  for (; j + kColumns <= n; j += kColumns) {
    const double* const columns[kColumns] = {L + j * stride, L + (j + 1) * stride,
                                             L + (j + 2) * stride, L + (j + 3) * stride};
    for (Index c = 0; c < kColumns; ++c) {
      x[j + c] /= columns[c][j + c];
      for (Index r = c + 1; r < kColumns; ++r) x[j + r] -= x[j + c] * columns[c][j + r];
    }
    const double a = x[j], b = x[j + 1], c = x[j + 2], d = x[j + 3];
    for (Index i = j + kColumns; i < n; ++i)
      x[i] = (((x[i] - a * columns[0][i]) - b * columns[1][i]) - c * columns[2][i]) -
             d * columns[3][i];
  }
  for (; j < n; ++j) {
    x[j] /= L[j * stride + j];
    for (Index i = j + 1; i < n; ++i) x[i] -= x[j] * L[j * stride + i];
  }
}

/// Replaces x by L'^-1 x.
MAPPROOF_VECTORISED_WIDE void solve_upper(const double* L, Index stride, Index n, double* x) {
  Index end = n;
  for (; end % kColumns != 0; --end) {
    const double* const column = L + (end - 1) * stride;
    for (Index i = end; i < n; ++i) x[end - 1] -= column[i] * x[i];
    x[end - 1] /= column[end - 1];
  }
  for (Index j = end - kColumns; j >= 0; j -= kColumns) {
    const double* const columns = L + j * stride;
    Eight a{}, b{}, c{}, d{};
    Index i = j + kColumns;
    for (; i + kEight <= n; i += kEight) {
      const Eight at = *reinterpret_cast<const Eight*>(x + i);
      a += *reinterpret_cast<const Eight*>(columns + i) * at;
      b += *reinterpret_cast<const Eight*>(columns + stride + i) * at;
      c += *reinterpret_cast<const Eight*>(columns + 2 * stride + i) * at;
      d += *reinterpret_cast<const Eight*>(columns + 3 * stride + i) * at;
    }
    double sums[kColumns] = {};
    for (; i < n; ++i)
      for (Index k = 0; k < kColumns; ++k) sums[k] += columns[k * stride + i] * x[i];
    for (Index r = 0; r < kEight; ++r) {
      sums[0] += a[r];
      sums[1] += b[r];
      sums[2] += c[r];
      sums[3] += d[r];
    }
    for (Index k = kColumns - 1; k >= 0; --k) {
      double entry = x[j + k] - sums[k];
      for (Index r = k + 1; r < kColumns; ++r) entry -= columns[k * stride + j + r] * x[j + r];
      x[j + k] = entry / columns[k * stride + j + k];
    }
  }
}

/// Columns of L^-1, some at a time while a column of L is in the cache. `inverse` is the identity.
MAPPROOF_VECTORISED_WIDE void invert(const double* L, Index stride, Index n, double* inverse) {
  for (Index first = 0; first < n; first += kEight)
    for (Index j = first; j < n; ++j) {
      const double* const column = L + j * stride;
      for (Index c = first; c < std::min(first + kEight, j + 1); ++c) {
        double* const x = inverse + c * n;
        const double entry = x[j] / column[j];
        for (Index i = j + 1; i < n; ++i) x[i] -= entry * column[i];
        x[j] = entry;
      }
    }
}

/// y = A x. Some rows at a time stay in registers.
MAPPROOF_VECTORISED_WIDE void multiply_rows(const double* A, Index rows, Index columns,
                                            const double* x, double* y) {
  Index i = 0;
  for (; i + 4 * kEight <= rows; i += 4 * kEight) {
    Eight a{}, b{}, c{}, d{};
    for (Index j = 0; j < columns; ++j) {
      const double* const column = A + j * rows + i;
      a += *reinterpret_cast<const Eight*>(column) * x[j];
      b += *reinterpret_cast<const Eight*>(column + kEight) * x[j];
      c += *reinterpret_cast<const Eight*>(column + 2 * kEight) * x[j];
      d += *reinterpret_cast<const Eight*>(column + 3 * kEight) * x[j];
    }
    *reinterpret_cast<Eight*>(y + i) = a;
    *reinterpret_cast<Eight*>(y + i + kEight) = b;
    *reinterpret_cast<Eight*>(y + i + 2 * kEight) = c;
    *reinterpret_cast<Eight*>(y + i + 3 * kEight) = d;
  }
  for (; i + kEight <= rows; i += kEight) {
    Eight a{};
    for (Index j = 0; j < columns; ++j)
      a += *reinterpret_cast<const Eight*>(A + j * rows + i) * x[j];
    *reinterpret_cast<Eight*>(y + i) = a;
  }
  for (; i < rows; ++i) {
    double sum = 0.0;
    for (Index j = 0; j < columns; ++j) sum += A[j * rows + i] * x[j];
    y[i] = sum;
  }
}

constexpr double kSharp = 0.005;  // Of an eigenvalue: the rest would not shorten a step.
constexpr int kStepsToJudge = 5;  // Between two looks at the result.
constexpr int kMostSteps = 60;
constexpr double kNoRest = 1e-12;  // The start's Krylov space is all there is.

/// A symmetric tridiagonal matrix.
struct Tridiagonal {
  std::vector<double> diagonal;
  std::vector<double> beside;  ///< One entry less, or as many: the last one is not part of it.

  /// Whether all eigenvalues are above x: whether the Cholesky factor's squares are positive.
  bool is_above(double x) const {
    double pivot = diagonal[0] - x;
    for (std::size_t i = 1; i < diagonal.size() && pivot > 0.0; ++i)
      pivot = diagonal[i] - x - beside[i - 1] * beside[i - 1] / pivot;
    return pivot > 0.0;
  }

  /// Just below the smallest eigenvalue, which is at most `above`.
  double smallest(double above) const {
    double step = kSharp * std::max(std::abs(above), 1.0);
    double below = above - step;
    while (!is_above(below)) {
      above = below;
      step *= 4.0;
      below -= step;
    }
    while (above - below > 0.1 * kSharp * std::max(std::abs(above), 1.0)) {
      const double middle = 0.5 * (above + below);
      (is_above(middle) ? below : above) = middle;
    }
    return below;
  }
};

}  // namespace

bool factor_cholesky(Block A) { return Factorisation(A.rows()).factor(A, 0); }

Eigen::VectorXd solve_cholesky(const Eigen::MatrixXd& L, const Eigen::VectorXd& b) {
  Eigen::VectorXd x = b;
  solve_lower(L.data(), L.rows(), L.rows(), x.data());
  solve_upper(L.data(), L.rows(), L.rows(), x.data());
  return x;
}

Eigen::MatrixXd inverse_of_lower(const Eigen::MatrixXd& L) {
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(L.rows(), L.cols());
  invert(L.data(), L.rows(), L.rows(), inverse.data());
  return inverse;
}

void multiply(const Eigen::MatrixXd& A, const Eigen::VectorXd& x, Eigen::VectorXd& y) {
  multiply_rows(A.data(), A.rows(), A.cols(), x.data(), y.data());
}

bool Definite::set(MatrixXd A) {
  MatrixXd L = A;
  if (!factor_cholesky(L)) return false;
  matrix_ = std::move(A);
  inverse_factor_ = inverse_of_lower(L);
  transposed_ = inverse_factor_.transpose();
  return true;
}

MatrixXd Definite::inverse() const { return gram(transposed_); }

VectorXd Definite::scaled(const MatrixXd& D, const VectorXd& v) const {
  VectorXd result(v.size());
  VectorXd between(v.size());
  multiply(transposed_, v, result);
  multiply(D, result, between);
  multiply(inverse_factor_, between, result);
  return result;
}

double smallest_eigenvalue(const Definite& A, const MatrixXd& D) {
  const Index n = D.rows();
  VectorXd v(n);
  for (Index i = 0; i < n; ++i) v(i) = 1.0 + std::fmod(0.618 * static_cast<double>(i), 1.0);
  v.normalize();
  VectorXd before = VectorXd::Zero(n);
  Tridiagonal T;
  double beside = 0.0;
  double smallest = kInfinity;
  for (int steps = 1;; ++steps) {
    VectorXd next = A.scaled(D, v);
    const double along = v.dot(next);
    next -= along * v + beside * before;
    beside = next.norm();
    T.diagonal.push_back(along);
    T.beside.push_back(beside);
    if (!(std::abs(along) + beside < kInfinity)) return -kInfinity;
    const bool is_whole = steps == n || beside <= kNoRest * std::abs(along);
    if (is_whole || steps % kStepsToJudge == 0) {
      const double last = smallest;
      smallest = T.smallest(std::min(last, *std::ranges::min_element(T.diagonal)));
      const double fall = last - smallest;
      if (is_whole) return smallest;
      if (fall < kSharp * std::max(std::abs(smallest), 1.0) || steps >= kMostSteps)
        return smallest - fall;
    }
    before = std::move(v);
    v = next / beside;
  }
}

}  // namespace mapproof
