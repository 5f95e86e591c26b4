#include <algorithm>

#include <gtest/gtest.h>

#include "core/association/anchor_ids.hpp"
#include "core/association/association_check.hpp"
#include "core/association/shared_id.hpp"
#include "noisy_scans.hpp"
#include "real_scans.hpp"

namespace mapproof::test {
namespace {

/// A set of MRCLAM, if the folder is there.
class RealIds : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    std::optional<DetectionSource> source = real_scans(GetParam());
    if (!source) GTEST_SKIP() << "MAPPROOF_MRCLAM does not name the folder of the sets";
    source_ = std::move(*source);
  }
  const DetectionLog& log() const { return source_.log; }

  DetectionSource source_;
};

TEST_P(RealIds, SwappedInTheSecondHalfAreNamedAndCorrected) {
  const double middle = middle_time_s(log());
  const auto later = [&](int step) {
    return log().times_s[static_cast<std::size_t>(step)] >= middle;
  };
  for (const auto& [a, b] : {std::pair(1, 7), std::pair(2, 8)}) {
    const DetectionLog wrong = swapped(log(), a, b, later);
    const int spoilt = wrong_ids(wrong, log());
    const AssociationCheck check = check_association(wrong);
    ASSERT_FALSE(check.findings.empty()) << a << ' ' << b;
    EXPECT_EQ(check.findings[0].first, a);
    EXPECT_EQ(check.findings[0].second, b);
    EXPECT_LT(check.loss_after_m, 0.75 * check.loss_before_m);
    // Which half has the right names is determined by the survey alone.
    const DetectionLog corrected =
        check_anchor_ids(check.repaired, *source_.ground_truth_m).repaired;
    EXPECT_LT(wrong_ids(corrected, log()), spoilt / 10);
  }
}

TEST_P(RealIds, RaiseNoDoubtAsTheyAre) {
  const AssociationCheck check = check_association(log());
  EXPECT_TRUE(check.findings.empty());
  EXPECT_FALSE(check.doubts.grave());
  EXPECT_EQ(wrong_ids(check.repaired, log()), 0);
}

/// A map of a fault that was corrected must be as good as without it.
void expect_corrected(const DetectionSource& source, const char* kind, int a, int b) {
  const DetectionLog wrong = with_fault(source.log, kind, a, b, 7);
  const double sound_m = map_error_m(source.log, *source.ground_truth_m);
  const AssociationCheck check = check_association(wrong);
  ASSERT_EQ(check.findings.size(), 1U) << kind << ' ' << a << ' ' << b;
  const AssociationFinding& finding = check.findings[0];
  EXPECT_EQ(std::minmax(finding.first, finding.second), std::minmax(a, b));
  const DetectionLog corrected = check_anchor_ids(check.repaired, *source.ground_truth_m).repaired;
  EXPECT_LT(map_error_m(corrected, *source.ground_truth_m), 1.2 * sound_m)
      << kind << ' ' << a << ' ' << b;
}

TEST_P(RealIds, SwappedInHalfOfTheScansAreCorrected) {
  expect_corrected(source_, "half", 4, 12);
  expect_corrected(source_, "half", 1, 6);
}

TEST_P(RealIds, OfOneLandmarkUnderTheNameOfAnotherAreCorrected) {
  expect_corrected(source_, "replaced30", 12, 4);
}

TEST_P(RealIds, SwappedForAThirdOfTheTimeAreCorrectedAtOnce) {
  expect_corrected(source_, "stretch", 4, 12);
}

TEST_P(RealIds, OfALandmarkThatIsNeverCalledByItsOwnNameAreFound) {
  EXPECT_FALSE(shared_id(log()).has_value());
  std::vector<double> errors_m;
  for (const auto& [a, b] : {std::pair(10, 6), std::pair(2, 9), std::pair(13, 3)}) {
    DetectionLog wrong = called(log(), a, b, [](int) { return true; });
    std::erase_if(wrong.detections, [&, own = a](const Detection& seen) {
      return seen.landmark == own;  // In scans that show both.
    });
    const auto shared = shared_id(wrong);
    ASSERT_TRUE(shared.has_value()) << a << ' ' << b;
    EXPECT_EQ(shared->id, b);
    const DetectionLog split = split_id(wrong, *shared, a);
    const DetectionLog corrected = check_anchor_ids(split, *source_.ground_truth_m).repaired;
    // Without its own name a landmark is in no map: its position is gained as well.
    const double error_m = map_error_m(corrected, *source_.ground_truth_m);
    errors_m.push_back(error_m);
  }
  std::ranges::sort(errors_m);
  EXPECT_LT(errors_m[1], 0.3);  // Of three faults; one may leave too little evidence.
}

TEST_P(RealIds, AreNotExchangedByTheSurvey) {
  const AnchorCheck check = check_anchor_ids(log(), *source_.ground_truth_m);
  EXPECT_EQ(check.positions, 15);
  EXPECT_TRUE(check.exchanges.empty());
  EXPECT_LT(check.misfit_before_m, 0.15);
}

TEST_P(RealIds, ExchangedThroughoutAreNamedByTheSurvey) {
  const auto always = [](int) { return true; };
  int named = 0;
  for (int a = 0; a < 15; ++a)
    for (int b = a + 1; b < 15; ++b) {
      const AnchorCheck check =
          check_anchor_ids(swapped(log(), a, b, always), *source_.ground_truth_m);
      const bool right = check.exchanges.size() == 1 && check.exchanges[0].first == a &&
                         check.exchanges[0].second == b;
      if (!right) ADD_FAILURE() << log().names[a] << ' ' << log().names[b];
      named += right ? 1 : 0;
    }
  EXPECT_EQ(named, 105);
}

INSTANTIATE_TEST_SUITE_P(Mrclam, RealIds, testing::Values("dataset2", "dataset3"));

}  // namespace
}  // namespace mapproof::test
