#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"
#include "core/model/sighting_log.hpp"

namespace mapproof {

/// What the covariances of a map of pairs refer to, and how they are drawn.
struct PairBootstrapOptions {
  Points positions_m;                 ///< M x 2: the anchors' places are read; or the estimate.
  std::vector<Eigen::Index> anchors;  ///< Empty: maps are laid on `positions_m` rigidly.
  int replicates = 200;
  int block_looks = 100;  ///< Consecutive looks that are drawn together: they are correlated.
  std::uint64_t seed = 1;
};

/// How far each landmark of the map of pairs would move if other looks had been taken: covariances
/// over maps of blocks of looks drawn anew [kuensch1989], fitted to the anchors as the map is.
/// @return M; NaN where fewer than half of the maps place the landmark.
/// @throws InvalidInput if a bound is broken.
/// @note As costly as `replicates` maps.
std::vector<Eigen::Matrix2d> pair_covariances(const SightingLog& log,
                                              const PairBootstrapOptions& options);

}  // namespace mapproof
