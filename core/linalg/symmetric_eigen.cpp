#include "core/linalg/symmetric_eigen.hpp"

#include <algorithm>
#include <cmath>

#include <Spectra/SymEigsSolver.h>
#include <Eigen/SparseCholesky>

#include "core/base/errors.hpp"
#include "core/base/vectorised.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/packed_product.hpp"
#include "core/linalg/sign.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kDenseLimit = 40;

EigenPairs dense(const Eigen::MatrixXd& matrix, Eigen::Index k) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {.values = solver.eigenvalues().tail(k).reverse(),
          .vectors = solver.eigenvectors().rightCols(k).rowwise().reverse(),
          .converged = solver.info() == Eigen::Success};
}

/// Whether an operator has a larger eigenvalue than the smallest found, in the remaining
/// directions: Lanczos can miss copies of a multiple eigenvalue. A few steps of the power method
/// decide, from a fixed start without symmetry.
template <typename Operator>
bool missed_any(const Operator& op, const EigenPairs& found) {
  constexpr int kSteps = 6;
  const Eigen::Index n = op.rows();
  Eigen::VectorXd x(n), y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double turn = 0.6180339887498949 * static_cast<double>(i + 1);  // spreads evenly
    x(i) = turn - std::floor(turn) - 0.5;
  }
  double largest = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    x -= found.vectors * (found.vectors.transpose() * x);
    const double length = x.norm();
    if (!(length > 0.0)) return false;
    x /= length;
    op.perform_op(x.data(), y.data());
    largest = x.dot(y);
    x = y;
  }
  const double smallest = found.values.minCoeff();
  return largest > smallest + 1e-6 * std::abs(smallest);
}

/// The k largest eigenpairs of an operator, from a fixed start; not converged if any is in doubt.
template <typename Operator>
EigenPairs lanczos(Operator& op, Eigen::Index k) {
  const Eigen::Index basis = std::min(op.rows(), std::max<Eigen::Index>(4 * k, 20));
  Spectra::SymEigsSolver<Operator> solver(op, k, basis);
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge, 300, 1e-12);
  if (solver.info() != Spectra::CompInfo::Successful)
    return {.values = {}, .vectors = {}, .converged = false};
  EigenPairs pairs{.values = solver.eigenvalues(), .vectors = solver.eigenvectors()};
  pairs.converged = !missed_any(op, pairs);
  return pairs;
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
  const double size = largest_row_sum(matrix);
  // Off zero, where the factor would not exist; far below what separates the eigenvectors.
  ShiftedInverse inverse(matrix, null, 1e-11 * size);
  EigenPairs pairs{.values = {}, .vectors = {}, .converged = false};
  if (inverse.usable()) pairs = lanczos(inverse, k);
  if (!pairs.converged) return pairs;

  // The inverse gives the directions; the matrix itself the values, and the residuals.
  const Eigen::MatrixXd V = pairs.vectors;
  const Eigen::MatrixXd AV = matrix * V;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> small(Eigen::MatrixXd(V.transpose() * AV));
  pairs.values = small.eigenvalues();
  pairs.vectors = V * small.eigenvectors();
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
  if (matrix.rows() > kDenseLimit && 8 * k < matrix.rows()) {
    Spectra::DenseSymMatProd<double> product(matrix);
    pairs = lanczos(product, k);
  }
  if (!pairs.converged) pairs = dense(matrix, k);
  fix_signs(pairs.vectors);
  return pairs;
}

namespace {

constexpr Eigen::Index kDenseFrame = 64;  // Up to here all eigenpairs take no longer.
constexpr Eigen::Index kProducts = 3;     // Of the start, in the span of one round.
constexpr int kMostRounds = 8;    // Some fifty products, in half the time of all eigenpairs.
constexpr double kExact = 1e-13;  // Of the largest eigenvalue, what a residual may be.

EigenPairs fixed_dense(const Eigen::MatrixXd& matrix, Eigen::Index k) {
  EigenPairs pairs = dense(matrix, k);
  fix_signs(pairs.vectors);
  return pairs;
}

/// A V of a symmetric A.
Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& V) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(A.rows(), V.cols());
  add_product(A, V.transpose(), 1.0, result);
  return result;
}

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& V) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(V);
  return qr.householderQ() * Eigen::MatrixXd::Identity(V.rows(), V.cols());
}

