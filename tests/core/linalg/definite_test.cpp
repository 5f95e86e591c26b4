#include "core/linalg/cholesky.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "core/base/random.hpp"
#include "core/linalg/gram.hpp"

namespace mapproof::unfolding {
namespace {

constexpr Eigen::Index kSizes[] = {1, 2, 5, 9, 49, 130};

Eigen::MatrixXd random_matrix(Eigen::Index n, std::uint64_t seed) {
  Random random(seed);
  return Eigen::MatrixXd::NullaryExpr(
      n, n, [&](Eigen::Index, Eigen::Index) { return random.uniform() - 0.5; });
}

Eigen::MatrixXd positive(Eigen::Index n) {
  Eigen::MatrixXd A = gram(random_matrix(n, 3));
  A.diagonal().array() += 0.1;
  return A;
}

Eigen::MatrixXd symmetric(Eigen::Index n) {
  const Eigen::MatrixXd A = random_matrix(n, 4);
  return A + A.transpose();
}

TEST(Definite, HoldsTheInverse) {
  for (const Eigen::Index n : kSizes) {
    Definite A;
    ASSERT_TRUE(A.set(positive(n)));
    EXPECT_LT((A.inverse() * positive(n) - Eigen::MatrixXd::Identity(n, n)).norm(), 1e-9) << n;
  }
}

TEST(Definite, RefusesAnIndefiniteMatrixAndKeepsWhatItHad) {
  Definite A;
  EXPECT_FALSE(A.set(-positive(9)));
  EXPECT_FALSE(A.is_set());
  ASSERT_TRUE(A.set(positive(9)));
  EXPECT_FALSE(A.set(symmetric(9)));
  EXPECT_EQ(A.matrix(), positive(9));
}

TEST(SmallestEigenvalue, IsThatOfEigenToHalfAPercentAndNotAbove) {
  for (const Eigen::Index n : kSizes)
    for (const double scale : {1e-3, 0.3, 1.0, 100.0}) {
      Definite A;
      ASSERT_TRUE(A.set(positive(n)));
      const Eigen::MatrixXd D = scale * symmetric(n);
      const double expected = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(
                                  D, positive(n), Eigen::EigenvaluesOnly)
                                  .eigenvalues()(0);
      const double found = smallest_eigenvalue(A, D);
      EXPECT_NEAR(found, expected, 0.01 * std::max(1.0, std::abs(expected))) << n << " " << scale;
      EXPECT_LE(found, expected + 1e-9 * std::abs(expected)) << n << " " << scale;
    }
}

TEST(SmallestEigenvalue, OfAStepThatIsNotFiniteIsMinusInfinity) {
  Definite A;
  ASSERT_TRUE(A.set(positive(9)));
  Eigen::MatrixXd D = symmetric(9);
  D(4, 4) = std::nan("");
  EXPECT_EQ(smallest_eigenvalue(A, D), -std::numeric_limits<double>::infinity());
}

TEST(SmallestEigenvalue, OfNoStepIsZero) {
  Definite A;
  ASSERT_TRUE(A.set(positive(9)));
  EXPECT_NEAR(smallest_eigenvalue(A, Eigen::MatrixXd::Zero(9, 9)), 0.0, 0.01);
}

}  // namespace
}  // namespace mapproof::unfolding
