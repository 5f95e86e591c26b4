#include "core/uncertainty/history_uncertainty.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"
#include "core/uncertainty/block_length.hpp"
#include "core/uncertainty/resampled_maps.hpp"

namespace mapproof {
namespace {

struct Walked {
  World world;
  ObservationHistory history;
};

Walked walked(Sensor sensor, double dropout_share, int steps = 300) {
  Random random(4);
  Walked made;
  made.world = scatter_landmarks({.side_m = 1.5, .landmarks = 16}, random);
  const Path path = random_walk(made.world, {}, steps, random);
  made.history =
      observe(made.world, path, {.sensor = sensor, .dropout_share = dropout_share}, random);
  return made;
}

std::vector<Eigen::Index> some_steps() {
  std::vector<Eigen::Index> steps;
  for (Eigen::Index t = 0; t < 200; ++t) steps.push_back((t * 7) % 60);
  return steps;
}

class EverySensor : public ::testing::TestWithParam<std::pair<Sensor, double>> {};

TEST_P(EverySensor, ResampledMapsAreThoseOfTheHistoryOfTheseSteps) {
  const auto [sensor, dropout] = GetParam();
  const ObservationHistory history = walked(sensor, dropout).history;
  ObservationHistory drawn = history;
  drawn.values = history.values(Eigen::all, some_steps());
  HistoryEmbedder embedder(drawn, drawn.steps());
  const Points expected = embedder.embed({Method::kSmacof, std::nullopt}).coordinates;
  ResampledMaps maps(history, history.steps(), {});
  const Points found = maps.map_of(some_steps(), {Method::kSmacof, std::nullopt});
  const double size = expected.cwiseAbs().maxCoeff<Eigen::PropagateNumbers>();
  for (Eigen::Index i = 0; i < expected.rows(); ++i)
    for (Eigen::Index k = 0; k < 2; ++k)
      if (std::isnan(expected(i, k))) {
        EXPECT_TRUE(std::isnan(found(i, k)));
      } else {
        EXPECT_NEAR(found(i, k), expected(i, k), 1e-9 * size);
      }
}

TEST_P(EverySensor, EveryLandmarkThatIsSeenHasAnEllipse) {
  const auto [sensor, dropout] = GetParam();
  const Walked made = walked(sensor, dropout);
  Random random(1);
  const UncertaintyFrame frame{made.world.landmarks_m,
                               place_anchors(made.world, 4, AnchorPlacement::kWalls, random)};
  const MapUncertainty found = history_uncertainty(
      made.history, 300, frame, {.setting = {Method::kLpca, std::nullopt}, .replicates = 20});
  ASSERT_EQ(found.covariances.size(), 16U);
  EXPECT_EQ(found.maps, 20);
  EXPECT_EQ(found.block_steps, map_block_length(made.history, 300));
  for (const Eigen::Matrix2d& C : found.covariances) {
    EXPECT_TRUE(C.allFinite());
    EXPECT_EQ(C(0, 1), C(1, 0));
    EXPECT_GE(C.determinant(), -1e-12 * C.squaredNorm());
  }
  if (sensor == Sensor::kRange && dropout == 0.0) return;  // No errors: see below.
  double least = HUGE_VAL;
  for (Eigen::Index i = 0; i < 16; ++i)
    if (std::ranges::find(frame.anchors, i) == frame.anchors.end())
      least = std::min(least, found.covariances[static_cast<std::size_t>(i)].trace());
  EXPECT_GT(least, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(
    Uncertainty, EverySensor,
    ::testing::Values(std::pair{Sensor::kVisibility, 0.0}, std::pair{Sensor::kVisibility, 0.3},
                      std::pair{Sensor::kBearing, 0.0}, std::pair{Sensor::kBearing, 0.3},
                      std::pair{Sensor::kRange, 0.0}, std::pair{Sensor::kRange, 0.3}));

TEST(HistoryUncertainty, IsZeroWhereTheMapIsTheSameForAllSteps) {
  // Ranges without noise give LPCA the same map up to an affine one, whatever the steps.
  const Walked made = walked(Sensor::kRange, 0.0);
  const MapUncertainty found =
      history_uncertainty(made.history, 300, {made.world.landmarks_m, {0, 5, 10, 15}},
                          {.setting = {Method::kLpca, std::nullopt}, .replicates = 20});
  for (const Eigen::Matrix2d& C : found.covariances) EXPECT_LT(C.norm(), 1e-18);
}

TEST(HistoryUncertainty, ScalesWithAFrameWithoutAnchors) {
  const Walked made = walked(Sensor::kBearing, 0.0);
  const HistoryUncertaintyOptions options{.setting = {Method::kSmacof, std::nullopt},
                                          .replicates = 20};
  HistoryEmbedder embedder(made.history, 300);
  const Points map = embedder.embed(options.setting).coordinates;
  const MapUncertainty once = history_uncertainty(made.history, 300, {map, {}}, options);
  const MapUncertainty twice = history_uncertainty(made.history, 300, {2.0 * map, {}}, options);
  for (std::size_t i = 0; i < once.covariances.size(); ++i)
    EXPECT_LT((4.0 * once.covariances[i] - twice.covariances[i]).norm(),
              1e-9 * twice.covariances[i].norm());
}

TEST(HistoryUncertainty, ShrinksWithTheSteps) {
  const Walked made = walked(Sensor::kBearing, 0.0, 2000);
  const HistoryUncertaintyOptions options{.setting = {Method::kLpca, std::nullopt},
                                          .replicates = 60};
  const auto sum = [&](Eigen::Index steps) {
    double total = 0.0;
    for (const Eigen::Matrix2d& C :
         history_uncertainty(made.history, steps, {made.world.landmarks_m, {0, 5, 10, 15}}, options)
             .covariances)
      total += C.trace();
    return total;
  };
  // Variances fall as 1 / N, an eighth; 60 draws and longer blocks leave a factor of two.
  const double share = sum(2000) / sum(250);
  EXPECT_GT(share, 1.0 / 16.0);
  EXPECT_LT(share, 1.0 / 4.0);
}

TEST(HistoryUncertainty, RefusesFramesOfOtherLandmarks) {
  const Walked made = walked(Sensor::kBearing, 0.0);
  EXPECT_THROW(history_uncertainty(made.history, 300, {Points::Zero(3, 2), {}},
                                   {.setting = {Method::kLpca, std::nullopt}}),
               InvalidInput);
}

TEST(InFrame, LeavesMapsOutThatAreTiedByTooFewLandmarks) {
  Points map = Points::Constant(4, 2, NAN);
  map.row(0) << 0.0, 0.0;
  map.row(1) << 1.0, 0.0;
  EXPECT_FALSE(in_frame(map, {Points::Identity(4, 2), {}}, AffineFit::kLeastSquares));
}

TEST(InFrame, AlignsMapsToAnEstimateByAReflectedSimilarity) {
  Points place(4, 2), map(4, 2);
  place << 0.0, 0.0, 3.0, 0.0, 3.0, 1.0, 0.0, 2.0;
  for (Eigen::Index i = 0; i < 4; ++i) map.row(i) << 5.0 - 2.0 * place(i, 0), 2.0 * place(i, 1);
  const auto laid = in_frame(map, {place, {}}, AffineFit::kLeastSquares);
  ASSERT_TRUE(laid);
  EXPECT_LT((*laid - place).norm(), 1e-12);
}

TEST(InFrame, KeepsTheScaleOfMetricMaps) {
  Points place(4, 2);
  place << 0.0, 0.0, 3.0, 0.0, 3.0, 1.0, 0.0, 2.0;
  for (const UncertaintyFrame& frame :
       {UncertaintyFrame{place, {}, true}, UncertaintyFrame{place, {0, 1, 3}, true}}) {
    const auto laid = in_frame(2.0 * place, frame, AffineFit::kLeastSquares);
    ASSERT_TRUE(laid);
    EXPECT_NEAR((laid->row(1) - laid->row(0)).norm(), 6.0, 1e-12);
  }
}

TEST(InFrame, FitsMapsToTheAnchorsAffinely) {
  Points place(5, 2);
  place << 0.0, 0.0, 3.0, 0.0, 3.0, 1.0, 0.0, 2.0, 1.0, 1.0;
  Eigen::Matrix2d A;
  A << 2.0, 0.5, -0.3, 0.7;
  const Points map = (place * A).rowwise() + Eigen::RowVector2d(4.0, -1.0);
  const auto laid = in_frame(map, {place, {0, 1, 3}}, AffineFit::kLeastDistances);
  ASSERT_TRUE(laid);
  EXPECT_LT((*laid - place).norm(), 1e-9);
}

}  // namespace
}  // namespace mapproof
