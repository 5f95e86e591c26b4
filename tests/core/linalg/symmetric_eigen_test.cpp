#include "core/linalg/symmetric_eigen.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

using test::distances_of;
using test::scattered;

TEST(LargestEigenpairs, AgreeDenseAndLanczos) {
  const Points points = scattered(400, 3);
  Eigen::MatrixXd A = (-3.0 * distances_of(points)).array().exp();
  const EigenPairs few = largest_eigenpairs(A, 4);     // Lanczos
  const EigenPairs many = largest_eigenpairs(A, 100);  // dense
  EXPECT_LT((few.values - many.values.head(4)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((A * few.vectors - few.vectors * few.values.asDiagonal()).norm(), 1e-8);
  EXPECT_LT((few.vectors - many.vectors.leftCols(4)).cwiseAbs().maxCoeff(), 1e-7);
}

// The symmetry of a square grid makes its eigenvalues come in pairs.
TEST(LargestEigenpairs, FindBothCopiesOfADoubleEigenvalue) {
  for (const Eigen::Index side : {10, 16, 20}) {
    const Eigen::MatrixXd A = (-test::distances_of(test::grid(side, side))).array().exp();
    const EigenPairs few = largest_eigenpairs(A, 10);            // Lanczos
    const EigenPairs many = largest_eigenpairs(A, side * side);  // dense
    EXPECT_LT((few.values - many.values.head(10)).cwiseAbs().maxCoeff(), 1e-9) << side;
  }
}

TEST(LargestEigenpairs, RefuseInvalidMatrices) {
  EXPECT_THROW(largest_eigenpairs(Eigen::MatrixXd::Zero(2, 3), 1), InvalidInput);
  EXPECT_THROW(largest_eigenpairs(Eigen::MatrixXd::Zero(2, 2), 3), InvalidInput);
  EXPECT_THROW(largest_eigenpairs(Eigen::MatrixXd::Constant(2, 2, NAN), 1), InvalidInput);
}

}  // namespace
}  // namespace mapproof
