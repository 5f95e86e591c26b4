#pragma once

#include <array>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// Where landmarks lie in the space of their observation histories, seen in three dimensions.
struct ObservationManifold {
  Eigen::MatrixXd coordinates;             ///< M x 3; NaN rows: not to be told.
  std::array<double, 3> shares{};          ///< Of all spread in each coordinate, descending.
  int neighbours = 0;                      ///< K of the neighbour graph.
  std::vector<std::pair<int, int>> edges;  ///< Its edges, each once, the lower row first.
};

}  // namespace mapproof
