#pragma once

#include <vector>

#include "core/missing/low_rank.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// How PCA of incomplete data is fitted.
struct RegularisedPcaOptions {
  int dimensions = 10;  ///< q, 1 <= q < M.
  /// Penalty on the squares of W and x, as a share of the largest singular value that the matrix
  /// would have if it were complete, > 0.
  double penalty_share = 0.003;
  double least_fall = 1e-4;  ///< Stop once an iteration lowers the loss by less than this share.
  int max_iterations = 300;  ///< >= 1.
};

/// The plane that fits the observed entries best.
struct RegularisedPca {
  LowRankModel model;
  std::vector<double> losses;    ///< Of each iteration, never rising.
  std::vector<Status> statuses;  ///< kNotConverged if the limit of iterations came first.
};

/// PCA of a matrix with missing entries: least sum over the observed entries of
/// (y - W x - mean)^2 + penalty (|W|^2 + |x|^2), by alternating least squares [ilin2010]. Without
/// the penalty entries that are hardly held run away.
///
/// The penalty is that of the nuclear norm of W X [hastie2015].
/// @param matrix  M x C, every row observed once or more.
/// @throws InvalidInput if the bounds above are broken.
/// @note As costly as ppca(). Deterministic.
RegularisedPca regularised_pca(const Features& matrix, const RegularisedPcaOptions& options = {});

}  // namespace mapproof
