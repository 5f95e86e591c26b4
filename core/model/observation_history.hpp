#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/model/sensor.hpp"

namespace mapproof {

/// Where landmarks lie in the space of their observation histories, seen in three dimensions.
struct ObservationManifold {
  Eigen::MatrixXd coordinates;             ///< M x 3; NaN rows: not determined.
  std::array<double, 3> shares{};          ///< Of all spread in each coordinate, descending.
  int neighbours = 0;                      ///< K of the neighbour graph.
  std::vector<std::pair<int, int>> edges;  ///< Its edges, each once, the lower row first.
};

/// What one sensor observed of M landmarks over N steps [yairi2007, eqs. 3 and 5].
struct ObservationHistory {
  Sensor sensor = Sensor::kVisibility;
  std::vector<std::string> names;  ///< Of the landmarks, M of them, all different.
  Eigen::MatrixXd values;          ///< M x N: 0 or 1, rad, or m. NaN where nothing was observed.

  Eigen::Index landmarks() const { return values.rows(); }
  Eigen::Index steps() const { return values.cols(); }
};

/// The names of those landmarks.
inline std::vector<std::string> names_of(const ObservationHistory& history,
                                         const std::vector<Eigen::Index>& rows) {
  std::vector<std::string> some;
  for (const Eigen::Index row : rows) some.push_back(history.names[static_cast<std::size_t>(row)]);
  return some;
}

}  // namespace mapproof
