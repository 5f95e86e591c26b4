#include "core/linalg/symmetric_eigen.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/QR>

#include "core/base/random.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kSize = 150;
constexpr LeadingPairs kFourOfEight{.exact = 4, .count = 8};

Eigen::MatrixXd random_axes(std::uint64_t seed) {
  Random random(seed);
  const Eigen::MatrixXd noise = Eigen::MatrixXd::NullaryExpr(
      kSize, kSize, [&](Eigen::Index, Eigen::Index) { return random.uniform() - 0.5; });
  return Eigen::HouseholderQR<Eigen::MatrixXd>(noise).householderQ();
}

/// Four eigenvalues from 100 to 1, and the others in a bulk up to `bulk`.
Eigen::VectorXd four_above(double bulk) {
  Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(kSize, bulk, 0.0);
  values.head(4) << 100.0, 20.0, 5.0, 1.0;
  return values;
}

Eigen::MatrixXd matrix_of(const Eigen::MatrixXd& axes, const Eigen::VectorXd& values) {
  return axes * values.asDiagonal() * axes.transpose();
}

TEST(LeadingEigenpairs, FromTheLastOnesAreExactWhereRequested) {
  const Eigen::MatrixXd Q = random_axes(1);
  for (const double bulk : {0.0, 1e-6, 1e-2, 0.3}) {
    const Eigen::MatrixXd A = matrix_of(Q, four_above(bulk));
    Eigen::MatrixXd start = Q.leftCols(8);
    start += 0.02 * random_axes(2).leftCols(8);
    const EigenPairs found = leading_eigenpairs(A, start, kFourOfEight);
    ASSERT_EQ(found.vectors.cols(), 8);
    EXPECT_LT((found.values.head(4) - four_above(bulk).head(4)).norm(), 1e-11) << bulk;
    for (Eigen::Index k = 0; k < 4; ++k)
      EXPECT_NEAR(std::abs(found.vectors.col(k).dot(Q.col(k))), 1.0, 1e-12) << bulk << " " << k;
    EXPECT_LT((found.vectors.transpose() * found.vectors - Eigen::MatrixXd::Identity(8, 8)).norm(),
              1e-12)
        << bulk;
  }
}

TEST(LeadingEigenpairs, FromAStartThatHasTooFewOrNoneAreTheSame) {
  const Eigen::MatrixXd Q = random_axes(1);
  const Eigen::MatrixXd A = matrix_of(Q, four_above(1e-3));
  const EigenPairs all = leading_eigenpairs(A, Eigen::MatrixXd(kSize, 0), kFourOfEight);
  const EigenPairs few = leading_eigenpairs(A, random_axes(3).leftCols(2), kFourOfEight);
  EXPECT_LT((all.vectors.leftCols(4) - few.vectors.leftCols(4)).norm(), 1e-10);
}

TEST(LeadingEigenpairs, OfWhatHasNoFourLeadingOnesAreThoseOfAll) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(kSize, kSize);
  const EigenPairs found = leading_eigenpairs(A, random_axes(3).leftCols(8), kFourOfEight);
  EXPECT_LT((found.values.array() - 1.0).abs().maxCoeff(), 1e-12);
}

TEST(LeadingEigenpairs, OfASmallMatrixAreAllThatItHas) {
  const Eigen::MatrixXd A = Eigen::Vector3d(1.0, 3.0, 2.0).asDiagonal();
  const EigenPairs found = leading_eigenpairs(A, Eigen::MatrixXd(3, 0), {.exact = 3, .count = 8});
  EXPECT_LT((found.values - Eigen::Vector3d(3.0, 2.0, 1.0)).norm(), 1e-15);
}

}  // namespace
}  // namespace mapproof
