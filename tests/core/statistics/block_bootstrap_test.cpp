#include "core/statistics/block_bootstrap.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

TEST(BlockResample, IsOfWholeBlocksOnACircle) {
  Random random(1);
  const std::vector<Eigen::Index> drawn = block_resample(100, 10, BlockEnds::kCircular, random);
  ASSERT_EQ(drawn.size(), 100U);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    EXPECT_GE(drawn[i], 0);
    EXPECT_LT(drawn[i], 100);
    if (i % 10 != 0) {
      EXPECT_EQ(drawn[i], (drawn[i - 1] + 1) % 100);
    }
  }
}

TEST(BlockResample, TakesEveryStepEquallyOften) {
  Random random(2);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(20);
  for (int i = 0; i < 5000; ++i)
    for (const Eigen::Index step : block_resample(20, 7, BlockEnds::kCircular, random))
      counts(step) += 1.0;
  // Each is binomial about 5000 with a standard deviation below 7 times its root.
  EXPECT_LT((counts.array() - 5000.0).abs().maxCoeff(), 700.0);
}

TEST(BlockResample, StaysInsideTheSeriesOnRequest) {
  Random random(3);
  for (int k = 0; k < 50; ++k) {
    const std::vector<Eigen::Index> drawn = block_resample(20, 7, BlockEnds::kInside, random);
    ASSERT_EQ(drawn.size(), 20U);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (i % 7 != 0) {
        EXPECT_EQ(drawn[i], drawn[i - 1] + 1);
      }
    }
  }
}

TEST(BlockResample, NeedsBlocksNoLongerThanTheSteps) {
  Random random(1);
  EXPECT_THROW(block_resample(5, 6, BlockEnds::kCircular, random), InvalidInput);
  EXPECT_THROW(block_resample(5, 0, BlockEnds::kCircular, random), InvalidInput);
}

}  // namespace
}  // namespace mapproof
