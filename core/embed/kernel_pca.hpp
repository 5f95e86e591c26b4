#pragma once

#include <Eigen/Core>

#include "core/model/embedding.hpp"

namespace mapproof {

/// The Gaussian kernel k(a, b) = exp(-|a - b|^2 / (2 sigma2)).
struct GaussianKernel {
  double variance = 1.0;  ///< sigma2, > 0, in units of squared distance.
};

/// The polynomial kernel k(a, b) = (a'b + 1)^degree.
struct PolynomialKernel {
  int degree = 2;  ///< 1 to 20.
};

/// Kernel PCA: PCA in the kernel's space of features, by its centred matrix [schoelkopf1998;
/// yairi2007, section 4.2].
///
/// @param squared_distances  n x n, symmetric, zero diagonal, finite, n >= 3.
/// @return As of principal_coordinates: kRankDeficient if the kernel is constant, kUndetermined if
///         it is that of landmarks that are all equally far.
/// @throws InvalidInput if the bounds above are broken.
/// @note O(n^2) time in addition to that of the eigenvalues.
Embedding kernel_pca(const Eigen::MatrixXd& squared_distances, const GaussianKernel& kernel);

/// The same with the polynomial kernel.
/// @param inner_products  n x n, symmetric, finite, n >= 3.
/// @return Where the kernel's values would overflow, the map of the kernel over its largest value.
/// @throws InvalidInput if the bounds above are broken.
Embedding kernel_pca(const Eigen::MatrixXd& inner_products, const PolynomialKernel& kernel);

}  // namespace mapproof
