#include <gtest/gtest.h>

#include "core/base/not_finite.hpp"
#include "core/map_fit/map_fit.hpp"
#include "core/pairs/pair_map.hpp"
#include "tests/core/association/noisy_scans.hpp"
#include "tests/core/association/real_scans.hpp"

namespace mapproof::test {
namespace {

Fit fit_of(const DetectionLog& log, const Points* known_m) {
  return range_bearing_fit(log, pair_map_of(log).embedding.coordinates, {.known_m = known_m});
}

/// The scans of some steps alone.
DetectionLog some_scans(DetectionLog log, const std::function<bool(int)>& is_taken) {
  std::erase_if(log.detections, [&](const Detection& seen) { return !is_taken(seen.step); });
  return log;
}

TEST(RealFit, SetsTwoAndThreeTheirRobotsAndTheirHalvesAreNotFoundWrong) {
  int logs = 0;
  int wrong = 0;
  for (const char* set : {"dataset2", "dataset3"}) {
    const std::optional<DetectionSource> source = real_scans(set);
    if (!source) GTEST_SKIP() << "MAPPROOF_MRCLAM does not name the folder of the sets";
    const DetectionLog& log = source->log;
    const double middle_s = middle_time_s(log);
    for (int robot = -1; robot < 5; ++robot)
      for (const int half : {0, 1, 2}) {
        const DetectionLog part = some_scans(log, [&](int step) {
          const auto k = static_cast<std::size_t>(step);
          return (robot < 0 || log.scans[k].robot == robot) &&
                 (half == 0 || (log.times_s[k] < middle_s) == (half == 1));
        });
        ++logs;
        wrong += fit_of(part, nullptr).verdict == FitVerdict::kDoesNotFit ? 1 : 0;
      }
    EXPECT_EQ(fit_of(log, nullptr).verdict, FitVerdict::kFits) << set;
    EXPECT_EQ(fit_of(log, &*source->ground_truth_m).verdict, FitVerdict::kFits) << set;
  }
  EXPECT_EQ(logs, 36);
  EXPECT_LE(wrong, 1);
}

TEST(RealFit, SetSixIsTwoPartsWhosePositionIsOpen) {
  const std::optional<DetectionSource> source = real_scans("dataset6");
  if (!source) GTEST_SKIP() << "MAPPROOF_MRCLAM does not name the folder of the sets";
  for (const Points* known_m : {static_cast<const Points*>(nullptr), &*source->ground_truth_m}) {
    const Fit fit = fit_of(source->log, known_m);
    EXPECT_TRUE(fit.verdict == FitVerdict::kUndetermined || fit.verdict == FitVerdict::kDoesNotFit);
    EXPECT_GE(fit.parts.size(), 2U);
  }
}

TEST(RealFit, SetOneNamesTheTwoLandmarksWhoseIdsAreExchanged) {
  const std::optional<DetectionSource> source = real_scans("dataset1");
  if (!source) GTEST_SKIP() << "MAPPROOF_MRCLAM does not name the folder of the sets";
  const Fit fit = fit_of(source->log, &*source->ground_truth_m);
  EXPECT_EQ(fit.verdict, FitVerdict::kDoesNotFit);
  ASSERT_FALSE(fit.causes.empty());
  EXPECT_EQ(fit.causes[0].code, FitCode::kKnownLandmarksExchanged);
  EXPECT_EQ(fit.causes[0].landmarks, (std::vector<std::string>{"11", "17"}));
}

}  // namespace
}  // namespace mapproof::test
