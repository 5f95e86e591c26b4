#include "core/statistics/signed_rank.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/base/errors.hpp"
#include "core/statistics/friedman.hpp"

namespace mapproof {
namespace {

/// By all 2^n signs, one after the other.
double p_by_enumeration(const std::vector<double>& differences) {
  std::vector<double> nonzero;
  for (const double d : differences)
    if (d != 0.0) nonzero.push_back(d);
  const int n = static_cast<int>(nonzero.size());
  if (n == 0) return 1.0;
  const Eigen::RowVectorXd of_size =
      ranks(Eigen::Map<const Eigen::RowVectorXd>(nonzero.data(), n).cwiseAbs());
  double plus = 0.0;
  for (int i = 0; i < n; ++i)
    if (nonzero[static_cast<std::size_t>(i)] > 0.0) plus += of_size(i);
  const double middle = of_size.sum() / 2.0;
  int as_far = 0;
  for (int signs = 0; signs < 1 << n; ++signs) {
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
      if ((signs >> i & 1) != 0) sum += of_size(i);
    if (std::abs(sum - middle) >= std::abs(plus - middle) - 1e-9) ++as_far;
  }
  return std::ldexp(as_far, -n);
}

TEST(SignedRank, HasTheValuesOfSciPyWithoutTies) {
  const SignedRankTest test =
      signed_rank_test(std::vector{1.83, 0.5, -0.3, 2.2, 0.9, 1.1, -0.2, 3.1, 0.7, 1.4});
  EXPECT_EQ(test.rank_sum_minus, 3.0);
  EXPECT_DOUBLE_EQ(test.p, 0.009765625);  // scipy 1.10, method='exact'
  EXPECT_DOUBLE_EQ(signed_rank_test(std::vector{.1, .2, .3, .4, .5, -.6}).p, 0.4375);
}

TEST(SignedRank, HasTheValuesOfSciPyInTheNormalLimit) {
  std::vector<double> smooth, tied;
  for (int i = 1; i <= 250; ++i) {
    smooth.push_back(std::sin(i * 1.7) * i + 8.0);
    tied.push_back(std::round(std::sin(i * 1.7) * 5.0) + 1.0);
  }
  // scipy 1.10, method='approx', correction=True
  EXPECT_NEAR(signed_rank_test(smooth).p, 0.2048729715258616, 1e-12);
  const SignedRankTest test = signed_rank_test(tied);
  EXPECT_NEAR(test.p, 4.000190250564123e-06, 1e-16);
  EXPECT_EQ(test.nonzero, 234);
  EXPECT_FALSE(test.exact);
}

RC_GTEST_PROP(SignedRank, CountsAllSignsAlsoWhereRanksTie, ()) {
  const auto whole =
      *rc::gen::resize(11, rc::gen::container<std::vector<int>>(rc::gen::inRange(-4, 5)));
  const std::vector<double> differences(whole.begin(), whole.end());
  RC_ASSERT(std::abs(signed_rank_test(differences).p - p_by_enumeration(differences)) < 1e-12);
}

RC_GTEST_PROP(SignedRank, TurnsItsEffectWithTheSignsAndKeepsItsP, ()) {
  const auto whole = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-50, 51));
  std::vector<double> there(whole.begin(), whole.end()), back;
  for (const double d : there) back.push_back(-d);
  const SignedRankTest a = signed_rank_test(there), b = signed_rank_test(back);
  RC_ASSERT(a.p == b.p);
  RC_ASSERT(a.effect == -b.effect);
}

TEST(SignedRank, OfDifferencesToOneSideHasFullEffectAndTheLeastP) {
  const SignedRankTest test = signed_rank_test(std::vector{1.0, 2.0, 2.0, 0.0, 5.0, 3.0, 9.0});
  EXPECT_EQ(test.effect, 1.0);
  EXPECT_EQ(test.nonzero, 6);
  EXPECT_DOUBLE_EQ(test.p, least_signed_rank_p(6));
}

TEST(SignedRank, FindsNothingWithoutADifference) {
  const SignedRankTest test = signed_rank_test(std::vector<double>(5, 0.0));
  EXPECT_EQ(test.p, 1.0);
  EXPECT_EQ(test.effect, 0.0);
  EXPECT_EQ(signed_rank_test({}).p, 1.0);
}

TEST(SignedRank, RefusesWhatIsNotFinite) {
  EXPECT_THROW(signed_rank_test(std::vector{1.0, std::nan("")}), InvalidInput);
}

TEST(Holm, CorrectsByHandAsInItsPaper) {
  const std::vector<double> corrected = holm(std::vector{0.01, 0.04, 0.03, 0.005});
  EXPECT_DOUBLE_EQ(corrected[3], 0.02);
  EXPECT_DOUBLE_EQ(corrected[0], 0.03);
  EXPECT_DOUBLE_EQ(corrected[2], 0.06);
  EXPECT_DOUBLE_EQ(corrected[1], 0.06);  // Never below one that is smaller.
}

TEST(Holm, RefusesWhatIsNotAProbability) {
  EXPECT_THROW(holm(std::vector{0.5, 1.5}), InvalidInput);
  EXPECT_THROW(holm(std::vector{std::nan("")}), InvalidInput);
}

}  // namespace
}  // namespace mapproof
