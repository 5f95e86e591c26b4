#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

struct BootstrapOptions {
  int replicates = 200;    ///< 2 to 100,000.
  Eigen::Index block = 1;  ///< Consecutive steps drawn together, >= 1: a window's, so that draws
                           ///< are nearly independent.
  std::uint64_t seed = 1;
};

/// How far landmarks move between bootstrap resamples of the steps.
struct LandmarkBootstrap {
  std::vector<Eigen::Matrix2d> covariances_m2;  ///< N; empty if fewer than 2 maps came out.
  int maps = 0;                                 ///< Draws that gave a map.
};

/// Covariances of the landmarks of a spectral map, by bootstrap resamples of blocks of steps, each
/// mapped again.
///
/// Where no landmark is known every map is aligned to `landmarks_m` by the similarity or mirrored
/// similarity that fits best: what the map leaves open is not uncertainty, nor is its scale, which
/// odometry determines.
/// @param Y            N x T, 1/2 d^2.
/// @param landmarks_m  N x 2, the map made from Y.
/// @throws InvalidInput if a bound is broken.
/// @note O(N^2 T) time per draw.
LandmarkBootstrap bootstrap_landmarks(const Eigen::MatrixXd& Y, const Points& landmarks_m,
                                      const std::optional<KnownLandmarks>& known,
                                      const BootstrapOptions& options);

}  // namespace mapproof
