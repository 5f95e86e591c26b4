#include "reports/sections/association_text.hpp"

#include <gtest/gtest.h>

namespace mapproof {
namespace {

DetectionLog ten_scans() { return {.names = {"A", "B", "C"}, .detections = {}, .steps = 10}; }

TEST(AssociationSentences, SayWhenAndHowOften) {
  const DetectionLog log = ten_scans();
  AssociationFinding finding{.fault = AssociationFault::kSwapped,
                             .first = 0,
                             .second = 2,
                             .first_step = 4,
                             .last_step = 9,
                             .to_the_end = true,
                             .detections = 6,
                             .loss_before_m = 0.41,
                             .loss_after_m = 0.13};
  EXPECT_EQ(described(finding, log),
            "IDs of A and C swapped from step 5 on (6 detections): loss 0.410 -> 0.130 m");
}

TEST(AssociationSentences, SayByHowMuchKnownPositionsWereMissed) {
  EXPECT_EQ(described(AnchorExchange{0, 2, 1.93, 0.12}, ten_scans()),
            "IDs of A and C swapped in all detections: known positions missed by 1.930 m, then by "
            "0.120 m");
}

}  // namespace
}  // namespace mapproof
