#include "reports/sections/figures/line_findings.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace mapproof {
namespace {

/// Over x = 0, 1, …, each mean with an interval of that half-width.
ErrorLine line(const std::string& label, const std::vector<double>& means, double half) {
  ErrorLine line{.label = label, .key = "k"};
  for (std::size_t i = 0; i < means.size(); ++i) {
    line.x.push_back(static_cast<double>(i));
    line.mean.push_back(means[i]);
    line.low.push_back(means[i] - half);
    line.high.push_back(means[i] + half);
  }
  return line;
}

TEST(ChangeFinding, NamesTheLeastAndTheGreatestChange) {
  const std::vector<ErrorLine> lines = {line("LEM, K = 7", {0.4, 0.3, 0.4}, 0.01),
                                        line("ISOMAP, K = 9", {0.1, 0.2, 0.3}, 0.01),
                                        line("LLE, K = 8", {0.1, 0.1, 0.2}, 0.01)};
  EXPECT_EQ(change_finding(lines, {}, "at 40°", "at 0°"),
            "at 40°, the MPE is 1.0 times (LEM, 0.400\u00A0m) to 3.0 times (ISOMAP, "
            "0.300\u00A0m) that at 0°");
}

TEST(ChangeFinding, StatesThatIntervalsOverlap) {
  const std::vector<ErrorLine> lines = {line("LEM", {0.4, 0.3}, 0.1), line("LLE", {0.4, 0.5}, 0.1)};
  EXPECT_TRUE(change_finding(lines, {}, "b", "a").ends_with(" that a; the intervals overlap"));
}

TEST(ChangeFinding, NeedsTwoLinesWithBothEnds) {
  const ErrorLine known = line("LEM", {0.4, 0.3}, 0.1);
  EXPECT_EQ(change_finding({known, line("LLE", {NAN, 0.3}, 0.1)}, {}, "b", "a"), "");
  EXPECT_EQ(change_finding({known, line("LLE", {0.0, 0.3}, 0.1)}, {}, "b", "a"), "");
  EXPECT_EQ(change_finding({}, {}, "b", "a"), "");
}

TEST(DependenceFinding, ComparesTheWorstWithTheBestValueOfEachMethod) {
  const std::vector<ErrorLine> lines = {line("SDE", {0.2, 0.1, 0.4}, 0.01),
                                        line("LLE", {0.3, NAN, 0.2}, 0.01)};
  EXPECT_EQ(dependence_finding(lines, {}, "K", true),
            "the best K is 1 to 2 by method; the MPE depends on it least with LLE (worst 1.5 times "
            "the best), most with SDE (4.0 times)");
  EXPECT_TRUE(dependence_finding(lines, {"MOE", "%"}, "K", false)
                  .starts_with("the MOE depends on K least with LLE"));
  EXPECT_EQ(dependence_finding({lines[0]}, {}, "K", true), "");
}

TEST(PlacementFinding, IsOfOnePlacementThatIsWorstForAllMethods) {
  std::vector<AnchorPanel> panels = {
      {"SDE, K = 7", {line("walls", {9.0, 0.1}, 0.01), line("cluster", {1.0, 0.2}, 0.01)}},
      {"LLE, K = 8", {line("walls", {9.0, 0.1}, 0.01), line("cluster", {1.0, 0.3}, 0.01)}}};
  EXPECT_EQ(placement_finding(panels),
            "with 1 anchor, every method has its highest MPE with placement \u201ccluster\u201d, "
            "2.0 to 3.0 times its lowest");
  panels[1].placements[0].mean.back() = 0.9;
  EXPECT_EQ(placement_finding(panels), "");
  panels[1].placements[0].mean.back() = NAN;
  EXPECT_EQ(placement_finding(panels), "");
  EXPECT_EQ(placement_finding({}), "");
}

}  // namespace
}  // namespace mapproof
