#include "core/submaps/submap_embedding.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/experiment/scored_map.hpp"
#include "core/simulate/sensors.hpp"
#include "tests/support/samples/incomplete.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

ObservationHistory bearings_of(const test::WalkedRoom& room) {
  Random random(3);
  return observe(room.world, room.path, {.sensor = Sensor::kBearing}, random);
}

TEST(SubmapEmbedding, OfASizeThatHoldsAllIsTheWholeMap) {
  const test::WalkedRoom room = test::walked_room(1, 300, 20);
  const ObservationHistory history = bearings_of(room);
  SubmapOptions options;
  options.groups.size = 20;
  const SubmapEmbedding parts = embed_submaps(history, 300, {Method::kSmacof, {}}, options);
  HistoryEmbedder whole(history, 300);
  EXPECT_LT(test::procrustes_gap(whole.embed({Method::kSmacof, {}}).coordinates,
                                 parts.embedding.coordinates),
            1e-9);
  EXPECT_TRUE(std::isnan(parts.median_residual));
}

TEST(SubmapEmbedding, OfRangesWithoutNoiseIsExactByAffineJoins) {
  // LPCA of squared ranges gives each group's map up to an affine map of its own.
  const test::WalkedRoom room = test::walked_room(2, 400, 60);
  Random random(4);
  const ObservationHistory history =
      observe(room.world, room.path, {.sensor = Sensor::kRange}, random);
  SubmapOptions options;
  options.groups.size = 24;
  const SubmapEmbedding parts =
      embed_submaps(history, 400, {Method::kKpcaPolynomial, 1.0}, options);  // degree 1 is LPCA
  EXPECT_LT(test::affine_gap(room.world.landmarks_m, parts.embedding.coordinates), 1e-4);
}

TEST(SubmapEmbedding, IsAMapForEveryMethod) {
  const test::WalkedRoom room = test::walked_room(3, 600, 60);
  const ObservationHistory history = bearings_of(room);
  SubmapOptions options;
  options.groups.size = 30;
  for (const MethodSetting setting :
       {MethodSetting{Method::kLpca, {}}, MethodSetting{Method::kSmacof, {}},
        MethodSetting{Method::kSmacofKnn, 8.0}, MethodSetting{Method::kIsomap, 8.0},
        MethodSetting{Method::kLle, 8.0}, MethodSetting{Method::kHessianLle, 8.0}}) {
    const SubmapEmbedding parts = embed_submaps(history, 600, setting, options);
    const ScoredMap map =
        scored_map(parts.embedding, room.world.landmarks_m, room.anchors, AffineFit::kLeastSquares);
    ASSERT_TRUE(map.score) << slug(setting);
    EXPECT_LT(map.score->moe_unmirrored_percent, 12.0) << slug(setting);
    EXPECT_GT(parts.joined.submaps.size(), 2U);
  }
}

TEST(SubmapEmbedding, KeepsTheRowsOfLandmarksNeverSeen) {
  const test::WalkedRoom room = test::walked_room(4, 300, 30);
  ObservationHistory history = bearings_of(room);
  history.values.row(7).setConstant(std::nan(""));
  SubmapOptions options;
  options.groups.size = 15;
  const SubmapEmbedding parts = embed_submaps(history, 300, {Method::kSmacof, {}}, options);
  EXPECT_TRUE(parts.embedding.coordinates.row(7).array().isNaN().all());
  EXPECT_TRUE(parts.embedding.coordinates.topRows(7).allFinite());
  EXPECT_EQ(parts.embedding.statuses.back().code, StatusCode::kLandmarkUnseen);
}

TEST(SubmapEmbedding, OfNothingSeenFailsWithoutAThrow) {
  const test::WalkedRoom room = test::walked_room(5, 50, 12);
  ObservationHistory history = bearings_of(room);
  history.values.setConstant(std::nan(""));
  const SubmapEmbedding parts = embed_submaps(history, 50, {Method::kIsomap, 4.0}, {});
  EXPECT_EQ(parts.embedding.statuses.back().code, StatusCode::kFailed);
  EXPECT_TRUE(parts.embedding.coordinates.array().isNaN().all());
}

}  // namespace
}  // namespace mapproof
