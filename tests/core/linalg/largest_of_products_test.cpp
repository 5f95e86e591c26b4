#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/symmetric_eigen.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

BlockProduct product_with(const Eigen::MatrixXd& A) {
  return [&A](const Eigen::MatrixXd& V) -> Eigen::MatrixXd { return A * V; };
}

TEST(EigenpairsOfProducts, AreThoseOfEigensDenseSolver) {
  const Eigen::MatrixXd A = (-test::distances_of(test::scattered(300, 3))).array().exp();
  const EigenPairs found = largest_eigenpairs(product_with(A), 300, {.exact = 3, .count = 10});
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> all(A);
  ASSERT_TRUE(found.converged);
  ASSERT_EQ(found.values.size(), 10);
  EXPECT_LT((found.values.head(3) - all.eigenvalues().tail(3).reverse()).cwiseAbs().maxCoeff(),
            1e-10 * found.values(0));
  EXPECT_LT((A * found.vectors.leftCols(3) -
             found.vectors.leftCols(3) * found.values.head(3).asDiagonal())
                .norm(),
            1e-11 * found.values(0));
}

// The symmetry of a square grid makes its eigenvalues come in pairs.
TEST(EigenpairsOfProducts, HoldBothCopiesOfADoubleEigenvalue) {
  const Eigen::MatrixXd A = (-test::distances_of(test::grid(16, 16))).array().exp();
  const EigenPairs found = largest_eigenpairs(product_with(A), 256, {.exact = 3, .count = 10});
  ASSERT_TRUE(found.converged);
  EXPECT_NEAR(found.values(1), found.values(2), 1e-11 * found.values(0));
}

// Of rank one: all further vectors of the start come from rounding.
TEST(EigenpairsOfProducts, SurviveAMatrixOfRankOne) {
  const Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(200, 1.0, 2.0);
  const Eigen::MatrixXd A = v * v.transpose();
  const EigenPairs found = largest_eigenpairs(product_with(A), 200, {.exact = 2, .count = 10});
  ASSERT_TRUE(found.converged);
  EXPECT_NEAR(found.values(0), v.squaredNorm(), 1e-10 * v.squaredNorm());
  EXPECT_LT(found.values.tail(9).cwiseAbs().maxCoeff(), 1e-10 * v.squaredNorm());
}

TEST(EigenpairsOfProducts, RefuseMoreThanTheirBlocksHold) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(120, 120);
  EXPECT_THROW(largest_eigenpairs(product_with(A), 95, {.exact = 2, .count = 10}), InvalidInput);
  EXPECT_THROW(largest_eigenpairs(product_with(A), 120, {.exact = 9, .count = 10}), InvalidInput);
  EXPECT_THROW(largest_eigenpairs(product_with(A), 120, {.exact = 2, .count = 17}), InvalidInput);
}

TEST(GramProduct, IsThatOfEigen) {
  for (const Eigen::Index columns : {1, 4, 5, 39}) {
    const Eigen::MatrixXd X = Eigen::MatrixXd::Random(37, columns);
    const Eigen::MatrixXd V = Eigen::MatrixXd::Random(37, 8);
    const Eigen::MatrixXd expected = X * (X.transpose() * V);
    EXPECT_LT((gram_product(X, V) - expected).cwiseAbs().maxCoeff(), 1e-12) << columns;
  }
  EXPECT_THROW(gram_product(Eigen::MatrixXd::Zero(3, 2), Eigen::MatrixXd::Zero(3, 7)),
               InvalidInput);
}

TEST(ProductOfEight, IsThatOfEigen) {
  for (const Eigen::Index n : {8, 37, 64}) {
    const Eigen::MatrixXd A = Eigen::MatrixXd::Random(n, n);
    const Eigen::MatrixXd V = Eigen::MatrixXd::Random(n, 8);
    EXPECT_LT((product_of_eight(A, V) - A * V).cwiseAbs().maxCoeff(), 1e-13 * 64) << n;
  }
  EXPECT_THROW(product_of_eight(Eigen::MatrixXd::Zero(3, 3), Eigen::MatrixXd::Zero(4, 8)),
               InvalidInput);
}

}  // namespace
}  // namespace mapproof
