#pragma once

#include <cstdint>

#include "core/model/observation_history.hpp"
#include "core/model/world.hpp"
#include "core/observe/features.hpp"

namespace mapproof::test {

/// A room of 50 landmarks, walked through for some steps.
struct WalkedRoom {
  World world;
  Path path;
  std::vector<Eigen::Index> anchors;
};

WalkedRoom walked_room(std::uint64_t seed, int steps, int landmarks = 50);

/// W x + mean + noise of `columns` standard normal x, a share of its entries missing; every row
/// keeps one.
Features incomplete_matrix(Eigen::Index rows, Eigen::Index columns, Eigen::Index dimensions,
                           double noise, double share, std::uint64_t seed);

}  // namespace mapproof::test
