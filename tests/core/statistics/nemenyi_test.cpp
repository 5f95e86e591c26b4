#include "core/statistics/nemenyi.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

using Groups = std::vector<std::vector<int>>;

TEST(StudentizedRange, HasThePublishedCriticalValues) {
  // q / sqrt(2) for k = 2 to 10 [demsar2006].
  const std::vector<double> at_5 = {1.960, 2.343, 2.569, 2.728, 2.850, 2.949, 3.031, 3.102, 3.164};
  const std::vector<double> at_10 = {1.645, 2.052, 2.291, 2.459, 2.589, 2.693, 2.780, 2.855, 2.920};
  for (int k = 2; k <= 10; ++k) {
    const std::size_t i = static_cast<std::size_t>(k - 2);
    EXPECT_NEAR(studentized_range_quantile(k, 0.05) / std::numbers::sqrt2, at_5[i], 1e-3) << k;
    EXPECT_NEAR(studentized_range_quantile(k, 0.10) / std::numbers::sqrt2, at_10[i], 1e-3) << k;
  }
}

TEST(StudentizedRange, IsANormalDifferenceForTwoGroups) {
  // alpha = P(|a - b| > q) = erfc(q / 2).
  for (const double alpha : {1e-12, 1e-6, 0.01, 0.5, 0.99, 0.999})
    EXPECT_NEAR(std::erfc(studentized_range_quantile(2, alpha) / 2.0) / alpha, 1.0, 1e-9) << alpha;
}

TEST(StudentizedRange, AgreesWithScipyForManyGroupsAndRareRanges) {
  // scipy 1.10.1: stats.studentized_range.ppf(1 - alpha, k, inf).
  EXPECT_NEAR(studentized_range_quantile(2, 1e-4), 5.502127811423764, 1e-8);
  EXPECT_NEAR(studentized_range_quantile(10, 1e-4), 6.682187153796697, 1e-8);
  EXPECT_NEAR(studentized_range_quantile(50, 1e-4), 7.570596039614705, 1e-8);
  EXPECT_NEAR(studentized_range_quantile(50, 0.5), 4.450481338021923, 1e-8);
}

TEST(StudentizedRange, GrowsWithTheNumberOfGroups) {
  double before = 0.0;
  for (const int k : {2, 3, 10, 100, 1000, 10'000}) {
    const double q = studentized_range_quantile(k, 0.05);
    EXPECT_GT(q, before) << k;
    before = q;
  }
}

TEST(StudentizedRange, RefusesWhatIsOutOfItsBounds) {
  EXPECT_THROW(studentized_range_quantile(1, 0.05), InvalidInput);
  EXPECT_THROW(studentized_range_quantile(10'001, 0.05), InvalidInput);
  EXPECT_THROW(studentized_range_quantile(3, 0.0), InvalidInput);
  EXPECT_THROW(studentized_range_quantile(3, 1.0), InvalidInput);
  EXPECT_THROW(studentized_range_quantile(3, std::nan("")), InvalidInput);
}

TEST(CriticalDifference, IsThatOfThePublishedExample) {
  // Four methods on 14 data sets [demsar2006]: 1.25 at 5 %, 1.12 at 10 %.
  EXPECT_NEAR(nemenyi_critical_difference(4, 14, 0.05), 1.25, 5e-3);
  EXPECT_NEAR(nemenyi_critical_difference(4, 14, 0.10), 1.12, 5e-3);
  EXPECT_THROW(nemenyi_critical_difference(4, 0, 0.05), InvalidInput);
}

TEST(AlikeGroups, AreMaximalAndInOrderOfRank) {
  const std::vector<double> ranks = {3.0, 1.0, 1.9, 5.0, 2.5};
  EXPECT_EQ(alike_groups(ranks, 1.2), (Groups{{1, 2}, {2, 4, 0}}));
  EXPECT_EQ(alike_groups(ranks, 10.0), (Groups{{1, 2, 4, 0, 3}}));
  EXPECT_EQ(alike_groups(ranks, 0.1), Groups{});
}

TEST(AlikeGroups, PutMethodsApartThatDifferByExactlyTheCriticalDifference) {
  EXPECT_EQ(alike_groups(std::vector{1.0, 2.0}, 1.0), Groups{});
}

TEST(AlikeGroups, HoldEqualRanksInOrderOfTheirIndex) {
  EXPECT_EQ(alike_groups(std::vector{2.0, 2.0, 2.0}, 0.5), (Groups{{0, 1, 2}}));
  EXPECT_EQ(alike_groups({}, 1.0), Groups{});
  EXPECT_THROW(alike_groups(std::vector{1.0, std::nan("")}, 1.0), InvalidInput);
}

}  // namespace
}  // namespace mapproof
