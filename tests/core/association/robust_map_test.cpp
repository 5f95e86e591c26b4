#include "core/association/robust_map.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace mapproof {
namespace {

/// Two squares of 2 m, 10 m apart.
Points two_squares() {
  Points positions(8, 2);
  positions << 0, 0, 2, 0, 2, 2, 0, 2, 10, 0, 12, 0, 12, 2, 10, 2;
  return positions;
}

/// Exact distances: `often` in a square, `seldom` between the squares.
std::vector<PairItem> items_of(const Points& positions, double often, double seldom) {
  std::vector<PairItem> items;
  for (int i = 0; i < positions.rows(); ++i)
    for (int j = i + 1; j < positions.rows(); ++j)
      items.push_back({.first = i,
                       .second = j,
                       .block = 0,
                       .distance_m = (positions.row(i) - positions.row(j)).norm(),
                       .weight = (i < 4) == (j < 4) ? often : seldom});
  return items;
}

TEST(RobustMap, KeepsSeldomSeenPairsThatAloneJoinTwoGroups) {
  const Points positions = two_squares();
  const RobustMap map = robust_map(items_of(positions, 10.0, 1.0), 8);
  ASSERT_TRUE(map.positions_m.allFinite());
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < i; ++j)
      EXPECT_NEAR((map.positions_m.row(i) - map.positions_m.row(j)).norm(),
                  (positions.row(i) - positions.row(j)).norm(), 1e-3);
}

TEST(RobustMap, LeavesAGroupThatNothingJoinsUnmapped) {
  std::vector<PairItem> items = items_of(two_squares(), 10.0, 1.0);
  std::erase_if(items, [](const PairItem& item) { return (item.first < 4) != (item.second < 4); });
  const RobustMap map = robust_map(items, 8);
  EXPECT_TRUE(map.positions_m.topRows(4).allFinite());
  EXPECT_TRUE(map.positions_m.bottomRows(4).array().isNaN().all());
}

TEST(RobustMap, StartsWithoutALandmarkThatAloneJoinsTwoGroups) {
  // Only the landmark 0 holds the second square, and the start does not have it.
  std::vector<PairItem> items = items_of(two_squares(), 10.0, 1.0);
  std::erase_if(items, [](const PairItem& item) {
    return (item.first < 4) != (item.second < 4) && item.first != 0;
  });
  Points start = two_squares();
  start.row(0).setConstant(std::nan(""));
  const RobustMap map = minimized_map(items, start, 0.1);
  EXPECT_TRUE(map.positions_m.row(0).array().isNaN().all());
  EXPECT_TRUE(map.positions_m.bottomRows(4).allFinite());
}

}  // namespace
}  // namespace mapproof
