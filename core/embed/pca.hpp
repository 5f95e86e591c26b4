#pragma once

#include <Eigen/Core>

#include "core/model/embedding.hpp"
#include "core/observe/history_vectors.hpp"

namespace mapproof {

/// The two directions of most spread behind centred inner products: v_k sqrt(lambda_k) of the two
/// largest eigenpairs.
///
/// @param B     n x n, n >= 3, symmetric, finite, rows and columns summing to zero.
/// @param size  The largest value that B was computed from, for a bound on its rounding.
/// @return Columns orthogonal, in descending order of spread; kRankDeficient if fewer than two
///         eigenvalues are above 1e-12 of the largest and of `size` (the missing columns are zero);
///         kUndetermined if the third largest equals the second; kNotConverged if the eigenvalues'
///         solver gave up. The spectrum holds up to 10 eigenvalues; from n = 512 on those after the
///         third are exact to 1e-5 of the first.
/// @note O(n^3) time up to n = 80, above that O(n^2) an iteration (see symmetric_eigen.hpp).
Embedding principal_coordinates(const Eigen::MatrixXd& B, double size);

/// Linear PCA of the observation vectors by classical scaling of their distances, which gives the
/// same coordinates [torgerson1952].
///
/// @param squared_distances  n x n, symmetric, zero diagonal, finite, n >= 3.
/// @return Centred, columns orthogonal, in descending order of spread; kRankDeficient if the data
///         spread in fewer than two directions (the missing columns are zero); kUndetermined and
///         kNotConverged as of principal_coordinates. The spectrum holds up to 10 eigenvalues.
/// @throws InvalidInput if the matrix breaks the bounds above.
/// @note O(n^3) time, O(n^2) memory.
Embedding lpca(const Eigen::MatrixXd& squared_distances);

/// The same of the vectors themselves, without their distances: the leading eigenpairs alone, by
/// products with the vectors (see symmetric_eigen.hpp).
///
/// @param vectors  n x c, n >= 100, finite.
/// @return As lpca() of their distances, to 1e-10 of the map's size; of the spectrum the first two
///         values are exact to rounding, the others to 1e-5 of the first.
/// @throws InvalidInput if the bounds above are broken.
/// @note O(n c) time for each of some six products.
Embedding lpca_of_vectors(const Eigen::MatrixXd& vectors);

/// The same where only products with the vectors are known.
/// @param vectors  Of 100 landmarks or more.
/// @note Some six to eight products; 832 n bytes.
Embedding lpca_of_vectors(const HistoryVectors& vectors);

/// Whether that takes less time than the distances and lpca(): of n complete vectors of length c.
inline bool is_faster_by_vectors(Eigen::Index n, Eigen::Index c) {
  constexpr Eigen::Index kMostHeld = 40'000'000;  ///< See history_vectors().
  return n >= (n * c <= kMostHeld ? 160 : 2000);
}

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
