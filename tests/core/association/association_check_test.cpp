#include "core/association/association_check.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "noisy_scans.hpp"

namespace mapproof::test {
namespace {

TEST(AssociationCheck, FindsNothingInCleanScans) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const AssociationCheck check = check_association(noisy_scans(600, seed));
    EXPECT_TRUE(check.findings.empty()) << seed;
    EXPECT_FALSE(check.doubts.grave()) << seed;
  }
}

TEST(AssociationCheck, FindsAnIdSwapFromSomeStepOn) {
  const DetectionLog clean = noisy_scans(600, 1);
  for (const auto& [a, b] :
       {std::pair(0, 14), std::pair(2, 7), std::pair(6, 7), std::pair(3, 11)}) {
    const DetectionLog wrong = swapped(clean, a, b, [](int step) { return step >= 380; });
    const AssociationCheck check = check_association(wrong);
    ASSERT_FALSE(check.findings.empty()) << a << ' ' << b;
    for (const AssociationFinding& finding : check.findings)
      EXPECT_EQ(std::minmax(finding.first, finding.second), std::minmax(a, b));
    EXPECT_NEAR(check.findings.front().first_step, 380, 20);
    EXPECT_LT(check.loss_after_m, 0.75 * check.loss_before_m);
    EXPECT_LE(wrong_ids(check.repaired, clean), 4);
  }
}

TEST(AssociationCheck, FindsAStretchInTheMiddle) {
  const DetectionLog clean = noisy_scans(600, 2);
  const auto middle = [](int step) { return step >= 200 && step < 330; };
  const AssociationCheck check = check_association(swapped(clean, 4, 9, middle));
  ASSERT_EQ(check.findings.size(), 1U);
  EXPECT_NEAR(check.findings.front().first_step, 200, 25);
  EXPECT_NEAR(check.findings.front().last_step, 329, 25);
  EXPECT_LE(wrong_ids(check.repaired, clean), 6);
}

TEST(AssociationCheck, FindsSwapsOfSeveralPairs) {
  const DetectionLog clean = noisy_scans(900, 3);
  DetectionLog wrong = swapped(clean, 1, 12, [](int step) { return step >= 600; });
  wrong = swapped(wrong, 5, 8, [](int step) { return step < 300; });
  const AssociationCheck check = check_association(wrong);
  EXPECT_EQ(check.findings.size(), 2U);
  EXPECT_LE(wrong_ids(check.repaired, clean), 8);
}

TEST(AssociationCheck, FindsDetectionsUnderTheIdOfAnother) {
  const DetectionLog clean = noisy_scans(600, 4);
  for (const auto& [landmark, other] : {std::pair(13, 7), std::pair(0, 6)}) {
    const DetectionLog wrong = called(clean, landmark, other, [](int step) { return step < 150; });
    ASSERT_GT(wrong_ids(wrong, clean), 15);
    const AssociationCheck check = check_association(wrong);
    ASSERT_EQ(check.findings.size(), 1U);
    EXPECT_EQ(check.findings.front().first, other);
    EXPECT_EQ(check.findings.front().second, landmark);
    EXPECT_LE(wrong_ids(check.repaired, clean), 2);
  }
}

TEST(AssociationCheck, FindsIdSwapsInSingleScans) {
  const DetectionLog clean = noisy_scans(900, 8);
  for (const auto& [a, b] : {std::pair(0, 14), std::pair(3, 11)}) {
    const DetectionLog wrong = swapped(clean, a, b, [](int step) { return step % 5 < 2; });
    const AssociationCheck check = check_association(wrong);
    ASSERT_EQ(check.findings.size(), 1U) << a << ' ' << b;
    EXPECT_EQ(std::pair(check.findings[0].first, check.findings[0].second), std::pair(a, b));
    EXPECT_TRUE(check.findings[0].scattered);
    EXPECT_LE(wrong_ids(check.repaired, clean), wrong_ids(wrong, clean) / 20);
    EXPECT_FALSE(check.doubts.grave());
  }
}

TEST(AssociationCheck, FindsALandmarkCalledByAnothersNameInSingleScans) {
  const DetectionLog clean = noisy_scans(900, 9);
  const DetectionLog wrong = called(clean, 13, 7, [](int step) { return step % 3 == 0; });
  const AssociationCheck check = check_association(wrong);
  ASSERT_EQ(check.findings.size(), 1U);
  EXPECT_EQ(check.findings[0].fault, AssociationFault::kInPart);
  EXPECT_EQ(check.findings[0].first, 7);
  EXPECT_EQ(check.findings[0].second, 13);
  EXPECT_LE(wrong_ids(check.repaired, clean), wrong_ids(wrong, clean) / 20);
}

TEST(AssociationCheck, DoubtsScansThatFitNoMap) {
  // Three landmarks take turns under each other's IDs: no fault of two explains that.
  DetectionLog wrong = noisy_scans(600, 10);
  for (Detection& seen : wrong.detections)
    if (seen.landmark < 9 && seen.step % 2 == 0) seen.landmark = (seen.landmark + 3) % 9;
  wrong = swapped(wrong, 0, 1, [](int) { return false; });  // in order again
  AssociationCheckOptions options;
  options.most_findings = 1;
  const AssociationCheck check = check_association(wrong, options);
  EXPECT_TRUE(check.doubts.grave());
  EXPECT_FALSE(check.doubts.landmarks.empty());
}

TEST(AssociationCheck, CannotDetectASwapInAllDetections) {
  const DetectionLog renamed = swapped(noisy_scans(600, 5), 3, 10, [](int) { return true; });
  EXPECT_TRUE(check_association(renamed).findings.empty());
}

TEST(AssociationCheck, ReportsTheFewerDetectionsOfASwap) {
  const DetectionLog clean = noisy_scans(600, 6);
  const AssociationCheck check =
      check_association(swapped(clean, 2, 12, [](int step) { return step < 450; }));
  ASSERT_EQ(check.findings.size(), 1U);
  EXPECT_NEAR(check.findings.front().first_step, 450, 20);
  EXPECT_TRUE(check.findings.front().to_the_end);
}

TEST(AssociationCheck, DistinguishesOneRobotsScansFromTheOthers) {
  DetectionLog log = noisy_scans(900, 7);
  for (int step = 0; step < log.steps; ++step) log.times_s.push_back(step % 300);
  const DetectionLog wrong = swapped(log, 6, 8, [](int step) { return step >= 300 && step < 600; });
  const AssociationCheck check = check_association(wrong);
  ASSERT_EQ(check.findings.size(), 1U);
  EXPECT_FALSE(check.findings.front().by_time);
  EXPECT_LE(wrong_ids(check.repaired, log), 4);
}

TEST(AssociationCheck, AcceptsALogWithoutAnyPair) {
  EXPECT_TRUE(check_association({}).findings.empty());
  DetectionLog lonely{{"A", "B"}, {{0, 0, 1.0, 0.0}, {1, 1, 2.0, 0.0}}, 2, {}};
  EXPECT_TRUE(check_association(lonely).findings.empty());
  lonely.detections[1].landmark = 2;
  EXPECT_THROW(check_association(lonely), InvalidInput);
}

}  // namespace
}  // namespace mapproof::test
