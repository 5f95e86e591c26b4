#include "core/submaps/submap_embedding.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

TEST(Groups, AreNoLargerThanAskedForOwnEachLandmarkOnceAndOverlap) {
  const Eigen::MatrixXd distances = test::distances_of(test::scattered(130, 1));
  for (const int size : {10, 25, 60}) {
    const auto groups = overlapping_groups(distances, {.size = size});
    std::vector<int> owners(130, 0);
    for (const LandmarkGroup& group : groups) {
      EXPECT_LE(std::ssize(group.members), size);
      EXPECT_GE(std::ssize(group.members), std::ssize(group.own) + 3);
      EXPECT_TRUE(std::ranges::includes(group.members, group.own));
      for (const Eigen::Index i : group.own) ++owners[static_cast<std::size_t>(i)];
    }
    EXPECT_TRUE(std::ranges::all_of(owners, [](int count) { return count == 1; }));
  }
}

TEST(Groups, AreOfNeighbours) {
  const Points points = test::scattered(200, 2);
  const auto groups = overlapping_groups(test::distances_of(points), {.size = 20});
  for (const LandmarkGroup& group : groups) {
    const Points members = points(group.members, Eigen::all);
    const Points centred = members.rowwise() - members.colwise().mean();
    // A tenth of the unit square: some .13 from its middle, where 200 at random are .4.
    EXPECT_LT(std::sqrt(centred.squaredNorm() / 20.0), 0.25);
  }
}

TEST(Groups, OfFewLandmarksAreOneAndOfPiecesStayApart) {
  const Eigen::MatrixXd few = test::distances_of(test::scattered(8, 3));
  ASSERT_EQ(overlapping_groups(few, {.size = 8}).size(), 1U);
  EXPECT_EQ(overlapping_groups(few, {.size = 8}).front().members.size(), 8U);

  Eigen::MatrixXd pieces = test::distances_of(test::scattered(40, 4));
  pieces.topRightCorner(20, 20).setConstant(HUGE_VAL);
  pieces.bottomLeftCorner(20, 20).setConstant(HUGE_VAL);
  for (const LandmarkGroup& group : overlapping_groups(pieces, {.size = 10}))
    EXPECT_TRUE(group.members.back() < 20 || group.members.front() >= 20);
}

TEST(Groups, RefuseSizesThatCannotOverlap) {
  const Eigen::MatrixXd distances = test::distances_of(test::scattered(30, 5));
  EXPECT_THROW(overlapping_groups(distances, {.size = 5}), InvalidInput);
  EXPECT_THROW(overlapping_groups(distances, {.overlap_share = 0.9}), InvalidInput);
  EXPECT_THROW(overlapping_groups(distances, {.overlap_share = std::nan("")}), InvalidInput);
  EXPECT_THROW(overlapping_groups(distances, {.neighbours = 0}), InvalidInput);
}

}  // namespace
}  // namespace mapproof
