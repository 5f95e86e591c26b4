#include "core/missing/filled.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/embed/embedder.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/simulate/missing_entries.hpp"
#include "core/simulate/sensors.hpp"
#include "tests/support/samples/incomplete.hpp"

namespace mapproof {
namespace {

ObservationHistory observed_in(const test::WalkedRoom& room, Sensor sensor, double share) {
  Random random(11);
  const ObservationHistory history = observe(room.world, room.path, {.sensor = sensor}, random);
  return with_missing(history, random_losses(history.landmarks(), history.steps(), random), share);
}

FillingOptions filled_by(Filling filling) {
  FillingOptions options;
  options.filling = filling;
  return options;
}

double mpe_of(const Proximities& data, const test::WalkedRoom& room) {
  Embedder embedder(data);
  return scored_map(embedder.embed({Method::kSmacofKnn, 8}), room.world.landmarks_m, room.anchors,
                    AffineFit::kLeastSquares)
      .score.value()
      .mpe_m;
}

TEST(Filled, WithoutMissingDataEqualsProximities) {
  const test::WalkedRoom room = test::walked_room(1, 50, 12);
  for (const Sensor sensor : {Sensor::kVisibility, Sensor::kBearing, Sensor::kRange}) {
    const ObservationHistory history = observed_in(room, sensor, 0.0);
    for (const Filling filling : {Filling::kPpca, Filling::kPca, Filling::kMean})
      EXPECT_EQ(filled_proximities(history, 50, filled_by(filling)).proximities.squared_distances,
                proximities(history, 50).squared_distances);
  }
}

TEST(Filled, RangesWithoutNoiseComeBackFromHalfOfTheirEntries) {
  // Squared ranges less a row's mean have three dimensions, so that nothing is lost.
  const test::WalkedRoom room = test::walked_room(2, 300, 15);
  const Eigen::MatrixXd whole =
      proximities(observed_in(room, Sensor::kRange, 0.0), 300).squared_distances;
  FillingOptions options;
  options.ppca = {.dimensions = 3, .least_rise = 1e-9, .max_iterations = 2000};
  const FilledProximities filled =
      filled_proximities(observed_in(room, Sensor::kRange, 0.5), 300, options);
  const auto worst = [&](const FilledProximities& other) {
    return (other.proximities.squared_distances - whole).cwiseAbs().maxCoeff() / whole.maxCoeff();
  };
  EXPECT_LT(worst(filled), 0.005);
  EXPECT_GT(worst(filled_proximities(observed_in(room, Sensor::kRange, 0.5), 300,
                                     filled_by(Filling::kMean))),
            0.1);
}

TEST(Filled, ExpectedSquaresAreLongerThanThoseOfFilledValues) {
  const test::WalkedRoom room = test::walked_room(3, 200, 15);
  const ObservationHistory history = observed_in(room, Sensor::kBearing, 0.4);
  const FilledProximities filled = filled_proximities(history, 200, filled_by(Filling::kPpca));
  const Proximities expected = filled_from(features(history, 200), Sensor::kBearing, filled.model,
                                           CompletedDistances::kExpected);
  Eigen::MatrixXd more = expected.squared_distances - filled.proximities.squared_distances;
  more.diagonal().setOnes();
  EXPECT_GT(more.minCoeff(), 0.0);
}

TEST(Filled, HalfOfTheBearingsGiveAsGoodAMapAsAllOfThemButNotByTheirMeans) {
  double whole = 0.0, common = 0.0, by_ppca = 0.0, by_pca = 0.0, by_means = 0.0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const test::WalkedRoom room = test::walked_room(seed, 2000);
    whole += mpe_of(proximities(observed_in(room, Sensor::kBearing, 0.0), 2000), room) / 3.0;
    const ObservationHistory history = observed_in(room, Sensor::kBearing, 0.5);
    const auto filled = [&](Filling filling) {
      return mpe_of(filled_proximities(history, 2000, filled_by(filling)).proximities, room) / 3.0;
    };
    common += filled(Filling::kPairwiseComplete);
    by_ppca += filled(Filling::kPpca);
    by_pca += filled(Filling::kPca);
    by_means += filled(Filling::kMean);
  }
  // The complete map's own band, of independent prototypes, reaches to .067.
  EXPECT_LT(by_ppca, 0.067);
  EXPECT_LT(by_pca, 0.067);
  EXPECT_LT(std::abs(by_ppca - whole), 0.01);
  EXPECT_LT(common, 0.09);
  EXPECT_GT(by_means, 2.0 * whole);
}

TEST(Filled, IsCompleteWhereLandmarksWereHardlySeen) {
  const test::WalkedRoom room = test::walked_room(4, 40, 10);
  for (const Sensor sensor : {Sensor::kVisibility, Sensor::kBearing, Sensor::kRange}) {
    ObservationHistory history = observed_in(room, sensor, 0.9);
    for (Eigen::Index i = 0; i < 10; ++i) history.values(i, i) = 1.0;  // each seen at least once
    for (const Filling filling : {Filling::kPpca, Filling::kPca, Filling::kMean}) {
      const FilledProximities filled = filled_proximities(history, 40, filled_by(filling));
      EXPECT_TRUE(filled.proximities.squared_distances.allFinite()) << name(filling);
      EXPECT_GE(filled.proximities.squared_distances.minCoeff(), 0.0) << name(filling);
    }
  }
}

TEST(Filled, NamesComeBack) {
  for (const Filling filling :
       {Filling::kPairwiseComplete, Filling::kPpca, Filling::kPca, Filling::kMean})
    EXPECT_EQ(filling_named(name(filling)), filling);
  EXPECT_FALSE(filling_named("zero"));
}

}  // namespace
}  // namespace mapproof
