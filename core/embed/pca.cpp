#include "core/embed/pca.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.hpp"
#include "core/linalg/centering.hpp"
#include "core/linalg/symmetric_eigen.hpp"
#include "core/linalg/unset_matrix.hpp"

namespace mapproof {
namespace {

/// Eigenvalues up to this share of the largest, or of the matrix, are rounding.
constexpr double kCoordinateRounding = 1e-12;
/// Eigenvalues nearer to each other than this share of the largest count as one.
constexpr double kEqualEigenvalues = 1e-10;

void check(const Eigen::MatrixXd& matrix) {
  if (matrix.rows() < 3 || matrix.cols() != matrix.rows())
    throw InvalidInput("kernel PCA needs a square matrix of at least 3 landmarks");
  if (!matrix.allFinite()) throw InvalidInput("kernel PCA needs finite values");
}

/// A second eigenvalue within these many times the mean one is not an axis of a map: all are alike.
constexpr double kLeastOfMean = 0.5;
constexpr double kMostOfMean = 2.0;

Embedding of_kernel(Eigen::MatrixXd K) {
  const double size = K.cwiseAbs().maxCoeff();
  const Eigen::MatrixXd B = centered(std::move(K));
  const double mean = B.trace() / static_cast<double>(B.rows() - 1);
  Embedding result = principal_coordinates(B, size);
  const bool is_said = std::ranges::any_of(result.statuses, [](const Status& status) {
    return status.code == StatusCode::kUndetermined || status.code == StatusCode::kRankDeficient;
  });
  // Three landmarks or four have too few eigenvalues to decide.
  if (!is_said && B.rows() > 4 && result.spectrum.size() > 1 &&
      result.spectrum(1) > kLeastOfMean * mean && result.spectrum(1) < kMostOfMean * mean)
    result.statuses.push_back(status_of<StatusReason::kEqualKernel>(result.spectrum(1) / mean));
  return result;
}

}  // namespace

namespace {

constexpr Eigen::Index kSpectrum = 10;  // Eigenvalues that a map keeps.

/// @param pairs  Three or more of n.
Embedding coordinates_of(const EigenPairs& pairs, double size) {
  Embedding result;
  result.spectrum = pairs.values;
  result.coordinates.setZero(pairs.vectors.rows(), 2);
  const double floor = kCoordinateRounding * std::max(pairs.values(0), size);
  int rank = 0;
  for (; rank < 2 && pairs.values(rank) > floor; ++rank)
    result.coordinates.col(rank) = std::sqrt(pairs.values(rank)) * pairs.vectors.col(rank);
  if (!pairs.converged)
    result.statuses.push_back(status_of<StatusReason::kEigenvaluesNotConverged>());
  if (rank < 2) {
    result.statuses.push_back(status_of<StatusReason::kDistancesFlat>(rank));
  } else if (pairs.values(1) - pairs.values(2) <= kEqualEigenvalues * pairs.values(0)) {
    result.statuses.push_back(status_of<StatusReason::kEqualEigenvalues>(pairs.values(1)));
  }
  return result;
}

}  // namespace

Embedding principal_coordinates(const Eigen::MatrixXd& B, double size) {
  constexpr Eigen::Index kFewestByBlocks = 512;  // Above that the matrix is not in the cache.
  if (B.rows() >= kFewestByBlocks) {
    const EigenPairs pairs =
        largest_eigenpairs([&](const Eigen::MatrixXd& V) { return product_of_eight(B, V); },
                           B.rows(), {.exact = 3, .count = kSpectrum});
    if (pairs.converged) return coordinates_of(pairs, size);
  }
  return coordinates_of(largest_eigenpairs(B, std::min(B.rows(), kSpectrum)), size);
}

Embedding lpca_of_vectors(const HistoryVectors& vectors) {
  constexpr Eigen::Index kFewest = 100;
  if (vectors.landmarks < kFewest || !std::isfinite(vectors.largest_square))
    throw InvalidInput("LPCA needs finite vectors of at least 100 landmarks");
  const auto center = [](Eigen::MatrixXd& columns) {
    columns.rowwise() -= columns.colwise().mean().eval();
  };
  const BlockProduct product = [&](const Eigen::MatrixXd& V) {
    Eigen::MatrixXd centred = V;
    center(centred);
    Eigen::MatrixXd result = vectors.product(centred);
    center(result);
    return result;
  };
  return coordinates_of(
      largest_eigenpairs(product, vectors.landmarks, {.exact = 3, .count = kSpectrum}),
      4.0 * vectors.largest_square);
}

Embedding lpca_of_vectors(const Eigen::MatrixXd& vectors) {
  return lpca_of_vectors(HistoryVectors{
      .landmarks = vectors.rows(),
      .product = [&](const Eigen::MatrixXd& V) { return gram_product(vectors, V); },
      .largest_square = vectors.rows() > 0 ? vectors.rowwise().squaredNorm().maxCoeff() : 0.0});
}

Embedding lpca(const Eigen::MatrixXd& squared_distances) {
  const Eigen::Index n = squared_distances.rows();
  if (n < 3 || squared_distances.cols() != n)
    throw InvalidInput("LPCA needs a square matrix of at least 3 landmarks");
  return principal_coordinates(double_centered(squared_distances), squared_distances.maxCoeff());
}

Embedding kernel_pca(const Eigen::MatrixXd& squared_distances, const GaussianKernel& kernel) {
  check(squared_distances);
  if (!(kernel.variance > 0.0)) throw InvalidInput("a Gaussian kernel needs a variance above 0");
  Eigen::MatrixXd K = unset_matrix(squared_distances.rows(), squared_distances.cols());
  K = (squared_distances.array() / (-2.0 * kernel.variance)).exp();
  return of_kernel(std::move(K));
}

Embedding kernel_pca(const Eigen::MatrixXd& inner_products, const PolynomialKernel& kernel) {
  check(inner_products);
  if (kernel.degree < 1 || kernel.degree > 20)
    throw InvalidInput("a polynomial kernel needs a degree from 1 to 20");
  // Divided by its largest value, so that no power overflows; the map then gets its scale back.
  const double largest = std::max((inner_products.array() + 1.0).abs().maxCoeff(), 1e-300);
  Eigen::MatrixXd K = unset_matrix(inner_products.rows(), inner_products.cols());
  for (Eigen::Index j = 0; j < K.cols(); ++j) {
    const Eigen::ArrayXd base = (inner_products.col(j).array() + 1.0) / largest;
    auto power = K.col(j).array();
    power = base;
    for (int exponent = 1; exponent < kernel.degree; ++exponent) power *= base;
  }
  Embedding result = of_kernel(std::move(K));
  const double scale = std::pow(largest, kernel.degree);
  if (scale > 0.0 && std::isfinite(scale * result.spectrum.cwiseAbs().maxCoeff())) {
    result.coordinates *= std::sqrt(scale);
    result.spectrum *= scale;
  }
  return result;
}

}  // namespace mapproof
