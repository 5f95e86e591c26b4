#include "core/association/log_blocks.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "noisy_scans.hpp"

namespace mapproof::test {
namespace {

TEST(ScanPairs, TakeTheirDistanceFromTheLawOfCosines) {
  const double right_angle = 1.5707963267948966;
  const DetectionLog log{
      {"A", "B", "C"},
      {{0, 0, 3.0, 0.2}, {0, 1, 4.0, 0.2 + right_angle}, {0, 2}, {1, 2, 1.0, 0.0}},
      2,
      {}};
  const std::vector<ScanPair> pairs = scan_pairs(log);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR(pairs.front().distance_m, 5.0, 1e-12);
}

TEST(ScanPairs, ThinOutScansBeyondTheirLimit) {
  const DetectionLog log = noisy_scans(100, 1);
  EXPECT_EQ(scan_pairs(log).size(), 600U);
  EXPECT_EQ(scan_pairs(log, 300).size(), 300U);
}

TEST(LogBlocks, AreCutWhereAnotherRobotBeginsAndAtCommonTimes) {
  DetectionLog log = noisy_scans(120, 1);
  for (int step = 0; step < log.steps; ++step) log.times_s.push_back(step % 60);
  const LogBlocks blocks = cut_in_blocks(log, scan_pairs(log), 3);
  EXPECT_EQ(blocks.count, 6);
  EXPECT_EQ(blocks.slice, (std::vector<int>{0, 1, 2, 0, 1, 2}));
  ASSERT_EQ(blocks.block_orders.size(), 2U);
  EXPECT_EQ(blocks.block_orders[1], (std::vector<int>{0, 3, 1, 4, 2, 5}));
  EXPECT_EQ(blocks.step_orders[1][1], 60);
}

TEST(LogBlocks, CutStepsWhereThereAreNoTimes) {
  const DetectionLog log = noisy_scans(100, 1);
  const LogBlocks blocks = cut_in_blocks(log, scan_pairs(log), 10);
  EXPECT_EQ(blocks.count, 10);
  EXPECT_EQ(blocks.block_orders.size(), 1U);
}

TEST(LogBlocks, RefuseTimesThatAreNotOneAStep) {
  DetectionLog log = noisy_scans(10, 1);
  log.times_s = {1.0};
  EXPECT_THROW(cut_in_blocks(log, {}, 2), InvalidInput);
  EXPECT_THROW(cut_in_blocks(noisy_scans(10, 1), {}, 0), InvalidInput);
}

}  // namespace
}  // namespace mapproof::test
