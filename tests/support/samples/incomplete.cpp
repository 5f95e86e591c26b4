#include "tests/support/samples/incomplete.hpp"

#include <cmath>

#include "core/base/random.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/world.hpp"

namespace mapproof::test {

WalkedRoom walked_room(std::uint64_t seed, int steps, int landmarks) {
  Random random(seed);
  WorldOptions room;
  room.landmarks = landmarks;
  room.side_m = 2.5 * std::sqrt(landmarks / 50.0);
  WalkedRoom walked;
  walked.world = scatter_landmarks(room, random);
  walked.path = random_walk(walked.world, {}, steps, random);
  walked.anchors = place_anchors(walked.world, 4, AnchorPlacement::kWalls, random);
  return walked;
}

Features incomplete_matrix(const IncompleteMatrix& of, std::uint64_t seed) {
  const auto [rows, columns, dimensions, noise, share] = of;
  Random random(seed);
  const auto normal = [&](Eigen::Index m, Eigen::Index n) {
    Eigen::MatrixXd matrix(m, n);
    for (double& entry : matrix.reshaped()) entry = random.normal();
    return matrix;
  };
  const Eigen::MatrixXd W = normal(rows, dimensions);
  const Eigen::VectorXd mean = normal(rows, 1);
  Features result;
  result.values = (W * normal(dimensions, columns)).colwise() + mean;
  result.values += noise * normal(rows, columns);
  if (share <= 0.0) return result;
  result.observed = Eigen::MatrixXd::Ones(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index c = 0; c < columns; ++c)
      if (c != i % columns && random.uniform() < share) result.observed(i, c) = 0.0;
  result.values = result.values.cwiseProduct(result.observed);
  return result;
}

}  // namespace mapproof::test
