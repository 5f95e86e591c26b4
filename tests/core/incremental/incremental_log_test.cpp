#include "core/incremental/incremental_map.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

std::vector<Detection> seen(int landmark, double range_m) {
  return {{.step = 9, .landmark = landmark, .range_m = range_m, .bearing_rad = 0.0}};
}

TEST(IncrementalLog, PoolsScansRobotByRobot) {
  IncrementalLog scans;
  scans.add({0, 1.0}, seen(0, 1.0));
  scans.add({1, 0.5}, seen(1, 2.0));
  scans.add({0, 2.0}, seen(1, 3.0));
  scans.add({1, 4.0}, {});
  const DetectionLog log = scans.log({"a", "b"}, true);
  EXPECT_EQ(log.steps, 4);
  EXPECT_EQ(log.times_s, (std::vector<double>{1.0, 2.0, 0.5, 4.0}));
  ASSERT_EQ(log.detections.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(log.detections[k].step, static_cast<int>(k));
  EXPECT_EQ(log.detections[1].range_m, 3.0);
  EXPECT_EQ(log.detections[2].range_m, 2.0);
  EXPECT_EQ(scans.scans()[2], (ScanKey{1, 0.5}));
  EXPECT_TRUE(scans.log({"a", "b"}, false).times_s.empty());
}

TEST(IncrementalLog, RefusesScansThatDoNotAscend) {
  IncrementalLog scans;
  EXPECT_THROW(scans.add({1, 0.0}, {}), InvalidInput);
  scans.add({0, 1.0}, {});
  EXPECT_THROW(scans.add({0, 1.0}, {}), InvalidInput);
  EXPECT_THROW(scans.add({-1, 1.0}, {}), InvalidInput);
  EXPECT_EQ(scans.steps(), 1);
}

}  // namespace
}  // namespace mapproof
