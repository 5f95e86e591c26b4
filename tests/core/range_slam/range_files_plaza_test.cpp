#include <gtest/gtest.h>

#include <filesystem>

#include "core/records/ranges/range_logs.hpp"
#include "tests/core/range_slam/sample_log.hpp"
#include "tests/support/plaza.hpp"

namespace mapproof {
namespace {

using test::expect_same;
using test::remarks_hold;

/// Facts of the published sets, where the variable names their folder.
class PlazaFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto folder = test::plaza_folder();
    if (!folder) GTEST_SKIP() << test::kNoPlaza;
    folder_ = *folder;
  }
  std::filesystem::path folder_;
};

TEST_F(PlazaFiles, TheMatlabFileIsTheTables) {
  for (const std::string number : {"1", "2"}) {
    const RangeLog mat = read_range_log(folder_ / ("raw_gtsam/Plaza" + number + "_.mat"));
    const RangeLog csv = read_range_log(folder_ / ("plaza" + number));
    EXPECT_EQ(mat.name, "Plaza" + number);
    EXPECT_EQ(mat.landmarks, (std::vector<std::string>{"0", "1", "5", "6"}));
    expect_same(mat, csv, 1e-9);
    EXPECT_EQ(mat.ground_truth->positions_m, csv.ground_truth->positions_m);
    EXPECT_EQ(*mat.true_landmarks, *csv.true_landmarks);
    EXPECT_NEAR(mat.start.heading_rad, csv.start.heading_rad, 1e-12);
    const RangeLog text = read_range_log(folder_ / ("raw_gtsam/Plaza" + number + "_DR.txt"));
    EXPECT_EQ(text.ranges.size(), mat.ranges.size());
  }
}

TEST_F(PlazaFiles, TheTrapsOfTheSetsAreRemarked) {
  const RangeLog first = read_range_log(folder_ / "raw_gtsam/Plaza1_.mat");
  EXPECT_EQ(first.odometry.size(), 9657U);
  EXPECT_EQ(first.ranges.size(), 3527U);
  EXPECT_TRUE(remarks_hold(first, "repeat landmark and stamp of another one: 2 ranges"));
  RangeLogOptions as_published;
  as_published.keeps_repeats = true;
  EXPECT_EQ(read_range_log(folder_ / "raw_gtsam/Plaza1_.mat", as_published).ranges.size(), 3529U);
  EXPECT_TRUE(remarks_hold(first, "increments of DR are those of the true heading"));
  EXPECT_TRUE(remarks_hold(first, "jump back 2 times, by up to 64.4 s"));
  EXPECT_FALSE(remarks_hold(first, "is optimistic"));
  EXPECT_FALSE(remarks_hold(first, "180 degrees"));
  const RangeLog second = read_range_log(folder_ / "raw_gtsam/Plaza2_.mat");
  EXPECT_EQ(second.odometry.size(), 4090U);
  EXPECT_TRUE(remarks_hold(second, "off by 180 degrees"));
  EXPECT_FALSE(remarks_hold(second, "jump back"));
}

}  // namespace
}  // namespace mapproof
