#include "core/linalg/cholesky.hpp"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "core/base/random.hpp"
#include "core/linalg/gram.hpp"

namespace mapproof {
namespace {

// Leaves, one over, several levels of the recursion, more columns than a block of the product has.
constexpr Eigen::Index kCholeskySizes[] = {1,  2,  7,  23,  24,  25,  47,  48,
                                           49, 96, 97, 150, 333, 650, 1010};

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  Random random(seed);
  return Eigen::MatrixXd::NullaryExpr(
      rows, columns, [&](Eigen::Index, Eigen::Index) { return random.uniform() - 0.5; });
}

Eigen::MatrixXd positive(Eigen::Index n) {
  Eigen::MatrixXd A = gram(random_matrix(n, n + 3, 8));
  A.diagonal().array() += 0.1;
  return A;
}

TEST(Cholesky, FactorsAsEigenDoesAndLeavesTheOtherHalfAlone) {
  for (const Eigen::Index n : kCholeskySizes) {
    const Eigen::MatrixXd A = positive(n);
    Eigen::MatrixXd L = A;
    ASSERT_TRUE(factor_cholesky(L)) << n;
    const Eigen::MatrixXd expected = A.llt().matrixL();
    const Eigen::MatrixXd lower = L.triangularView<Eigen::Lower>();
    EXPECT_LT((lower - expected).norm(), 1e-12 * expected.norm()) << n;
    const Eigen::MatrixXd upper = L.triangularView<Eigen::StrictlyUpper>();
    const Eigen::MatrixXd untouched = A.triangularView<Eigen::StrictlyUpper>();
    EXPECT_EQ(upper, untouched) << n;
  }
}

TEST(Cholesky, FactorsABlockOfAMatrixAndNothingElse) {
  Eigen::MatrixXd whole = random_matrix(140, 140, 3);
  const Eigen::MatrixXd before = whole;
  const Eigen::MatrixXd A = positive(110);
  whole.block(20, 10, 110, 110) = A;
  ASSERT_TRUE(factor_cholesky(whole.block(20, 10, 110, 110)));
  const Eigen::MatrixXd L = whole.block(20, 10, 110, 110).triangularView<Eigen::Lower>();
  EXPECT_LT((L * L.transpose() - A).norm(), 1e-13 * A.norm());
  whole.block(20, 10, 110, 110) = before.block(20, 10, 110, 110);
  EXPECT_EQ(whole, before);
}

TEST(Cholesky, SolvesAsEigenDoes) {
  for (const Eigen::Index n : kCholeskySizes) {
    const Eigen::MatrixXd A = positive(n);
    const Eigen::VectorXd b = random_matrix(n, 1, 4);
    Eigen::MatrixXd L = A;
    ASSERT_TRUE(factor_cholesky(L));
    const Eigen::VectorXd x = solve_cholesky(L, b);
    EXPECT_LT((A * x - b).norm(), 1e-11 * b.norm()) << n;
    EXPECT_LT((x - A.llt().solve(b)).norm(), 1e-10 * x.norm()) << n;
  }
}

TEST(Cholesky, InvertsAFactorAndLeavesZerosAboveTheDiagonal) {
  for (const Eigen::Index n : kCholeskySizes) {
    Eigen::MatrixXd L = positive(n);
    ASSERT_TRUE(factor_cholesky(L));
    const Eigen::MatrixXd inverse = inverse_of_lower(L);
    const Eigen::MatrixXd lower = L.triangularView<Eigen::Lower>();
    EXPECT_LT((lower * inverse - Eigen::MatrixXd::Identity(n, n)).norm(), 1e-10) << n;
    const Eigen::MatrixXd above = inverse.triangularView<Eigen::StrictlyUpper>();
    EXPECT_TRUE(above.isZero(0.0)) << n;
  }
}

TEST(Cholesky, MultipliesAVectorAsEigenDoes) {
  for (const Eigen::Index rows : kCholeskySizes) {
    const Eigen::MatrixXd A = random_matrix(rows, rows + 2, 5);
    const Eigen::VectorXd x = random_matrix(rows + 2, 1, 6);
    Eigen::VectorXd y(rows);
    multiply(A, x, y);
    EXPECT_LT((y - A * x).norm(), 1e-13 * A.norm() * x.norm()) << rows;
  }
}

TEST(Cholesky, RefusesAMatrixThatIsNotPositiveWhereverItFails) {
  for (const Eigen::Index n : kCholeskySizes)
    for (const Eigen::Index place : {Eigen::Index{0}, n / 2, n - 1}) {
      Eigen::MatrixXd A = positive(n);
      A(place, place) = -1.0;
      EXPECT_FALSE(factor_cholesky(A)) << n << " " << place;
      for (const double bad :
           {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        A = positive(n);
        A(place, place) = bad;
        EXPECT_FALSE(factor_cholesky(A)) << n << " " << place << " " << bad;
      }
    }
}

}  // namespace
}  // namespace mapproof
