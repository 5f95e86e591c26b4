#include "core/association/anchor_ids.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/base/errors.hpp"
#include "noisy_scans.hpp"

namespace mapproof::test {
namespace {

bool always(int) { return true; }

/// The positions of some landmarks, in another frame than any map's.
Points known(const std::vector<Eigen::Index>& landmarks) {
  const Points ground_truth = noisy_landmarks();
  Points positions =
      Points::Constant(ground_truth.rows(), 2, std::numeric_limits<double>::quiet_NaN());
  const Eigen::Rotation2Dd turn(1.1);
  for (const Eigen::Index k : landmarks)
    positions.row(k) =
        (turn * ground_truth.row(k).transpose()).transpose() + Eigen::RowVector2d(7.0, -3.0);
  return positions;
}

const std::vector<Eigen::Index> kCorners = {0, 2, 12, 14};
const std::vector<Eigen::Index> kSix = {0, 2, 5, 9, 12, 14};

TEST(AnchorIds, FindsNothingWhereTheIdsAreRight) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    for (const auto& anchors : {kCorners, kSix}) {
      const AnchorCheck check = check_anchor_ids(noisy_scans(600, seed), known(anchors));
      EXPECT_TRUE(check.exchanges.empty()) << seed;
      EXPECT_EQ(check.positions, std::ssize(anchors));
      EXPECT_LT(check.misfit_before_m, 0.3);
    }
}

TEST(AnchorIds, FindsTwoAnchorsExchangedInAllDetections) {
  const DetectionLog clean = noisy_scans(600, 1);
  for (const auto& [a, b] : {std::pair(0, 2), std::pair(0, 14), std::pair(2, 12)}) {
    const AnchorCheck check = check_anchor_ids(swapped(clean, a, b, always), known(kCorners));
    ASSERT_EQ(check.exchanges.size(), 1U) << a << ' ' << b;
    EXPECT_EQ(std::minmax(check.exchanges[0].first, check.exchanges[0].second), std::minmax(a, b));
    EXPECT_LT(check.misfit_after_m, 0.2 * check.misfit_before_m);
    EXPECT_EQ(wrong_ids(check.repaired, clean), 0);
  }
}

TEST(AnchorIds, FindsAnAnchorExchangedWithAnyOtherLandmark) {
  const DetectionLog clean = noisy_scans(600, 2);
  for (const auto& [a, b] : {std::pair(0, 8), std::pair(12, 4), std::pair(9, 3)}) {
    const AnchorCheck check = check_anchor_ids(swapped(clean, a, b, always), known(kSix));
    ASSERT_EQ(check.exchanges.size(), 1U) << a << ' ' << b;
    EXPECT_EQ(check.exchanges[0].first, a);
    EXPECT_EQ(check.exchanges[0].second, b);
    EXPECT_EQ(wrong_ids(check.repaired, clean), 0);
  }
}

TEST(AnchorIds, FindsTwoExchangesAmongSixPositions) {
  const DetectionLog clean = noisy_scans(600, 3);
  const DetectionLog wrong = swapped(swapped(clean, 0, 9, always), 14, 7, always);
  const AnchorCheck check = check_anchor_ids(wrong, known(kSix));
  EXPECT_EQ(check.exchanges.size(), 2U);
  EXPECT_EQ(wrong_ids(check.repaired, clean), 0);
}

TEST(AnchorIds, FindsNothingWithFewerThanFourPositions) {
  const DetectionLog wrong = swapped(noisy_scans(600, 1), 0, 2, always);
  const AnchorCheck check = check_anchor_ids(wrong, known({0, 2, 12}));
  EXPECT_EQ(check.positions, 3);
  EXPECT_TRUE(check.exchanges.empty());
  EXPECT_EQ(wrong_ids(check.repaired, wrong), 0);
}

TEST(AnchorIds, DoesNotBlameIdsForAWrongSurvey) {
  Points positions = known(kSix);
  positions.row(5) += Eigen::RowVector2d(3.3, 0.9);
  EXPECT_TRUE(check_anchor_ids(noisy_scans(600, 1), positions).exchanges.empty());
}

TEST(AnchorIds, DoesNotBlameIdsForBearingsOfTheOtherSign) {
  DetectionLog mirrored = noisy_scans(600, 1);
  for (Detection& detection : mirrored.detections) detection.bearing_rad *= -1.0;
  for (const auto& anchors : {kCorners, kSix})
    EXPECT_TRUE(check_anchor_ids(mirrored, known(anchors)).exchanges.empty());
}

TEST(AnchorIds, AcceptsALogWithoutAMap) {
  EXPECT_TRUE(check_anchor_ids({}, Points(0, 2)).exchanges.empty());
  const DetectionLog lonely{{"A", "B"}, {{0, 0, 1.0, 0.0}, {1, 1, 2.0, 0.0}}, 2, {}};
  EXPECT_EQ(check_anchor_ids(lonely, Points::Zero(2, 2)).positions, 0);
  EXPECT_THROW(check_anchor_ids(lonely, Points::Zero(3, 2)), InvalidInput);
}

}  // namespace
}  // namespace mapproof::test
