#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/embed/embedder.hpp"
#include "core/simulate/sensors.hpp"
#include "tests/support/statuses.hpp"

namespace mapproof {
namespace {

using test::has;
using test::status_for;

TEST(HistoryEmbedder, LeavesUnseenLandmarksOutAndNamesThem) {
  Eigen::MatrixXd angles = Eigen::MatrixXd::NullaryExpr(10, 50, [](Eigen::Index i, Eigen::Index j) {
    const auto row = static_cast<double>(i);
    return std::sin(row) + 0.01 * static_cast<double>(j) * row;
  });
  angles.row(3).setConstant(NAN);
  ObservationHistory history{
      .sensor = Sensor::kBearing, .names = landmark_names(10), .values = angles};
  const Embedding map = HistoryEmbedder(history, 50).embed({Method::kLpca, std::nullopt});
  EXPECT_TRUE(map.coordinates.row(3).hasNaN());
  EXPECT_TRUE(map.coordinates.row(2).allFinite());
  ASSERT_TRUE(has(map, StatusCode::kLandmarkUnseen));
  EXPECT_EQ(map.statuses.back().names, std::vector<std::string>{"L4"});
}

TEST(HistoryEmbedder, NamesEveryUnseenLandmark) {
  Eigen::MatrixXd seen = Eigen::MatrixXd::Zero(20, 6);
  seen.topRows(5).setOnes();
  const ObservationHistory history{
      .sensor = Sensor::kVisibility, .names = landmark_names(20), .values = seen};
  const Embedding map = HistoryEmbedder(history, 6).embed({Method::kLpca, std::nullopt});
  EXPECT_EQ(map.statuses.back().values, (std::vector<double>{15, 20}));
  EXPECT_EQ(map.statuses.back().names.size(), 15U);
}

TEST(HistoryEmbedder, RefusesStepsThatTheHistoryDoesNotHave) {
  const ObservationHistory history{.sensor = Sensor::kVisibility,
                                   .names = landmark_names(5),
                                   .values = Eigen::MatrixXd::Ones(5, 10)};
  for (const Eigen::Index steps : {-1, 0, 11}) {
    EXPECT_THROW(HistoryEmbedder(history, steps), InvalidInput) << steps;
    EXPECT_THROW(unseen_landmarks(history, steps), InvalidInput) << steps;
  }
}

TEST(HistoryEmbedder, FailsWithAStatusWhenNothingWasSeen) {
  ObservationHistory history{.sensor = Sensor::kVisibility,
                             .names = landmark_names(5),
                             .values = Eigen::MatrixXd::Zero(5, 10)};
  const Embedding map = HistoryEmbedder(history, 10).embed({Method::kIsomap, 3.0});
  EXPECT_TRUE(has(map, StatusCode::kFailed));
  EXPECT_EQ(map.coordinates.rows(), 5);
}

/// Landmarks seen in twos and threes in two rooms, the door between them shut.
ObservationHistory two_rooms(Eigen::Index landmarks_each) {
  const Eigen::Index n = landmarks_each;
  ObservationHistory history{.sensor = Sensor::kVisibility,
                             .names = landmark_names(static_cast<int>(2 * n)),
                             .values = Eigen::MatrixXd::Zero(2 * n, 2 * n)};
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index room = 0; room < 2; ++room) {
      const Eigen::Index step = room * n + i;
      for (Eigen::Index next = 0; next < 3; ++next)
        history.values(room * n + (i + next) % n, step) = 1.0;
    }
  return history;
}

TEST(HistoryEmbedder, ReportsNeighboursThatWereNeverSeenTogether) {
  const ObservationHistory history = two_rooms(8);
  HistoryEmbedder embedder(history, 16);
  for (const MethodInfo& method : all_methods()) {
    if (!on_graph(method.method)) continue;
    // Each landmark was seen together with four others.
    const Embedding map = embedder.embed({method.method, 6.0});
    const Status* few = status_for(map, StatusReason::kFewSeenTogether);
    ASSERT_NE(few, nullptr) << method.name;
    EXPECT_EQ(*few, status_of<StatusReason::kFewSeenTogether>(16, 6, 2)) << method.name;
    EXPECT_FALSE(has(embedder.embed({method.method, 4.0}), StatusCode::kArbitraryNeighbours))
        << method.name;
  }
}

TEST(HistoryEmbedder, ReportsForEveryMethodThatRoomsWereNeverSeenTogether) {
  for (const bool only : {false, true}) {
    EmbedderOptions options;
    options.only_seen_together = only;
    HistoryEmbedder embedder(two_rooms(8), 16, options);
    for (const MethodInfo& method : all_methods()) {
      const Embedding map = embedder.embed(embedder.usual_setting(method.method));
      // In addition, such even rooms leave other things undetermined.
      const Status* groups = status_for(map, StatusReason::kGroupsNeverTogether);
      EXPECT_TRUE((groups != nullptr && groups->values[0] == 2.0) || has(map, StatusCode::kFailed))
          << method.name;
    }
  }
}

TEST(HistoryEmbedder, ReportsThatOneScanOrTwoDetermineNoMap) {
  ObservationHistory history{.sensor = Sensor::kBearing,
                             .names = landmark_names(8),
                             .values = Eigen::MatrixXd::Zero(8, 3)};
  for (Eigen::Index i = 0; i < 8; ++i)
    for (Eigen::Index t = 0; t < 3; ++t)
      history.values(i, t) = std::sin(static_cast<double>(3 * i + 5 * t * i));
  for (const Eigen::Index steps : {1, 2, 3})
    EXPECT_EQ(has(HistoryEmbedder(history, steps).embed({Method::kLpca, std::nullopt}),
                  StatusCode::kTooFewObservations),
              steps < 3);
}

TEST(HistoryEmbedder, IsSilentWhereAllOthersAreNeighboursOrThereIsNoMap) {
  HistoryEmbedder embedder(two_rooms(8), 16);
  EXPECT_FALSE(has(embedder.embed({Method::kIsomap, 15.0}), StatusCode::kArbitraryNeighbours));
  // Hessian LLE needs six.
  const Embedding none = embedder.embed({Method::kHessianLle, 5.0});
  EXPECT_TRUE(has(none, StatusCode::kFailed));
  EXPECT_FALSE(has(none, StatusCode::kArbitraryNeighbours));
}

TEST(HistoryEmbedder, LeavesNeighboursNeverSeenTogetherOutOnRequest) {
  EmbedderOptions options;
  options.only_seen_together = true;
  HistoryEmbedder embedder(two_rooms(8), 16, options);
  const Embedding map = embedder.embed({Method::kIsomap, 6.0});
  EXPECT_FALSE(has(map, StatusCode::kArbitraryNeighbours));
  EXPECT_TRUE(has(map, StatusCode::kBridged));
}

}  // namespace
}  // namespace mapproof
