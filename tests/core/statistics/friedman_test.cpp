#include "core/statistics/friedman.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

TEST(Ranks, AreSharedByValuesThatTie) {
  EXPECT_EQ(ranks(Eigen::RowVector4d(3, 1, 1, 0)), Eigen::RowVector4d(4, 2.5, 2.5, 1));
  EXPECT_EQ(ranks(Eigen::RowVector3d(5, 5, 5)), Eigen::RowVector3d(2, 2, 2));
  EXPECT_THROW(ranks(Eigen::RowVector2d(1, std::nan(""))), InvalidInput);
}

// R's friedman.test and scmamp's imanDavenportTest on these two rows of ranks, as printed in a
// question on comparing classifiers (Stack Exchange, March 2018).
TEST(Friedman, AgreesWithRForNineMethodsOnTwoUnits) {
  Eigen::MatrixXd values(2, 9);
  values << 1, 8, 6, 4, 7, 2, 5, 3, 9,  //
      1, 6, 3, 9, 7, 2, 8, 4, 5;
  const FriedmanTest test = friedman(values);
  EXPECT_NEAR(test.chi_square, 11.733, 5e-4);
  EXPECT_NEAR(test.chi_square_p, 0.1635, 5e-5);
  EXPECT_NEAR(test.f, 2.75, 5e-3);
  EXPECT_NEAR(test.f_p, 0.08697, 5e-6);
}

// scipy 1.10.1: stats.friedmanchisquare, stats.rankdata, stats.f.sf. Two rows hold ties.
TEST(Friedman, AgreesWithScipyWhereValuesTie) {
  Eigen::MatrixXd values(5, 4);
  values << 0.21, 0.25, 0.19, 0.40,  //
      0.30, 0.30, 0.22, 0.35,        //
      0.18, 0.24, 0.24, 0.31,        //
      0.50, 0.20, 0.10, 0.60,        //
      0.27, 0.26, 0.26, 0.26;
  const FriedmanTest test = friedman(values);
  EXPECT_EQ(test.mean_ranks, (std::vector{2.5, 2.4, 1.5, 3.6}));
  EXPECT_NEAR(test.chi_square, 7.568181818181814, 1e-12);
  EXPECT_NEAR(test.chi_square_p, 0.055832208317611334, 1e-12);
  EXPECT_NEAR(test.f, 4.073394495412839, 1e-12);
  EXPECT_NEAR(test.f_p, 0.03285881419734531, 1e-12);
}

TEST(Friedman, DependsOnTheOrderOfValuesAlone) {
  Eigen::MatrixXd values(4, 3);
  values << 1, 2, 3, 2, 1, 3, 1, 3, 2, 1, 2, 3;
  const FriedmanTest a = friedman(values);
  const FriedmanTest b = friedman(values.array().exp().matrix() * 1e6);
  EXPECT_EQ(a.mean_ranks, b.mean_ranks);
  EXPECT_EQ(a.f_p, b.f_p);
}

TEST(Friedman, IsCertainWhereAllUnitsAgree) {
  const FriedmanTest test = friedman(Eigen::RowVector3d(1, 2, 3).replicate(6, 1));
  EXPECT_NEAR(test.chi_square, 12.0, 1e-12);  // n (k - 1)
  EXPECT_EQ(test.f, std::numeric_limits<double>::infinity());
  EXPECT_EQ(test.f_p, 0.0);
}

TEST(Friedman, FindsNothingWhereAllValuesTie) {
  const FriedmanTest test = friedman(Eigen::MatrixXd::Constant(4, 3, 7.0));
  EXPECT_EQ(test.chi_square, 0.0);
  EXPECT_EQ(test.chi_square_p, 1.0);
  EXPECT_EQ(test.f, 0.0);
  EXPECT_EQ(test.f_p, 1.0);
}

TEST(Friedman, RefusesWhatCannotBeCompared) {
  EXPECT_THROW(friedman(Eigen::MatrixXd::Ones(1, 3)), InvalidInput);
  EXPECT_THROW(friedman(Eigen::MatrixXd::Ones(3, 1)), InvalidInput);
  EXPECT_THROW(friedman(Eigen::MatrixXd(0, 0)), InvalidInput);
  EXPECT_THROW(friedman(Eigen::MatrixXd::Constant(3, 3, std::nan(""))), InvalidInput);
}

}  // namespace
}  // namespace mapproof
