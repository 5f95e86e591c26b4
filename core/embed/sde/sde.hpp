#pragma once

#include <Eigen/Core>

#include "core/graph/neighbours.hpp"
#include "core/model/embedding.hpp"

namespace mapproof {

/// How a semidefinite embedding is computed.
struct SdeOptions {
  NeighbourOptions neighbours;
  /// kInteriorPoint stands for ours: low rank above unfolding::kMostInteriorPairs.
  SdpSolver solver = SdpSolver::kInteriorPoint;
  double relative_gap = kCertifiedGap;              ///< To be certified, in (0, 1).
  double constraint_residual = kCertifiedResidual;  ///< To be reached, in (0, 1).
};

/// Semidefinite embedding, or maximum variance unfolding [weinberger2004]: the points of greatest
/// variance that keep the distances of all pairs within {i} and its K nearest, for every i.
///
/// @param distances  n x n, symmetric, zero diagonal, entries >= 0; infinite entries are not kept.
/// @return Centred, columns orthogonal, in descending order of spread; the spectrum holds up to 10
///         eigenvalues, the certificate how near the optimum they are. kBridged and kFailed as
///         isomap(); kRankDeficient as lpca(); kNotEuclidean where the bound shows that no points
///         have such distances; kUncertified, with the numbers, if the requested gap or residual
///         was
/// not reached.
/// @throws InvalidInput if K is not in [1, n), n < 3 or an option is out of bounds; if CSDP is
///         requested by name, for more than unfolding::kMostCsdpPairs pairs.
Embedding sde(const Eigen::MatrixXd& distances, const SdeOptions& options);

}  // namespace mapproof
