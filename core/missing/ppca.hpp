#pragma once

#include <vector>

#include "core/missing/low_rank.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// How probabilistic PCA is fitted.
struct PpcaOptions {
  int dimensions = 10;  ///< q, 1 <= q < M.
  /// Stop once an iteration raises the log likelihood by less than this for each observed entry,
  /// >= 0.
  double least_rise = 2e-4;
  int max_iterations = 300;  ///< >= 1.
};

/// Columns y = W x + mean + noise with x ~ N(0, I_q) and noise ~ N(0, noise I).
struct Ppca {
  LowRankModel model;            ///< Its ridge is the variance of the noise.
  double log_likelihood = 0.0;   ///< Of the observed entries, under `model`, nats.
  std::vector<double> rises;     ///< Of the log likelihood, an iteration each.
  std::vector<Status> statuses;  ///< kNotConverged if the limit of iterations came first.
};

/// Probabilistic PCA of a matrix with missing entries by EM [tipping1999] [ilin2010]: each column
/// is a sample of M variables, of which it shows some. Missing entries count as missing at random.
///
/// Every iteration is followed by the change of coordinates that makes the x of all columns white,
/// which leaves fit and likelihood no worse and EM much faster [liu1998].
/// @param matrix  M x C, every row observed once or more.
/// @throws InvalidInput if the bounds above are broken.
/// @note O(E q^2 + C q^3) time an iteration for E observed entries, less where columns show the
///       same rows. Deterministic: it starts from pairwise_start().
Ppca ppca(const Features& matrix, const PpcaOptions& options = {});

}  // namespace mapproof
