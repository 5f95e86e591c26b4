#include "core/statistics/intervals.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"

namespace mapproof {
namespace {

TEST(StudentT, HasTheTabulatedQuantiles) {
  // Two-sided 95 % points as printed in any table of the distribution.
  const std::vector<std::pair<double, double>> table = {
      {1, 12.7062047364}, {2, 4.30265272991},  {3, 3.18244630528},  {4, 2.77644510520},
      {9, 2.26215716274}, {30, 2.04227245630}, {100, 1.98397151845}};
  for (const auto& [freedom, t] : table)
    EXPECT_NEAR(student_t_quantile(0.975, freedom), t, 1e-10 * t) << freedom;
  EXPECT_NEAR(student_t_quantile(0.995, 4), 4.60409487135, 1e-10);
}

TEST(StudentT, IsTheCauchyDistributionWithOneDegreeOfFreedom) {
  for (const double p : {0.001, 0.1, 0.4, 0.5, 0.75, 0.99, 0.9999})
    EXPECT_NEAR(student_t_quantile(p, 1), std::tan(std::numbers::pi * (p - 0.5)),
                1e-10 * (1 + std::abs(std::tan(std::numbers::pi * (p - 0.5)))));
}

TEST(StudentT, HasAClosedFormWithTwoDegreesOfFreedom) {
  for (const double p : {0.01, 0.3, 0.6, 0.9, 0.999}) {
    const double a = 2.0 * p - 1.0;
    EXPECT_NEAR(student_t_quantile(p, 2), a * std::sqrt(2.0 / (1.0 - a * a)), 1e-9);
  }
}

TEST(StudentT, TendsToTheNormalDistribution) {
  EXPECT_NEAR(student_t_quantile(0.975, 1e6), 1.959963984540054, 1e-5);
}

TEST(StudentT, RefusesWhatIsNotAProbability) {
  EXPECT_THROW(student_t_quantile(0.0, 3), InvalidInput);
  EXPECT_THROW(student_t_quantile(1.0, 3), InvalidInput);
  EXPECT_THROW(student_t_quantile(std::nan(""), 3), InvalidInput);
  EXPECT_THROW(student_t_quantile(0.5, 0), InvalidInput);
}

TEST(ClusteredMean, IsTheTIntervalOfTheClusterMeansWhereClustersAreEqual) {
  const std::vector<double> values = {1, 3, 2, 6, 5, 7};  // cluster means 2, 4, 6
  const std::vector<int> clusters = {1, 1, 2, 2, 3, 3};
  const MeanEstimate estimate = clustered_mean(values, clusters);
  EXPECT_NEAR(estimate.mean, 4.0, 1e-12);
  EXPECT_EQ(estimate.values, 6);
  EXPECT_EQ(estimate.clusters, 3);
  const double standard_error = 2.0 / std::sqrt(3.0);
  EXPECT_NEAR(*estimate.half_width, 4.30265272991 * standard_error, 1e-9);
}

TEST(ClusteredMean, StaysTheMeanOfAllValuesWhereClustersDiffer) {
  const std::vector<double> values = {1, 1, 1, 5};
  const std::vector<int> clusters = {1, 1, 1, 2};
  EXPECT_NEAR(clustered_mean(values, clusters).mean, 2.0, 1e-12);
}

TEST(ClusteredMean, HasNoIntervalWithOneCluster) {
  const std::vector<double> values = {1, 2};
  const std::vector<int> clusters = {7, 7};
  EXPECT_FALSE(clustered_mean(values, clusters).half_width);
}

TEST(ClusteredMean, IsWiderForRunsOfOneLayoutThanForIndependentOnes) {
  const std::vector<double> values = {1, 1, 1, 3, 3, 3, 5, 5, 5};
  const std::vector<int> layouts = {1, 1, 1, 2, 2, 2, 3, 3, 3};
  const std::vector<int> own = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  EXPECT_GT(*clustered_mean(values, layouts).half_width,
            2.0 * *clustered_mean(values, own).half_width);
}

TEST(ClusteredMean, RefusesWhatHasNoMean) {
  const std::vector<int> one = {1};
  EXPECT_THROW(clustered_mean({}, {}), InvalidInput);
  EXPECT_THROW(clustered_mean(std::vector{1.0, 2.0}, one), InvalidInput);
  EXPECT_THROW(clustered_mean(std::vector{std::nan("")}, one), InvalidInput);
  EXPECT_THROW(clustered_mean(std::vector{1.0}, one, 1.0), InvalidInput);
}

TEST(Median, IsTheMiddleValueOrTheMeanOfTheMiddleTwo) {
  EXPECT_EQ(median(std::vector{3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median(std::vector{4.0, 1.0, 2.0, 3.0}), 2.5);
  const double huge = std::numeric_limits<double>::max();
  EXPECT_EQ(median(std::vector{huge, huge}), huge);
  EXPECT_THROW(median({}), InvalidInput);
}

}  // namespace
}  // namespace mapproof
