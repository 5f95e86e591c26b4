#include "core/association/scan_costs.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace mapproof::test {
namespace {

/// Three landmarks and a fourth one whose bearing is right and whose range is 2 m short.
struct ShortRange {
  Points map_m{{2.0, 0.0}, {0.0, 3.0}, {3.0, 3.0}, {8.0, 0.0}, {6.0, 1.5}};
  DetectionLog log{{"A", "B", "C", "D", "E"},
                   {{0, 0, 2.0, 0.0},
                    {0, 1, 3.0, std::numbers::pi / 2.0},
                    {0, 2, std::sqrt(18.0), std::numbers::pi / 4.0},
                    {0, 3, 6.0, 0.0}},
                   1,
                   {}};
};

TEST(ScanCosts, ARangeThatIsShortDoesNotMakeTheBearingWrong) {
  const ShortRange one;
  const IdentifiedScans scans = identified_scans(one.log, 10);
  ScanCosts costs(scans, one.map_m, 0.2);
  EXPECT_EQ(costs.take({0, 1, 2, 3}, 0, 3, 4), 4U);
  EXPECT_TRUE(costs.has_pose());
  // Along the ray alone: huber(2).
  EXPECT_NEAR(costs(3, 3), huber_cost(2.0, 0.2), 1e-12);
  // E is 1.5 m off the ray, and at that range: huber(1.5).
  EXPECT_NEAR(costs(3, 4), huber_cost(1.5, 0.2), 1e-12);
}

TEST(ScanCosts, ADetectionAloneHasNoEvidence) {
  const ShortRange one;
  const IdentifiedScans scans = identified_scans(one.log, 10);
  ScanCosts costs(scans, one.map_m, 0.2);
  costs.take({3, 4, 3, 4}, 0, 3, 4);
  EXPECT_FALSE(costs.determines());
  EXPECT_EQ(costs(3, 4), 0.0);
}

TEST(TurnedAsSeen, ReflectsAMapOfTheOppositeOrientation) {
  const ShortRange one;
  const IdentifiedScans scans = identified_scans(one.log, 10);
  Points mirrored = one.map_m;
  mirrored.col(0) *= -1.0;
  EXPECT_EQ(oriented_as_seen(scans, {0, 1, 2, 3}, mirrored), one.map_m);
  EXPECT_EQ(oriented_as_seen(scans, {0, 1, 2, 3}, one.map_m), one.map_m);
}

}  // namespace
}  // namespace mapproof::test
