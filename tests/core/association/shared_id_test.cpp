#include "core/association/shared_id.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/pairs/pair_map.hpp"
#include "noisy_scans.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof::test {
namespace {

bool in_every_scan(int) { return true; }

TEST(SharedId, IsThatOfALandmarkCalledByAnothersNameThroughout) {
  for (const auto& [landmark, other] : {std::pair(0, 14), std::pair(7, 2), std::pair(12, 4)}) {
    const DetectionLog wrong = called(noisy_scans(1500, 3), landmark, other, in_every_scan);
    const auto shared = shared_id(wrong);
    ASSERT_TRUE(shared.has_value()) << landmark << " called " << other;
    EXPECT_EQ(shared->id, other);
    const double apart_m = (noisy_landmarks().row(landmark) - noisy_landmarks().row(other)).norm();
    EXPECT_NEAR(shared->apart_m, apart_m, 0.3);
    EXPECT_LT(shared->loss_after_m, 0.87 * shared->loss_before_m);
  }
}

TEST(SharedId, SplitGivesTheMapOfBoth) {
  const DetectionLog wrong = called(noisy_scans(1500, 4), 7, 2, in_every_scan);
  const auto shared = shared_id(wrong);
  ASSERT_TRUE(shared.has_value());
  const DetectionLog split = split_id(wrong, *shared, 7);
  Points map = pair_map_of(split).embedding.coordinates;
  // The scans do not determine which of both positions is whose.
  Points other = map;
  other.row(2).swap(other.row(7));
  EXPECT_LT(
      std::min(procrustes_gap(noisy_landmarks(), map), procrustes_gap(noisy_landmarks(), other)),
      0.15);
}

TEST(SharedId, IsNoneWhereEachIdIsOneLandmarks) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5})
    EXPECT_FALSE(shared_id(noisy_scans(1500, seed)).has_value());
}

TEST(SharedId, IsNoneOfALogWithoutScansOfThree) {
  DetectionLog log{.names = {"a", "b", "c"}};
  EXPECT_FALSE(shared_id(log).has_value());
  log.detections = {{0, 0, 1.0, 0.0}, {0, 1, 2.0, 0.5}, {1, 2, 1.0, 0.0}};
  log.steps = 2;
  EXPECT_FALSE(shared_id(log).has_value());
}

}  // namespace
}  // namespace mapproof::test
