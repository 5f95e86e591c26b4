#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "core/align/affine.hpp"
#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/score/map_score.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

using test::scattered;

const Affine kSheared{.linear = (Eigen::Matrix2d() << 2, 0.3, -0.5, -1.1).finished(),
                      .offset = {3, -4}};

class FitAffine : public ::testing::TestWithParam<AffineFit> {};

TEST_P(FitAffine, RecoversAnAffineMapExactly) {
  const Points points = scattered(6, 1);
  const Affine found = fit_affine(points, kSheared(points), GetParam());
  EXPECT_LT((found.linear - kSheared.linear).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((found.offset - kSheared.offset).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(FitAffine, RefusesTooFewAndCollinearPoints) {
  EXPECT_THROW(fit_affine(scattered(2, 1), scattered(2, 2), GetParam()), InvalidInput);
  Points line = scattered(5, 1);
  line.col(1) = 2.0 * line.col(0);
  EXPECT_THROW(fit_affine(line, scattered(5, 2), GetParam()), InvalidInput);
  Points holed = scattered(5, 1);
  holed(2, 0) = NAN;
  EXPECT_THROW(fit_affine(holed, scattered(5, 2), GetParam()), InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(Both, FitAffine,
                         ::testing::Values(AffineFit::kLeastDistances, AffineFit::kLeastSquares));

TEST(FitAffine, LeastDistancesThroughFourPointsMeetsThree) {
  // The residuals of an affine fit through 4 points are one vector divided by the points'
  // affine dependency n; the least sum of distances puts all of it on the largest |n_i|.
  const Points from = scattered(4, 3);
  const Points to = scattered(4, 4);
  const Eigen::Matrix<double, 4, 3> rows =
      (Eigen::Matrix<double, 4, 3>() << from, Eigen::Vector4d::Ones()).finished();
  const Eigen::Vector4d n =
      Eigen::JacobiSVD<Eigen::Matrix<double, 4, 3>, Eigen::FullPivHouseholderQRPreconditioner>(
          rows, Eigen::ComputeFullU)
          .matrixU()
          .col(3);
  const double least = (n.transpose() * to).norm() / n.cwiseAbs().maxCoeff();
  const Affine found = fit_affine(from, to, AffineFit::kLeastDistances);
  const Eigen::VectorXd residuals = (found(from) - to).rowwise().norm();
  EXPECT_NEAR(residuals.sum(), least, 1e-12 * least);
  EXPECT_GT((fit_affine(from, to, AffineFit::kLeastSquares)(from) - to).rowwise().norm().sum(),
            least * (1.0 + 1e-6));
}

TEST(FitAffine, LeastDistancesCannotBeBetteredByASmallChange) {
  Random random(11);
  for (const Eigen::Index n : {4, 5, 8, 50}) {
    const Points from = scattered(n, 20 + static_cast<std::uint64_t>(n));
    const Points to = scattered(n, 30 + static_cast<std::uint64_t>(n));
    const auto sum = [&](const Affine& map) { return (map(from) - to).rowwise().norm().sum(); };
    const Affine best = fit_affine(from, to, AffineFit::kLeastDistances);
    for (int round = 0; round < 2000; ++round) {
      const double size = std::pow(10.0, -1.0 - 4.0 * random.uniform());
      Affine other = best;
      for (double& entry : other.linear.reshaped()) entry += size * random.normal();
      for (double& entry : other.offset) entry += size * random.normal();
      EXPECT_GE(sum(other), sum(best) * (1.0 - 1e-6)) << n;
    }
  }
}

TEST(FitAffine, LeastDistancesIsRobustToOneWrongAnchor) {
  const Points from = scattered(8, 5);
  Points to = kSheared(from);
  to.row(2) += Eigen::RowVector2d(10, 10);
  const Affine found = fit_affine(from, to, AffineFit::kLeastDistances);
  EXPECT_LT((found.linear - kSheared.linear).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(OrientationError, IsZeroForAnyProperAffineImageAndHundredForAReflection) {
  const Points ground_truth = scattered(15, 1);
  EXPECT_EQ(orientation_error_percent(ground_truth, 3.0 * ground_truth), 0.0);
  Points mirrored = ground_truth;
  mirrored.col(0) *= -1.0;
  EXPECT_EQ(orientation_error_percent(ground_truth, mirrored), 100.0);
}

TEST(OrientationError, AgreesWithCountingTriples) {
  const Points ground_truth = scattered(12, 1);
  const Points estimate = scattered(12, 2);
  const auto turn = [](const Points& p, Eigen::Index i, Eigen::Index j, Eigen::Index k) {
    Eigen::Matrix3d m;
    m << p.row(i), 1.0, p.row(j), 1.0, p.row(k), 1.0;
    return m.determinant();
  };
  int wrong = 0, all = 0;
  for (Eigen::Index i = 0; i < 12; ++i)
    for (Eigen::Index j = i + 1; j < 12; ++j)
      for (Eigen::Index k = j + 1; k < 12; ++k, ++all)
        if (turn(ground_truth, i, j, k) * turn(estimate, i, j, k) <= 0) ++wrong;
  EXPECT_NEAR(orientation_error_percent(ground_truth, estimate), 100.0 * wrong / all, 1e-12);
}

TEST(OrientationError, CountsFlattenedTriplesAsWrongAndLeavesFlatGroundTruthOut) {
  Points ground_truth(4, 2);
  ground_truth << 0, 0, 1, 0, 2, 0, 0, 1;  // the first three are on a line
  EXPECT_EQ(orientation_error_percent(ground_truth, Points::Zero(4, 2)), 100.0);
  EXPECT_EQ(orientation_error_percent(ground_truth, ground_truth), 0.0);
  EXPECT_TRUE(
      std::isnan(orientation_error_percent(ground_truth.topRows(3), ground_truth.topRows(3))));
}

TEST(OrientationError, DoesNotDependOnRoundingWhereLandmarksCoincide) {
  // Three landmarks at one point of the map: each triple with two of them is flat, whatever the
  // last digits are.
  const Points ground_truth = scattered(12, 5);
  Points together = ground_truth;
  together.row(4) = together.row(7) = together.row(9);
  const double wrong = orientation_error_percent(ground_truth, together);
  Random random(3);
  for (int draw = 0; draw < 20; ++draw) {
    Points moved = together;
    for (Eigen::Index k = 0; k < moved.size(); ++k)
      moved(k) *= 1.0 + 1e-15 * (random.uniform() - 0.5);
    for (const Eigen::Index k : {4, 7, 9}) moved(k, draw % 2) += 1e-16 * draw;
    EXPECT_EQ(orientation_error_percent(ground_truth, moved), wrong) << draw;
  }
}

TEST(OrientationError, LeavesALineInTheGroundTruthOutHoweverItIsRotated) {
  Points ground_truth(9, 2);
  for (Eigen::Index i = 0; i < 8; ++i) ground_truth.row(i) << 0.1 * static_cast<double>(i * i), 0.0;
  ground_truth.row(8) << 0.3, 1.0;
  const Points estimate = scattered(9, 1);
  const double level = orientation_error_percent(ground_truth, estimate);
  for (const double turn : {0.1, 0.7, 1.3, 2.9}) {
    const Points turned = ground_truth * Eigen::Rotation2Dd(turn).toRotationMatrix().transpose();
    EXPECT_EQ(orientation_error_percent(turned, estimate), level) << turn;
    EXPECT_TRUE(std::isnan(orientation_error_percent(turned.topRows(8), estimate.topRows(8))));
  }
}

TEST(OrientationError, LeavesOutPointsThatCoincideInTheGroundTruth) {
  Points ground_truth(4, 2);
  ground_truth << 0, 0, 0, 0, 1, 0, 0, 1;
  EXPECT_EQ(orientation_error_percent(ground_truth, ground_truth), 0.0);
}

TEST(OrientationError, OfManyLandmarksIsThatOfDrawnTriples) {
  // Of more than 5000 landmarks. What is true of all triples is true of those drawn.
  const Points points = scattered(6000, 5);
  const Points sheared = kSheared(points);  // It reflects.
  EXPECT_EQ(orientation_error_percent(points, points), 0.0);
  EXPECT_EQ(orientation_error_percent(points, sheared), 100.0);
  EXPECT_EQ(orientation_error_percent(points, Points::Zero(6000, 2)), 100.0);
  EXPECT_TRUE(std::isnan(orientation_error_percent(Points::Zero(6000, 2), points)));
  // Any orientation is as likely as the other on a map that has nothing to do with the points.
  EXPECT_NEAR(orientation_error_percent(points, scattered(6000, 6)), 50.0, 0.1);
  // Half of the landmarks reflected: the drawn triples agree with all of a fifth of them.
  Points folded = points;
  folded.topRows(3000).col(0) = 1.0 - folded.topRows(3000).col(0).array();
  EXPECT_NEAR(orientation_error_percent(points, folded),
              orientation_error_percent(points(Eigen::seq(0, 5999, 5), Eigen::all),
                                        folded(Eigen::seq(0, 5999, 5), Eigen::all)),
              1.0);
}

TEST(ScoreMap, RefusesRowsThatDoNotMatch) {
  const Points ground_truth = test::grid(3, 3);
  const auto fit = AffineFit::kLeastSquares;
  EXPECT_THROW(score_map(ground_truth.topRows(8), ground_truth, {}, fit), InvalidInput);
  EXPECT_THROW(score_map(ground_truth, ground_truth, {9}, fit), InvalidInput);
  EXPECT_THROW(align_to_anchors(ground_truth, ground_truth.topRows(8), {0, 2, 6}, fit),
               InvalidInput);
  EXPECT_THROW(align_to_anchors(ground_truth, ground_truth, {0, 2, -1}, fit), InvalidInput);
}

TEST(ScoreMap, AveragesTheErrorOverLandmarksThatAreNotAnchors) {
  const Points ground_truth = test::grid(3, 3);
  Points estimate = ground_truth;
  estimate.row(4) += Eigen::RowVector2d(0.3, 0.4);
  const auto score = score_map(estimate, ground_truth, {0, 2, 6, 8}, AffineFit::kLeastSquares);
  ASSERT_TRUE(score);
  EXPECT_NEAR(score->mpe_m, 0.5 / 5.0, 1e-15);
  EXPECT_LT(score->mpe_all_fitted_m, 0.5 / 5.0);
}

TEST(ScoreMap, LeavesOutWhatIsNotOnTheMap) {
  const Points ground_truth = test::grid(3, 3);
  Points estimate = ground_truth;
  estimate.row(4).setConstant(NAN);
  const auto score = score_map(estimate, ground_truth, {0, 2, 6, 8}, AffineFit::kLeastSquares);
  ASSERT_TRUE(score);
  EXPECT_EQ(score->mpe_m, 0.0);
  EXPECT_FALSE(score_map(Points::Constant(9, 2, NAN), ground_truth, {}, AffineFit::kLeastSquares));
}

TEST(ScoreMap, HasNoErrorOfThreeLandmarksThatAnyMapMeets) {
  const Points ground_truth = scattered(4, 1);
  const auto score = [&](Eigen::Index landmarks) {
    Points estimate = scattered(4, 2);
    estimate.bottomRows(4 - landmarks).setConstant(NAN);
    const AlignedMap map =
        align_to_anchors(estimate, ground_truth, {0, 1, 2}, AffineFit::kLeastSquares);
    return score_map(map.positions_m, ground_truth, {0, 1, 2}, AffineFit::kLeastSquares).value();
  };
  for (const double error : {score(3).mpe_m, score(3).moe_percent, score(3).mpe_all_fitted_m,
                             score(3).moe_unmirrored_percent})
    EXPECT_TRUE(std::isnan(error)) << error;
  EXPECT_GT(score(4).mpe_m, 0.0);
  EXPECT_GE(score(4).moe_unmirrored_percent, 0.0);
  // The third landmark of two anchors has an error and an orientation.
  const Score of_other =
      score_map(scattered(3, 2), scattered(3, 1), {0, 1}, AffineFit::kLeastSquares).value();
  EXPECT_GT(of_other.mpe_m, 0.0);
  EXPECT_GE(of_other.moe_percent, 0.0);
  EXPECT_TRUE(std::isnan(of_other.moe_unmirrored_percent));
}

TEST(AlignToAnchors, ForgetsTheFrameOfTheEmbedding) {
  const Points ground_truth = scattered(10, 1);
  const AlignedMap map = align_to_anchors(kSheared(ground_truth), ground_truth, {0, 3, 5, 7},
                                          AffineFit::kLeastDistances);
  EXPECT_TRUE(map.aligned);
  EXPECT_LT((map.positions_m - ground_truth).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(AlignToAnchors, ReportsWhyItCannot) {
  const Points ground_truth = scattered(10, 1);
  Points flat = ground_truth;
  flat.col(1).setZero();
  const AlignedMap degenerate =
      align_to_anchors(flat, ground_truth, {0, 1, 2}, AffineFit::kLeastSquares);
  EXPECT_FALSE(degenerate.aligned);
  EXPECT_EQ(degenerate.statuses.at(0).code, StatusCode::kAnchorsDegenerate);
  Points holed = ground_truth;
  holed.row(1).setConstant(NAN);
  const AlignedMap missing =
      align_to_anchors(holed, ground_truth, {0, 1, 2}, AffineFit::kLeastSquares);
  EXPECT_EQ(missing.statuses.at(0).code, StatusCode::kAnchorsMissing);
  EXPECT_THROW(align_to_anchors(ground_truth, flat, {0, 1, 2}, AffineFit::kLeastSquares),
               InvalidInput);
}

TEST(ScoreMap, CountsEveryTripleOfAFlatMapAsWrongInBothOrientations) {
  const Points ground_truth = test::grid(3, 3);
  Points flat = ground_truth;
  flat.col(1).setZero();
  const Points point = Points::Zero(9, 2);
  for (const Points& estimate : {flat, point}) {
    const Score score =
        score_map(estimate, ground_truth, {0, 1, 3}, AffineFit::kLeastSquares).value();
    EXPECT_EQ(score.moe_percent, 100.0);
    EXPECT_EQ(score.moe_unmirrored_percent, 100.0);
  }
  Points mirrored = ground_truth;
  mirrored.col(0) *= -1.0;
  const Score score =
      score_map(mirrored, ground_truth, {0, 1, 3}, AffineFit::kLeastSquares).value();
  EXPECT_EQ(score.moe_percent, 100.0);
  EXPECT_EQ(score.moe_unmirrored_percent, 0.0);
}

}  // namespace
}  // namespace mapproof
