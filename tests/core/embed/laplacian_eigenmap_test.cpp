#include "core/embed/bottom_eigenmap.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

/// Each node joined to the `reach` next ones around a ring.
Graph ring(Eigen::Index n, Eigen::Index reach) {
  Graph graph(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index step = -reach; step <= reach; ++step)
      if (step != 0) graph[static_cast<std::size_t>(i)].push_back({(i + step + n) % n, 1.0});
  return graph;
}

TEST(LaplacianEigenmap, DrawsARingAsACircle) {
  for (const Eigen::Index n : {12, 60, 400}) {  // dense, and by the inverse
    const Embedding map = laplacian_eigenmap(ring(n, 1));
    const double expected = 1.0 - std::cos(2.0 * std::numbers::pi / static_cast<double>(n));
    EXPECT_NEAR(map.spectrum(0), expected, 1e-12);
    EXPECT_NEAR(map.spectrum(1), expected, 1e-12);
    const Eigen::ArrayXd radius = map.coordinates.rowwise().norm();
    EXPECT_LT((radius - 1.0 / std::sqrt(static_cast<double>(n))).abs().maxCoeff(), 1e-9);
  }
}

TEST(LaplacianEigenmap, ReportsThatACompleteGraphHasNoMap) {
  const Embedding map = laplacian_eigenmap(ring(7, 3));
  EXPECT_NEAR(map.spectrum(0), 7.0 / 6.0, 1e-12);
  ASSERT_FALSE(map.statuses.empty());
  EXPECT_EQ(map.statuses.front().code, StatusCode::kUndetermined);
}

TEST(LaplacianEigenmap, IsOrthonormalUnderTheDegrees) {
  const Graph graph =
      neighbour_graph(test::distances_of(test::scattered(50, 2)), {.neighbours = 5});
  const Points map = laplacian_eigenmap(graph).coordinates;
  Eigen::VectorXd degree(50);
  for (Eigen::Index i = 0; i < 50; ++i)
    degree(i) = static_cast<double>(graph[static_cast<std::size_t>(i)].size());
  const Eigen::Matrix2d product = map.transpose() * degree.asDiagonal() * map;
  EXPECT_LT((product - Eigen::Matrix2d::Identity()).norm(), 1e-12);
  EXPECT_LT((map.transpose() * degree).norm(), 1e-12);
}

TEST(LaplacianEigenmap, RefusesNodesWithoutEdges) {
  EXPECT_THROW(laplacian_eigenmap(Graph(5)), InvalidInput);
  EXPECT_THROW(laplacian_eigenmap(ring(2, 1)), InvalidInput);
}

}  // namespace
}  // namespace mapproof
