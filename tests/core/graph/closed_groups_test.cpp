#include "core/graph/components.hpp"

#include <gtest/gtest.h>

#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

Graph lists(const std::vector<std::vector<Eigen::Index>>& targets) {
  Graph graph;
  for (const auto& row : targets) {
    graph.emplace_back();
    for (const Eigen::Index to : row) graph.back().push_back({to, 1.0});
  }
  return graph;
}

// 0 and 1 are neighbours of each other, so are 3 and 4; 2 has both pairs as neighbours.
const std::vector<std::vector<Eigen::Index>> kTwoPairs = {{1}, {0}, {1, 3}, {4}, {3}};

TEST(ClosedGroups, AreThoseThatNoListLeaves) {
  const auto groups = closed_groups(lists(kTwoPairs));
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0], (std::vector<Eigen::Index>{0, 1}));
  EXPECT_EQ(groups[1], (std::vector<Eigen::Index>{3, 4}));
}

TEST(OpenClosedGroups, AddsTheShortestWayOut) {
  Points points(5, 2);
  points << 0, 0, 1, 0, 3, 0, 5, 0, 6, 0;
  Graph graph = lists(kTwoPairs);
  EXPECT_EQ(open_closed_groups(graph, test::distances_of(points)), 1);
  EXPECT_EQ(closed_groups(graph).size(), 1U);
  EXPECT_EQ(graph[3].back().to, 2);
}

TEST(JoinSets, LetsALandmarkThatIsNotANeighbourOfAnotherJoinItsOwn) {
  Graph graph = lists({{1, 2}, {0, 2}, {0, 1}, {0, 1}});
  EXPECT_EQ(join_sets(graph), 1);
  EXPECT_EQ(graph[3].back().to, 3);
  EXPECT_EQ(join_sets(graph), 0);
}

}  // namespace
}  // namespace mapproof
