#include "core/missing/filled.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/SVD>

#include "core/base/errors.hpp"
#include "tests/support/samples/incomplete.hpp"

namespace mapproof {
namespace {

TEST(RegularisedPca, NeverRaisesItsLoss) {
  const Features matrix = test::incomplete_matrix({9, 70, 3, 0.4, 0.5}, 1);
  const RegularisedPca fitted =
      regularised_pca(matrix, {.dimensions = 4, .least_fall = 0.0, .max_iterations = 200});
  for (std::size_t k = 1; k < fitted.losses.size(); ++k)
    EXPECT_LE(fitted.losses[k], fitted.losses[k - 1] * (1.0 + 1e-12));
}

TEST(RegularisedPca, OfCompleteDataShrinksEverySingularValueByThePenalty) {
  // The closed form of least squares with a penalty on the nuclear norm, of rows with mean zero.
  Features matrix = test::incomplete_matrix({6, 50, 3, 0.2, 0.0}, 2);
  matrix.values.colwise() -= Eigen::VectorXd(matrix.values.rowwise().mean());
  const RegularisedPca fitted = regularised_pca(
      matrix, {.dimensions = 3, .penalty_share = 0.1, .least_fall = 0.0, .max_iterations = 3000});
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix.values,
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd shrunk =
      (svd.singularValues().head(3).array() - fitted.model.ridge).max(0.0);
  const Eigen::MatrixXd expected =
      svd.matrixU().leftCols(3) * shrunk.asDiagonal() * svd.matrixV().leftCols(3).transpose();
  const GroupFit fit = fit_group(matrix, column_groups(matrix).front(), fitted.model);
  EXPECT_NEAR(fitted.model.ridge, 0.1 * svd.singularValues()(0), 0.01 * fitted.model.ridge);
  EXPECT_LT((fitted.model.loadings * fit.x - expected).norm(), 1e-4 * expected.norm());
}

TEST(RegularisedPca, FillsLowRankDataAlmostExactlyWithASmallPenalty) {
  const Features complete = test::incomplete_matrix({12, 300, 2, 0.0, 0.0}, 3);
  Features matrix = complete;
  matrix.observed = test::incomplete_matrix({12, 300, 2, 0.0, 0.4}, 3).observed;
  matrix.values = matrix.values.cwiseProduct(matrix.observed);
  const RegularisedPca fitted = regularised_pca(
      matrix, {.dimensions = 2, .penalty_share = 1e-4, .least_fall = 1e-9, .max_iterations = 2000});
  double squares = 0.0;
  double entries = 0.0;
  for (const ColumnGroup& group : column_groups(matrix)) {
    if (group.rows.size() < 5) continue;
    const GroupFit fit = fit_group(matrix, group, fitted.model);
    const Eigen::MatrixXd filled = (fitted.model.loadings * fit.x).colwise() + fitted.model.mean;
    squares += (filled - complete.values(Eigen::all, group.columns)).squaredNorm();
    entries += static_cast<double>(filled.size());
  }
  EXPECT_LT(std::sqrt(squares / entries), 0.02);
}

TEST(RegularisedPca, StaysFiniteOfDataThatAreAllZero) {
  Features matrix = test::incomplete_matrix({5, 30, 1, 0.0, 0.3}, 4);
  matrix.values.setZero();
  const RegularisedPca fitted = regularised_pca(matrix, {.dimensions = 3});
  EXPECT_TRUE(fitted.model.loadings.allFinite());
  EXPECT_TRUE(fitted.model.mean.allFinite());
}

TEST(RegularisedPca, RefusesAPenaltyOfZero) {
  const Features matrix = test::incomplete_matrix({5, 30, 1, 0.1, 0.3}, 5);
  EXPECT_THROW(regularised_pca(matrix, {.dimensions = 2, .penalty_share = 0.0}), InvalidInput);
  EXPECT_THROW(regularised_pca(matrix, {.dimensions = 5}), InvalidInput);
}

}  // namespace
}  // namespace mapproof
