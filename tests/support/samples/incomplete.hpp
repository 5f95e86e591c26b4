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

/// A matrix to fill, and what is missing of it.
struct IncompleteMatrix {
  Eigen::Index rows = 0;
  Eigen::Index columns = 0;
  Eigen::Index dimensions = 0;
  double noise = 0.0;
  double share = 0.0;  ///< Of its entries that are missing.
};

/// W x + mean + noise of standard normal x, one for each column; every row keeps one entry.
Features incomplete_matrix(const IncompleteMatrix& of, std::uint64_t seed);

}  // namespace mapproof::test
