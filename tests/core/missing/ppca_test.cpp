#include "core/missing/filled.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "core/base/errors.hpp"
#include "tests/support/samples/incomplete.hpp"

namespace mapproof {
namespace {

const PpcaOptions kExact = {.dimensions = 2, .least_rise = 1e-13, .max_iterations = 20000};

Eigen::MatrixXd covariance_of(const LowRankModel& model) {
  Eigen::MatrixXd covariance = model.loadings * model.loadings.transpose();
  covariance.diagonal().array() += model.ridge;
  return covariance;
}

/// Column by column, the normal density of what was observed of it.
double brute_force_likelihood(const Features& matrix, const LowRankModel& model) {
  const Eigen::MatrixXd covariance = covariance_of(model);
  double sum = 0.0;
  for (Eigen::Index c = 0; c < matrix.values.cols(); ++c) {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < matrix.values.rows(); ++i)
      if (matrix.observed.size() == 0 || matrix.observed(i, c) > 0.0) rows.push_back(i);
    if (rows.empty()) continue;
    const Eigen::MatrixXd S = covariance(rows, rows);
    const Eigen::VectorXd left = matrix.values.col(c)(rows) - model.mean(rows);
    sum -= 0.5 * (static_cast<double>(rows.size()) * std::log(2.0 * std::numbers::pi) +
                  std::log(S.determinant()) + left.dot(S.ldlt().solve(left)));
  }
  return sum;
}

/// Tipping and Bishop's solution from the eigenvalues of the covariance.
Eigen::MatrixXd closed_form(const Eigen::MatrixXd& values, Eigen::Index q) {
  const Eigen::MatrixXd centred = values.colwise() - values.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(centred * centred.transpose() /
                                                             static_cast<double>(values.cols()));
  Eigen::VectorXd spectrum = eigen.eigenvalues();  // ascending
  spectrum.head(spectrum.size() - q).setConstant(spectrum.head(spectrum.size() - q).mean());
  return eigen.eigenvectors() * spectrum.asDiagonal() * eigen.eigenvectors().transpose();
}

TEST(Ppca, OfCompleteDataIsTheClosedFormSolution) {
  const Features matrix = test::incomplete_matrix({6, 200, 2, 0.5, 0.0}, 1);
  const Ppca fitted = ppca(matrix, kExact);
  const Eigen::MatrixXd expected = closed_form(matrix.values, 2);
  EXPECT_LT((covariance_of(fitted.model) - expected).norm(), 1e-6 * expected.norm());
  EXPECT_LT((fitted.model.mean - matrix.values.rowwise().mean()).norm(), 1e-6);
}

TEST(Ppca, ConvergesToTheClosedFormFromAStartSpoiltByMissingData) {
  // A column more, of which almost nothing was observed, moves the start away from the solution
  // and the solution hardly at all.
  Features matrix = test::incomplete_matrix({6, 400, 2, 0.5, 0.0}, 2);
  const Eigen::MatrixXd expected = closed_form(matrix.values, 2);
  matrix.values.conservativeResize(6, 1400);
  matrix.values.rightCols(1000).setZero();
  matrix.values.rightCols(1000).row(0).setConstant(matrix.values.row(0).head(400).mean());
  matrix.observed = Eigen::MatrixXd::Zero(6, 1400);
  matrix.observed.leftCols(400).setOnes();
  const Ppca fitted = ppca(matrix, kExact);
  EXPECT_GT(fitted.rises.size(), 1U);
  EXPECT_LT((covariance_of(fitted.model) - expected).norm(), 1e-4 * expected.norm());
}

TEST(Ppca, HasTheLikelihoodOfBruteForceAndNeverReducesIt) {
  const Features matrix = test::incomplete_matrix({8, 60, 3, 0.4, 0.4}, 3);
  PpcaOptions options{.dimensions = 3, .least_rise = 1e-10, .max_iterations = 2000};
  const Ppca fitted = ppca(matrix, options);
  EXPECT_NEAR(fitted.log_likelihood, brute_force_likelihood(matrix, fitted.model),
              1e-8 * std::abs(fitted.log_likelihood));
  for (const double rise : fitted.rises) EXPECT_GT(rise, -1e-8 * std::abs(fitted.log_likelihood));
  EXPECT_TRUE(fitted.statuses.empty());
}

TEST(Ppca, EndsWhereNoStepRaisesTheLikelihood) {
  const Features matrix = test::incomplete_matrix({5, 80, 2, 0.5, 0.3}, 4);
  const LowRankModel best = ppca(matrix, kExact).model;
  const double h = 1e-4;
  const auto slope = [&](auto&& change) {
    LowRankModel up = best;
    LowRankModel down = best;
    change(up, h);
    change(down, -h);
    return (brute_force_likelihood(matrix, up) - brute_force_likelihood(matrix, down)) / (2.0 * h);
  };
  for (Eigen::Index i = 0; i < 5; ++i) {
    EXPECT_NEAR(slope([&](LowRankModel& model, double by) { model.mean(i) += by; }), 0.0, 0.02);
    for (Eigen::Index k = 0; k < 2; ++k)
      EXPECT_NEAR(slope([&](LowRankModel& model, double by) { model.loadings(i, k) += by; }), 0.0,
                  0.02);
  }
  EXPECT_NEAR(slope([&](LowRankModel& model, double by) { model.ridge += by; }), 0.0, 0.02);
}

TEST(Ppca, FindsTheLikelihoodThatScipyFindsFromManyStarts) {
  // tests/bench/ppca_numpy.py
  Features matrix{.values = Eigen::MatrixXd(6, 40), .observed = Eigen::MatrixXd(6, 40)};
  for (int i = 0; i < 6; ++i)
    for (int c = 0; c < 40; ++c) {
      matrix.observed(i, c) = (7 * i + 3 * c) % 5 != 0 ? 1.0 : 0.0;
      matrix.values(i, c) =
          matrix.observed(i, c) * (std::sin(0.7 * i + 0.3 * c) + 0.5 * std::cos(0.11 * i * c) +
                                   0.1 * std::sin(1.7 * i * c + c));
    }
  const Ppca fitted = ppca(matrix, kExact);
  EXPECT_NEAR(fitted.log_likelihood, -155.596239, 1e-5);
  EXPECT_NEAR(fitted.model.ridge, 0.091578, 1e-5);
  EXPECT_NEAR(fitted.model.mean(0), 0.52837, 1e-3);
  EXPECT_NEAR(fitted.model.loadings.row(3).squaredNorm(), 0.98857, 1e-3);
}

TEST(Ppca, FollowsAPermutationOfItsRows) {
  const Features matrix = test::incomplete_matrix({7, 120, 2, 0.3, 0.4}, 5);
  const std::vector<Eigen::Index> order = {3, 6, 0, 2, 5, 1, 4};
  Features permuted;
  permuted.values = matrix.values(order, Eigen::all);
  permuted.observed = matrix.observed(order, Eigen::all);
  const Eigen::MatrixXd covariance = covariance_of(ppca(matrix, kExact).model);
  const Eigen::MatrixXd other = covariance_of(ppca(permuted, kExact).model);
  EXPECT_LT((covariance(order, order) - other).norm(), 1e-4 * other.norm());
}

TEST(Ppca, ReportsThatItWasStopped) {
  const Features matrix = test::incomplete_matrix({8, 60, 3, 0.4, 0.4}, 3);
  const Ppca fitted = ppca(matrix, {.dimensions = 3, .least_rise = 0.0, .max_iterations = 1});
  ASSERT_EQ(fitted.statuses.size(), 1U);
  EXPECT_EQ(fitted.statuses.front().code, StatusCode::kNotConverged);
}

TEST(Ppca, StaysFiniteWhereDataHaveNoNoiseOrNoSpread) {
  for (const double scale : {0.0, 1e-50, 1.0, 1e50}) {
    Features matrix = test::incomplete_matrix({6, 40, 1, 0.0, 0.3}, 6);
    matrix.values *= scale;
    const Ppca fitted = ppca(matrix, {.dimensions = 4});
    EXPECT_TRUE(fitted.model.loadings.allFinite()) << scale;
    EXPECT_TRUE(fitted.model.mean.allFinite()) << scale;
    EXPECT_GT(fitted.model.ridge, 0.0) << scale;
  }
}

TEST(Ppca, RefusesWhatItCannotFit) {
  Features matrix = test::incomplete_matrix({4, 20, 1, 0.1, 0.3}, 7);
  EXPECT_THROW(ppca(matrix, {.dimensions = 0}), InvalidInput);
  EXPECT_THROW(ppca(matrix, {.dimensions = 4}), InvalidInput);
  EXPECT_THROW(ppca(matrix, {.dimensions = 2, .max_iterations = 0}), InvalidInput);
  EXPECT_THROW(ppca(matrix, {.dimensions = 2, .least_rise = NAN}), InvalidInput);
  matrix.observed.row(1).setZero();
  EXPECT_THROW(ppca(matrix, {.dimensions = 2}), InvalidInput);
}

}  // namespace
}  // namespace mapproof