/// Columns of the start, or of none of its symmetries where it has too few.
Eigen::MatrixXd completed(const Eigen::MatrixXd& start, Eigen::Index count) {
  Eigen::MatrixXd V(start.rows(), count);
  const Eigen::Index known = std::min(count, start.cols());
  V.leftCols(known) = start.leftCols(known).colwise().normalized();
  for (Eigen::Index k = known; k < count; ++k)
    for (Eigen::Index i = 0; i < V.rows(); ++i)
      V(i, k) = std::fmod(0.6180339887498949 * static_cast<double>((i + 1) * (k + 1)), 1.0) - 0.5;
  return orthonormal(V);
}

/// The eigenpairs that the span of V and its next products holds; converged if the first are exact.
EigenPairs ritz_pairs(const Eigen::MatrixXd& A, const Eigen::MatrixXd& V,
                      const LeadingPairs& wanted) {
  const Eigen::Index width = V.cols();
  Eigen::MatrixXd basis(V.rows(), (kProducts + 1) * width);
  Eigen::MatrixXd image(V.rows(), basis.cols());
  basis.leftCols(width) = V;
  for (Eigen::Index k = 0; k <= kProducts; ++k) {
    image.middleCols(k * width, width) = product(A, basis.middleCols(k * width, width));
    if (k == kProducts) break;
    const auto so_far = basis.leftCols((k + 1) * width);
    Eigen::MatrixXd next = image.middleCols(k * width, width);
    for (int twice = 0; twice < 2; ++twice) {  // Its columns may have very different lengths.
      next -= so_far * (so_far.transpose() * next).eval();
      next = orthonormal(next);
    }
    basis.middleCols((k + 1) * width, width) = next;
  }
  const Eigen::MatrixXd inner = basis.transpose() * image;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (inner + inner.transpose()));
  const Eigen::MatrixXd axes = solver.eigenvectors().rowwise().reverse().leftCols(width);
  EigenPairs found{.values = solver.eigenvalues().tail(width).reverse(), .vectors = basis * axes};
  const Eigen::MatrixXd rest = image * axes - found.vectors * found.values.asDiagonal();
  found.converged =
      rest.leftCols(wanted.exact).colwise().norm().maxCoeff() <= kExact * std::abs(found.values(0));
  return found;
}

}  // namespace

EigenPairs leading_eigenpairs(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& start,
                              const LeadingPairs& pairs) {
  const Eigen::Index count = std::min(pairs.count, matrix.rows());
  if (matrix.rows() <= kDenseFrame || start.cols() == 0) return fixed_dense(matrix, count);
  EigenPairs found{.values = {}, .vectors = completed(start, count)};
  for (int round = 0; round < kMostRounds; ++round) {
    found = ritz_pairs(matrix, found.vectors, pairs);
    if (!found.converged) continue;
    fix_signs(found.vectors);
    return found;
  }
  return fixed_dense(matrix, count);
}

namespace {

constexpr Eigen::Index kWidth = 8;        // Vectors of a block.
constexpr Eigen::Index kMostBlocks = 12;  // Of a span.
constexpr int kMostSpans = 8;
constexpr double kExactOfBlocks = 1e-12;  // Of the largest eigenvalue, what a residual may be,
constexpr double kRoughOfBlocks = 1e-5;   // and that of a pair that need not be exact.

/// What is in no span of the others, orthonormal.
Eigen::MatrixXd orthonormal_rest(Eigen::MatrixXd next,
                                 const Eigen::Ref<const Eigen::MatrixXd>& others) {
  for (int twice = 0; twice < 2; ++twice) {
    next -= others * (others.transpose() * next).eval();
    next = orthonormal(next);
  }
  return next;
}

}  // namespace

