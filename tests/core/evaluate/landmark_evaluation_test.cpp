#include "core/evaluate/landmark_evaluation.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"

namespace mapproof {
namespace {

LandmarkPositions random_landmarks(Eigen::Index count, std::uint64_t seed) {
  Random random(seed);
  LandmarkPositions landmarks{.names = {}, .positions_m = Points(count, 2)};
  for (Eigen::Index i = 0; i < count; ++i) {
    landmarks.names.push_back(fmt::format("L{}", i));
    landmarks.positions_m.row(i) << random.uniform(0.0, 20.0), random.uniform(0.0, 10.0);
  }
  return landmarks;
}

Points moved(const Points& points, double angle, double scale = 1.0) {
  Eigen::Matrix2d R;
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return (scale * points * R.transpose()).rowwise() + Eigen::RowVector2d(5.0, -40.0);
}

TEST(LandmarkEvaluation, AKnownOffsetIsTheErrorOfEveryLandmark) {
  const LandmarkPositions ground_truth = random_landmarks(10, 1);
  LandmarkPositions map = ground_truth;
  map.positions_m.rowwise() += Eigen::RowVector2d(0.3, 0.4);
  const LandmarkEvaluation result =
      evaluate_landmarks(ground_truth, map, {.alignment = FrameAlignment::kNone});
  EXPECT_NEAR(result.error_m.maxCoeff(), 0.5, 1e-12);
  EXPECT_NEAR(result.error_m.minCoeff(), 0.5, 1e-12);
}

TEST(LandmarkEvaluation, CountsWhatTheMapLacksAndWhatDoesNotExist) {
  const LandmarkPositions ground_truth = random_landmarks(10, 2);
  LandmarkPositions map = random_landmarks(8, 2);
  map.names[7] = "ghost";
  const LandmarkEvaluation result = evaluate_landmarks(ground_truth, map, {});
  EXPECT_EQ(result.error_m.size(), 7);
  EXPECT_EQ(result.missed, 3);
  EXPECT_EQ(result.spurious, 1);
  EXPECT_LT(result.error_m.maxCoeff(), 1e-12);
}

TEST(LandmarkEvaluation, FindsLandmarksWithoutIdsUnderAnyMotion) {
  const LandmarkPositions ground_truth = random_landmarks(20, 3);
  for (const FrameAlignment alignment : {FrameAlignment::kRigid, FrameAlignment::kSimilarity}) {
    LandmarkPositions map = random_landmarks(20, 3);
    map.positions_m =
        moved(map.positions_m, 2.5, alignment == FrameAlignment::kSimilarity ? 0.2 : 1.0);
    // The last five are not seen, and the names are others.
    map.positions_m.conservativeResize(15, 2);
    map.names.resize(15);
    for (std::string& name : map.names) name = "m" + name;
    const LandmarkEvaluation result = evaluate_landmarks(
        ground_truth, map,
        {.association = LandmarkAssociation::kNearest, .alignment = alignment, .gate_m = 0.2});
    EXPECT_EQ(result.error_m.size(), 15);
    EXPECT_EQ(result.missed, 5);
    EXPECT_LT(result.error_m.maxCoeff(), 1e-9);
    EXPECT_EQ(result.names.front(), "L0");
  }
}

TEST(LandmarkEvaluation, OfAFewFarApartTheBestAlignmentIsFoundWithinAWideGate) {
  // A ring: within half the distance of neighbours, turned maps pair all six landmarks, too.
  LandmarkPositions ground_truth{.names = {"a", "b", "c", "d", "e", "f"},
                                 .positions_m = Points(6, 2)};
  ground_truth.positions_m << -24.0, -15.0, 2.0, -18.0, 25.0, -10.0, 22.0, 14.0, -3.0, 17.0, -25.0,
      12.0;
  LandmarkPositions map = ground_truth;
  map.positions_m << -24.01, -15.01, 2.01, -18.01, 25.03, -9.99, 22.0, 14.0, -3.0, 17.04, -25.0,
      12.01;
  const LandmarkEvaluation by_id = evaluate_landmarks(ground_truth, map, {});
  EXPECT_LT(by_id.error_m.maxCoeff(), 0.05);
  for (const double angle : {0.0, 1.0, 3.0}) {
    LandmarkPositions turned = map;
    turned.positions_m = moved(map.positions_m, angle);
    const LandmarkEvaluation result =
        evaluate_landmarks(ground_truth, turned, {.association = LandmarkAssociation::kNearest});
    ASSERT_EQ(result.error_m.size(), 6);
    EXPECT_NEAR(result.error_m.norm(), by_id.error_m.norm(), 1e-9);
  }
}

TEST(LandmarkEvaluation, NearestLandmarksAreOneToOne) {
  LandmarkPositions ground_truth{.names = {"a", "b"}, .positions_m = Points(2, 2)};
  ground_truth.positions_m << 0.0, 0.0, 1.0, 0.0;
  LandmarkPositions map{.names = {"p", "q", "r"}, .positions_m = Points(3, 2)};
  map.positions_m << 0.1, 0.0, 0.2, 0.0, 5.0, 5.0;
  const LandmarkEvaluation result =
      evaluate_landmarks(ground_truth, map,
                         {.association = LandmarkAssociation::kNearest,
                          .alignment = FrameAlignment::kNone,
                          .gate_m = 0.9});
  ASSERT_EQ(result.error_m.size(), 2);
  EXPECT_NEAR(result.error_m(0), 0.1, 1e-12);
  EXPECT_NEAR(result.error_m(1), 0.8, 1e-12);
  EXPECT_EQ(result.spurious, 1);
}

TEST(LandmarkEvaluation, MapsWithoutCommonIdsAreRefused) {
  const LandmarkPositions ground_truth = random_landmarks(5, 5);
  LandmarkPositions map = ground_truth;
  for (std::string& name : map.names) name += "x";
  EXPECT_THROW(evaluate_landmarks(ground_truth, map, {}), InvalidInput);
}

}  // namespace
}  // namespace mapproof
