#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/graph/components.hpp"
#include "core/graph/neighbours.hpp"
#include "core/graph/shortest_paths.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

using test::distances_of;
using test::scattered;

TEST(NeighbourGraph, HoldsThePairsThatBruteForceFinds) {
  const Eigen::MatrixXd D = distances_of(scattered(40, 1));
  const Graph graph = neighbour_graph(D, {.neighbours = 5});
  const auto rank = [&](Eigen::Index i, Eigen::Index j) {
    return (D.col(i).array() < D(j, i)).count();  // itself counts, at distance 0
  };
  for (Eigen::Index i = 0; i < 40; ++i)
    for (Eigen::Index j = 0; j < 40; ++j) {
      const bool expected = i != j && (rank(i, j) <= 5 || rank(j, i) <= 5);
      const auto& edges = graph[static_cast<std::size_t>(i)];
      const bool found = std::ranges::any_of(edges, [&](const Edge& e) { return e.to == j; });
      EXPECT_EQ(found, expected) << i << " " << j;
    }
}

TEST(NeighbourGraph, BreaksTiesThatDifferByRoundingInFavourOfTheLowerRow) {
  Eigen::MatrixXd D = Eigen::MatrixXd::Ones(4, 4) - Eigen::MatrixXd::Identity(4, 4);
  D(3, 0) = D(0, 3) = 1.0 - 1e-15;  // nearer by a rounding error
  const Graph graph = neighbour_graph(D, {.neighbours = 1});
  ASSERT_EQ(graph[3].size(), 1U);
  EXPECT_EQ(graph[3][0].to, 0);
  EXPECT_EQ(graph[0].size(), 3U);  // every node's first choice, its own is 1
}

TEST(NeighbourGraph, LeavesOutPairsAtTheCutoffAndInfinitePairs) {
  Eigen::MatrixXd D = distances_of(test::grid(1, 4));
  EXPECT_EQ(neighbour_graph(D, {.neighbours = 3, .cutoff = 2.0})[0].size(), 1U);
  D(0, 1) = D(1, 0) = HUGE_VAL;
  EXPECT_EQ(neighbour_graph(D, {.neighbours = 3})[0].size(), 2U);
}

TEST(NeighbourGraph, RefusesMoreNeighboursThanThereAre) {
  const Eigen::MatrixXd D = distances_of(scattered(5, 1));
  EXPECT_THROW(neighbour_graph(D, {.neighbours = 5}), InvalidInput);
  EXPECT_THROW(neighbour_graph(D, {.neighbours = 0}), InvalidInput);
}

class ShortestPaths : public ::testing::TestWithParam<bool> {};

TEST_P(ShortestPaths, AgreeWithFloydAndWarshall) {
  Points points = scattered(30, 2);
  if (GetParam()) points.row(4) = points.row(7);  // an edge of no length
  const Eigen::MatrixXd D = distances_of(points);
  const Graph graph = neighbour_graph(D, {.neighbours = 4});
  Eigen::MatrixXd edges = Eigen::MatrixXd::Constant(30, 30, HUGE_VAL);
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (const Edge& edge : graph[i]) edges(static_cast<Eigen::Index>(i), edge.to) = edge.length;
  edges.diagonal().setZero();
  for (Eigen::Index k = 0; k < 30; ++k)
    for (Eigen::Index i = 0; i < 30; ++i)
      for (Eigen::Index j = 0; j < 30; ++j)
        edges(i, j) = std::min(edges(i, j), edges(i, k) + edges(k, j));
  EXPECT_LT((shortest_paths(graph) - edges).cwiseAbs().maxCoeff(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutDuplicates, ShortestPaths, ::testing::Bool());

TEST(CompletedDistances, FillOnlyWhatIsMissing) {
  Eigen::MatrixXd D = distances_of(test::grid(1, 5));
  D(0, 4) = D(4, 0) = HUGE_VAL;
  D(0, 3) = D(3, 0) = 7.0;  // longer than the way round, but measured
  const Eigen::MatrixXd filled = completed_distances(D);
  EXPECT_DOUBLE_EQ(filled(0, 4), 4.0);
  EXPECT_DOUBLE_EQ(filled(0, 3), 7.0);
}

TEST(LargestComponent, IsTheFirstOfTheLargest) {
  const auto edge = [](Eigen::Index to) { return Edge{.to = to, .length = 1.0}; };
  const Graph graph = {{}, {edge(3)}, {edge(4)}, {edge(1)}, {edge(2)}};
  EXPECT_EQ(largest_component(graph), (std::vector<Eigen::Index>{1, 3}));
  EXPECT_TRUE(largest_component({}).empty());
}

TEST(BridgeComponents, LaysTheShortestBridgesBetweenThreeIslands) {
  Points points(6, 2);
  points << 0, 0, 1, 0, 5, 0, 6, 0, 20, 0, 21, 0;
  const Eigen::MatrixXd D = distances_of(points);
  Graph graph = neighbour_graph(D, {.neighbours = 1});
  EXPECT_EQ(components(graph), (std::vector<int>{0, 0, 1, 1, 2, 2}));
  const auto bridging = bridge_components(graph, D);
  ASSERT_TRUE(bridging);
  EXPECT_EQ(bridging->pieces, 3);
  EXPECT_DOUBLE_EQ(bridging->longest, 14.0);
  EXPECT_EQ(components(graph), std::vector<int>(6, 0));
  EXPECT_DOUBLE_EQ(shortest_paths(graph)(0, 5), 21.0);
}

TEST(BridgeComponents, IsEmptyWhenNoBridgeIsFinite) {
  Eigen::MatrixXd D = Eigen::MatrixXd::Constant(4, 4, HUGE_VAL);
  D.diagonal().setZero();
  D(0, 1) = D(1, 0) = D(2, 3) = D(3, 2) = 1.0;
  Graph graph = neighbour_graph(D, {.neighbours = 2});
  EXPECT_FALSE(bridge_components(graph, D));
}

}  // namespace
}  // namespace mapproof
