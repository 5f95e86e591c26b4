#include "core/follow/followed_log.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

std::vector<Sighting> seen(int landmark, double range_m) {
  return {{.step = 9, .landmark = landmark, .range_m = range_m, .bearing_rad = 0.0}};
}

TEST(FollowedLog, PoolsLooksRobotByRobot) {
  FollowedLog looks;
  looks.add({0, 1.0}, seen(0, 1.0));
  looks.add({1, 0.5}, seen(1, 2.0));
  looks.add({0, 2.0}, seen(1, 3.0));
  looks.add({1, 4.0}, {});
  const SightingLog log = looks.log({"a", "b"}, true);
  EXPECT_EQ(log.steps, 4);
  EXPECT_EQ(log.times_s, (std::vector<double>{1.0, 2.0, 0.5, 4.0}));
  ASSERT_EQ(log.sightings.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(log.sightings[k].step, static_cast<int>(k));
  EXPECT_EQ(log.sightings[1].range_m, 3.0);
  EXPECT_EQ(log.sightings[2].range_m, 2.0);
  EXPECT_EQ(looks.looks()[2], (LookKey{1, 0.5}));
  EXPECT_TRUE(looks.log({"a", "b"}, false).times_s.empty());
}

TEST(FollowedLog, RefusesLooksThatDoNotAscend) {
  FollowedLog looks;
  EXPECT_THROW(looks.add({1, 0.0}, {}), InvalidInput);
  looks.add({0, 1.0}, {});
  EXPECT_THROW(looks.add({0, 1.0}, {}), InvalidInput);
  EXPECT_THROW(looks.add({-1, 1.0}, {}), InvalidInput);
  EXPECT_EQ(looks.steps(), 1);
}

}  // namespace
}  // namespace mapproof
