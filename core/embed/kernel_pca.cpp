#include "core/embed/kernel_pca.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.hpp"
#include "core/embed/principal_coordinates.hpp"
#include "core/linalg/centering.hpp"

namespace mapproof {
namespace {

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

Embedding kernel_pca(const Eigen::MatrixXd& squared_distances, const GaussianKernel& kernel) {
  check(squared_distances);
  if (!(kernel.variance > 0.0)) throw InvalidInput("a Gaussian kernel needs a variance above 0");
  return of_kernel((squared_distances.array() / (-2.0 * kernel.variance)).exp());
}

Embedding kernel_pca(const Eigen::MatrixXd& inner_products, const PolynomialKernel& kernel) {
  check(inner_products);
  if (kernel.degree < 1 || kernel.degree > 20)
    throw InvalidInput("a polynomial kernel needs a degree from 1 to 20");
  // Divided by its largest value, so that no power overflows; the map then gets its scale back.
  const Eigen::ArrayXXd shifted = inner_products.array() + 1.0;
  const double largest = std::max(shifted.abs().maxCoeff(), 1e-300);
  const Eigen::ArrayXXd base = shifted / largest;
  Eigen::ArrayXXd power = base;
  for (int exponent = 1; exponent < kernel.degree; ++exponent) power *= base;
  Embedding result = of_kernel(power.matrix());
  const double scale = std::pow(largest, kernel.degree);
  if (scale > 0.0 && std::isfinite(scale * result.spectrum.cwiseAbs().maxCoeff())) {
    result.coordinates *= std::sqrt(scale);
    result.spectrum *= scale;
  }
  return result;
}

}  // namespace mapproof
