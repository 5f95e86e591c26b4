#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/model/observation_manifold.hpp"

namespace mapproof {

/// The first three principal coordinates of observation histories [torgerson1952] and their
/// neighbour graph (see neighbour_graph), of the landmarks whose distances to all others of them
/// are known.
///
/// @param squared_distances  M x M, symmetric, zero diagonal, entries >= 0; those of a pair without
///                           common step, or of a landmark that was never seen, are not finite.
/// @param neighbours         K >= 1; fewer where there are fewer landmarks.
/// @return Empty if fewer than four landmarks are left.
/// @note O(M^3) time up to M = 40, above that O(M^2) an iteration.
std::optional<ObservationManifold> observation_manifold(const Eigen::MatrixXd& squared_distances,
                                                        int neighbours);

}  // namespace mapproof