EigenPairs largest_eigenpairs(const BlockProduct& product, Eigen::Index n,
                              const LeadingPairs& pairs) {
  if (n < kMostBlocks * kWidth || pairs.exact < 1 || pairs.exact > kWidth ||
      pairs.count < pairs.exact || pairs.count > 2 * kWidth)
    throw InvalidInput("eigenpairs: more of them than the blocks hold");
  EigenPairs found{
      .values = {}, .vectors = completed(Eigen::MatrixXd(n, 0), kWidth), .converged = false};
  Eigen::MatrixXd basis(n, kMostBlocks * kWidth), image(n, kMostBlocks * kWidth);
  for (int span = 0; span < kMostSpans && !found.converged; ++span) {
    basis.leftCols(kWidth) = found.vectors.leftCols(kWidth);
    for (Eigen::Index k = 0; k < kMostBlocks && !found.converged; ++k) {
      image.middleCols(k * kWidth, kWidth) = product(basis.middleCols(k * kWidth, kWidth));
      const Eigen::Index width = (k + 1) * kWidth;
      if (width >= pairs.count) {
        const Eigen::MatrixXd inner = basis.leftCols(width).transpose() * image.leftCols(width);
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
            Eigen::MatrixXd(0.5 * (inner + inner.transpose())));
        const Eigen::Index kept = std::max(pairs.count, kWidth);
        const Eigen::MatrixXd axes = solver.eigenvectors().rowwise().reverse().leftCols(kept);
        found.values = solver.eigenvalues().tail(kept).reverse();
        found.vectors = basis.leftCols(width) * axes;
        const Eigen::VectorXd rest =
            (image.leftCols(width) * axes - found.vectors * found.values.asDiagonal())
                .colwise()
                .norm() /
            std::abs(found.values(0));
        found.converged = rest.head(pairs.exact).maxCoeff() <= kExactOfBlocks &&
                          rest.head(pairs.count).maxCoeff() <= kRoughOfBlocks;
      }
      if (k + 1 < kMostBlocks && !found.converged)
        basis.middleCols(width, kWidth) =
            orthonormal_rest(image.middleCols(k * kWidth, kWidth), basis.leftCols(width));
    }
  }
  found.values.conservativeResize(pairs.count);
  found.vectors.conservativeResize(Eigen::NoChange, pairs.count);
  fix_signs(found.vectors);
  return found;
}

namespace {

/// Eight numbers, which go together whatever vectors the processor has.
using Eight = double __attribute__((vector_size(64), aligned(8), may_alias));

/// Adds to `to`, for some columns of X, what they make of `from`: both row by row.
/// @param from, to  n rows.
MAPPROOF_VECTORISED_WIDE void add_columns(const double* X, Eigen::Index n, Eigen::Index columns,
                                          const Eight* from, Eight* to) {
  const double* x[4];
  Eigen::Index c = 0;
  for (; c + 4 <= columns; c += 4) {
    for (int k = 0; k < 4; ++k) x[k] = X + (c + k) * n;
    Eight a{}, b{}, d{}, e{};
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eight v = from[i];
      a += x[0][i] * v;
      b += x[1][i] * v;
      d += x[2][i] * v;
      e += x[3][i] * v;
    }
    for (Eigen::Index i = 0; i < n; ++i)
      to[i] += (x[0][i] * a + x[1][i] * b) + (x[2][i] * d + x[3][i] * e);
  }
  for (; c < columns; ++c) {
    Eight a{};
    for (Eigen::Index i = 0; i < n; ++i) a += X[c * n + i] * from[i];
    for (Eigen::Index i = 0; i < n; ++i) to[i] += X[c * n + i] * a;
  }
}

/// Adds A times `from` to `to`, both row by row.
MAPPROOF_VECTORISED_WIDE void add_matrix(const double* A, Eigen::Index n, const Eight* from,
                                         Eight* to) {
  Eigen::Index j = 0;
  for (; j + 4 <= n; j += 4) {
    const double* a = A + j * n;
    for (Eigen::Index i = 0; i < n; ++i)
      to[i] += (a[i] * from[j] + a[n + i] * from[j + 1]) +
               (a[2 * n + i] * from[j + 2] + a[3 * n + i] * from[j + 3]);
  }
  for (; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i) to[i] += A[j * n + i] * from[j];
}

using EightColumns = Eigen::Matrix<double, Eigen::Dynamic, kWidth, Eigen::RowMajor>;

/// What a function adds to nothing, of vectors that it takes row by row.
template <typename Add>
Eigen::MatrixXd by_rows(const Eigen::MatrixXd& V, Eigen::Index rows, const Add& add) {
  if (V.cols() != kWidth || V.rows() != rows)
    throw InvalidInput("a product takes eight vectors as long as its columns");
  const EightColumns from = V;
  EightColumns to = EightColumns::Zero(rows, kWidth);
  add(reinterpret_cast<const Eight*>(from.data()), reinterpret_cast<Eight*>(to.data()));
  return to;
}

}  // namespace

Eigen::MatrixXd gram_product(const Eigen::MatrixXd& X, const Eigen::MatrixXd& V) {
  return by_rows(V, X.rows(), [&](const Eight* from, Eight* to) {
    add_columns(X.data(), X.rows(), X.cols(), from, to);
  });
}

Eigen::MatrixXd product_of_eight(const Eigen::MatrixXd& A, const Eigen::MatrixXd& V) {
  return by_rows(V, A.rows(),
                 [&](const Eight* from, Eight* to) { add_matrix(A.data(), A.rows(), from, to); });
}

}  // namespace mapproof
