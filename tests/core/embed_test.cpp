#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/embed/embedder.hpp"
#include "core/embed/isomap.hpp"
#include "core/embed/pca.hpp"
#include "core/embed/smacof.hpp"
#include "core/linalg/planarity.hpp"
#include "tests/support/samples/worlds.hpp"
#include "tests/support/statuses.hpp"

namespace mapproof {
namespace {

using test::distances_of;
using test::has;
using test::procrustes_gap;
using test::scattered;

Proximities proximities_of(const Points& points) {
  return {.inner_products = points * points.transpose(),
          .squared_distances = distances_of(points).cwiseAbs2()};
}

/// A setting that suits points in a square of this side.
MethodSetting setting(const MethodInfo& method, double side = 1.0) {
  if (!method.parameter) return {method.method, std::nullopt};
  if (method.method == Method::kKpcaGaussian) return {method.method, 0.5 * side * side};
  if (method.method == Method::kKpcaPolynomial) return {method.method, 2.0};
  return {method.method, 6.0};
}

TEST(Lpca, RecoversPointsFromTheirDistances) {
  const Points points = scattered(30, 1);
  const Embedding map = lpca(distances_of(points).cwiseAbs2());
  EXPECT_LT(procrustes_gap(points, map.coordinates), 1e-12);
  EXPECT_LT(std::abs(map.spectrum(2)), 1e-12);
}

TEST(Lpca, ReportsFlatData) {
  Points line = scattered(10, 1);
  line.col(1).setZero();
  const Embedding map = lpca(distances_of(line).cwiseAbs2());
  EXPECT_TRUE(has(map, StatusCode::kRankDeficient));
  EXPECT_TRUE(map.coordinates.col(1).isZero());
  EXPECT_TRUE(has(lpca(Eigen::MatrixXd::Zero(5, 5)), StatusCode::kRankDeficient));
}

TEST(Smacof, StaysAtAPerfectMap) {
  const Points points = scattered(20, 4);
  const Embedding map = smacof(distances_of(points), {}, points);
  EXPECT_LT(*map.stress, 1e-28);
  EXPECT_LT(procrustes_gap(points, map.coordinates), 1e-12);
}

TEST(Smacof, ReducesItsStressAtEveryStep) {
  const Points points = scattered(20, 4);
  const Points start = scattered(20, 5);
  const Eigen::MatrixXd D = distances_of(points);
  const Eigen::MatrixXd W = (D.array() < 0.6).cast<double>();
  for (const Eigen::MatrixXd& weights : {Eigen::MatrixXd(), W}) {
    double last = HUGE_VAL;
    for (int steps = 1; steps <= 30; ++steps) {
      const Embedding map =
          smacof(D, weights, start, {.relative_fall = 0.0, .max_iterations = steps});
      EXPECT_LE(*map.stress, last * (1.0 + 1e-12));
      EXPECT_TRUE(has(map, StatusCode::kNotConverged));
      last = *map.stress;
    }
  }
}

TEST(Smacof, WithAllWeightsOneIsSmacofWithoutWeights) {
  const Eigen::MatrixXd D = distances_of(scattered(15, 1)).cwiseSqrt();
  const Points start = scattered(15, 2);
  const Embedding plain = smacof(D, {}, start);
  const Embedding weighted = smacof(D, Eigen::MatrixXd::Ones(15, 15), start);
  EXPECT_NEAR(*plain.stress, *weighted.stress, 1e-9);
}

TEST(Smacof, RefusesWeightsThatLeaveTheLandmarksInPieces) {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(6, 6);
  W.topLeftCorner(3, 3).setOnes();
  W.bottomRightCorner(3, 3).setOnes();
  EXPECT_THROW(smacof(distances_of(scattered(6, 1)), W, scattered(6, 2)), InvalidInput);
}

TEST(Smacof, RefusesWeightsAndOptionsOutOfBounds) {
  const Points points = scattered(6, 1);
  const Eigen::MatrixXd D = distances_of(points);
  for (const double weight : {-1.0, std::nan(""), HUGE_VAL}) {
    Eigen::MatrixXd W = Eigen::MatrixXd::Ones(6, 6);
    W(2, 3) = W(3, 2) = weight;
    EXPECT_THROW(smacof(D, W, points), InvalidInput) << weight;
  }
  EXPECT_THROW(smacof(D, {}, points, {.relative_fall = -1e-9}), InvalidInput);
  EXPECT_THROW(smacof(D, {}, points, {.relative_fall = std::nan("")}), InvalidInput);
  EXPECT_THROW(smacof(D, {}, points, {.max_iterations = 0}), InvalidInput);
}

TEST(Embedder, ReportsThatTheStartOfWeightedSmacofDidNotConverge) {
  EmbedderOptions options;
  options.smacof = {.relative_fall = 0.0, .max_iterations = 2};
  const Points points = scattered(25, 9);
  Embedder embedder({.inner_products = {}, .squared_distances = distances_of(points)}, options);
  const Embedding map = embedder.embed({Method::kSmacofKnn, 6.0});
  ASSERT_TRUE(has(map, StatusCode::kNotConverged));
  EXPECT_EQ(map.statuses.front().starts, std::vector<Method>{Method::kSmacof});
}

TEST(Isomap, UnrollsASpiral) {
  const Eigen::Index n = 100;
  Eigen::VectorXd along(n);
  Points spiral(n, 2);
  double length = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double angle = 1.0 + 0.08 * static_cast<double>(i);
    spiral.row(i) << angle * std::cos(angle), angle * std::sin(angle);
    if (i > 0) length += (spiral.row(i) - spiral.row(i - 1)).norm();
    along(i) = length;
  }
  const Embedding map = isomap(distances_of(spiral), {.neighbours = 2});
  const Eigen::VectorXd found = map.coordinates.col(0);
  const double sign = found(n - 1) > found(0) ? 1.0 : -1.0;
  EXPECT_LT((sign * found - (along.array() - along.mean()).matrix()).cwiseAbs().maxCoeff(), 0.05);
}

TEST(Isomap, WithAllNeighboursIsLpca) {
  const Points points = scattered(20, 1);
  const Embedding map = isomap(distances_of(points), {.neighbours = 19});
  EXPECT_LT(procrustes_gap(points, map.coordinates), 1e-12);
}

TEST(Isomap, ReportsThatItBridgedIslands) {
  Points points(20, 2);
  points << scattered(10, 1), (scattered(10, 2).rowwise() + Eigen::RowVector2d(50, 0));
  const Embedding map = isomap(distances_of(points), {.neighbours = 3});
  EXPECT_TRUE(has(map, StatusCode::kBridged));
  EXPECT_TRUE(map.coordinates.allFinite());
}

class EveryMethod : public ::testing::TestWithParam<MethodInfo> {};

TEST_P(EveryMethod, FollowsTheOrderOfTheRows) {
  const Points points = scattered(25, 9);
  std::vector<Eigen::Index> order(25);
  for (std::size_t i = 0; i < 25; ++i) order[i] = static_cast<Eigen::Index>(i * 7 % 25);
  const Points shuffled = points(order, Eigen::all);
  const Points map = Embedder(proximities_of(points)).embed(setting(GetParam())).coordinates;
  const Points other = Embedder(proximities_of(shuffled)).embed(setting(GetParam())).coordinates;
  EXPECT_LT(procrustes_gap(map(order, Eigen::all), other), 1e-6 * map.norm());
}

TEST_P(EveryMethod, IsTheSameTwice) {
  const Proximities data = proximities_of(scattered(25, 9));
  EXPECT_EQ(Embedder(data).embed(setting(GetParam())).coordinates,
            Embedder(data).embed(setting(GetParam())).coordinates);
}

TEST_P(EveryMethod, ScalesWithItsData) {
  if (GetParam().method == Method::kKpcaPolynomial) return;  // The 1 in its kernel is a scale.
  const Points points = scattered(25, 9);
  const Points map = Embedder(proximities_of(points)).embed(setting(GetParam())).coordinates;
  const Points big =
      Embedder(proximities_of(1000.0 * points)).embed(setting(GetParam(), 1000.0)).coordinates;
  EXPECT_LT(procrustes_gap(map / map.norm(), big / big.norm()), 1e-6);
}

TEST_P(EveryMethod, GivesAMapOrAReasonForHardData) {
  const auto check = [&](const Eigen::MatrixXd& D, const std::string& what) {
    const Embedding map = Embedder({.inner_products = D, .squared_distances = D.cwiseAbs2()})
                              .embed(setting(GetParam()));
    EXPECT_EQ(map.coordinates.rows(), D.rows()) << what;
    EXPECT_TRUE(map.coordinates.allFinite() || has(map, StatusCode::kFailed)) << what;
  };
  check(Eigen::MatrixXd::Zero(10, 10), "all landmarks at one position");
  check(Eigen::MatrixXd::Ones(10, 10) - Eigen::MatrixXd::Identity(10, 10), "all equally far");
  Points line = scattered(10, 1);
  line.col(1).setZero();
  check(distances_of(line), "on a line");
  check(1e-150 * distances_of(scattered(10, 1)), "tiny");
  check(1e100 * distances_of(scattered(10, 1)), "huge");
  Eigen::MatrixXd torn = Eigen::MatrixXd::Constant(10, 10, HUGE_VAL);
  torn.topLeftCorner(5, 5) = distances_of(scattered(5, 1));
  torn.bottomRightCorner(5, 5) = distances_of(scattered(5, 2));
  check(torn, "two groups without a common step");
  check(distances_of(scattered(4, 1)), "fewer landmarks than neighbours");
  check(distances_of(scattered(2, 1)), "two landmarks");
}

TEST_P(EveryMethod, ReportsAFlatMap) {
  Points line = scattered(10, 1);
  line.col(1) = 2.0 * line.col(0);
  const Embedding of_line = Embedder(proximities_of(line)).embed(setting(GetParam()));
  const auto said = std::ranges::count(of_line.statuses, StatusCode::kRankDeficient, &Status::code);
  EXPECT_LE(said, 1);
  // Some methods bend a line: their map is not flat, and has no status.
  EXPECT_GE(said, planarity(of_line.coordinates) <= kFlatPlanarity ? 1 : 0);
  const Embedding of_point =
      Embedder(proximities_of(Points::Zero(10, 2))).embed(setting(GetParam()));
  EXPECT_TRUE(has(of_point, StatusCode::kRankDeficient));
  EXPECT_TRUE(of_point.coordinates.isZero());
  const Embedding map = Embedder(proximities_of(scattered(10, 1))).embed(setting(GetParam()));
  EXPECT_FALSE(has(map, StatusCode::kRankDeficient));
}

TEST_P(EveryMethod, CompletesPairsWithoutACommonStep) {
  const Points points = scattered(25, 9);
  Proximities data = proximities_of(points);
  Eigen::Index a = 0, b = 0;
  data.squared_distances.maxCoeff(&a, &b);
  data.squared_distances(a, b) = data.squared_distances(b, a) = HUGE_VAL;
  const Embedding map = Embedder(data).embed(setting(GetParam()));
  const Embedding whole = Embedder(proximities_of(points)).embed(setting(GetParam()));
  const double size = whole.coordinates.norm();
  EXPECT_LT(procrustes_gap(whole.coordinates, map.coordinates), 0.1 * std::max(size, 1.0));
}

TEST_P(EveryMethod, BridgesIslandsAndReportsIt) {
  Points points(30, 2);
  points << scattered(15, 1), (scattered(15, 2).rowwise() + Eigen::RowVector2d(3, 0));
  const Embedding map = Embedder(proximities_of(points)).embed(setting(GetParam()));
  EXPECT_TRUE(map.coordinates.allFinite());
  EXPECT_EQ(has(map, StatusCode::kBridged), on_graph(GetParam().method));
}

TEST_P(EveryMethod, MapsThreeLandmarksOrGivesAReason) {
  MethodSetting few = setting(GetParam());
  if (on_graph(few.method)) few.parameter = 2.0;
  const Embedding map = Embedder(proximities_of(scattered(3, 1))).embed(few);
  if (GetParam().method == Method::kHessianLle) {
    ASSERT_TRUE(has(map, StatusCode::kFailed));
    EXPECT_EQ(map.statuses.front(), status_of<StatusReason::kHessianNeighbours>(6, 2));
  } else {
    EXPECT_TRUE(map.coordinates.allFinite());
  }
}

TEST_P(EveryMethod, MapsDuplicatesToFinitePositions) {
  Points points = scattered(25, 9);
  points.row(7) = points.row(3);
  points.row(20) = points.row(3);
  const Embedding map = Embedder(proximities_of(points)).embed(setting(GetParam()));
  EXPECT_TRUE(map.coordinates.allFinite());
}

TEST_P(EveryMethod, HasAUsualParameterWithinItsBounds) {
  const MethodInfo& method = GetParam();
  for (const Eigen::Index n : {3, 5, 25}) {
    const MethodSetting usual =
        Embedder(proximities_of(scattered(n, 1))).usual_setting(method.method);
    ASSERT_EQ(usual.parameter.has_value(), method.parameter.has_value());
    if (!usual.parameter) continue;
    EXPECT_GE(*usual.parameter, method.parameter->minimum);
    EXPECT_LE(*usual.parameter, method.parameter->maximum);
    EXPECT_TRUE(!on_graph(method.method) || *usual.parameter < static_cast<double>(n));
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryMethod, ::testing::ValuesIn(all_methods()),
                         [](const auto& method) {
                           std::string name(method.param.name);
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace mapproof
