#include <gtest/gtest.h>

#include <string>

#include "core/range_slam/refinement/refine.hpp"
#include "core/range_slam/refinement/refine_starts.hpp"
#include "tests/support/plaza.hpp"
#include "tests/support/slam_checks.hpp"

namespace mapproof {
namespace {

using test::mean_error_m;

class PlazaRefinement : public ::testing::TestWithParam<const char*> {};

TEST_P(PlazaRefinement, ComesWithinTwentyCentimetres) {
  const std::optional<RangeLog> found = test::plaza(GetParam());
  if (!found) GTEST_SKIP() << test::kNoPlaza;
  const RangeLog& log = *found;
  const bool is_first = std::string(GetParam()) == "plaza1";
  const SlamEstimate start = dead_reckoning_start(log);
  EXPECT_NEAR(mean_error_m(log, start, Alignment::kNone), is_first ? 15.92 : 27.03, 0.01);
  const SlamEstimate refined = refine(log, start);
  EXPECT_TRUE(refined.statuses.empty());
  EXPECT_LT(mean_error_m(log, refined, Alignment::kRigid), is_first ? 0.20 : 0.19);
  EXPECT_NEAR(refined.range_scale, is_first ? 1.065 : 1.067, 0.002);
  const SlamEstimate fixed = refine(log, start, {.estimate_scale = false});
  EXPECT_NEAR(mean_error_m(log, fixed, Alignment::kRigid), is_first ? 1.14 : 1.51, 0.02);
  const SlamEstimate random = refine(log, random_start(log, 1));
  EXPECT_NEAR(*random.cost, *refined.cost, 1e-3 * *refined.cost);
}

INSTANTIATE_TEST_SUITE_P(Both, PlazaRefinement, ::testing::Values("plaza1", "plaza2"));

}  // namespace
}  // namespace mapproof
