#include "tests/support/images/baselines.hpp"

#include <filesystem>

#include <gtest/gtest.h>

#include "render/cairo/cairo_backend.hpp"
#include "render/plot/layout.hpp"
#include "tests/support/samples/sample_figures.hpp"

namespace mapproof::test {
namespace {

class Baseline : public ::testing::TestWithParam<Figure> {};

TEST_P(Baseline, IsMatched) {
  const Figure& figure = GetParam();
  EXPECT_EQ(difference_from_baseline(figure.id, to_image(lay_out(figure, baseline_theme()))), "");
}

INSTANTIATE_TEST_SUITE_P(Of, Baseline, ::testing::ValuesIn(baseline_figures()),
                         [](const auto& one) {
                           std::string text = one.param.id;
                           std::ranges::replace(text, '-', '_');
                           return text;
                         });

TEST(Baselines, AMissingOneIsAFailureThatLeavesACandidate) {
  const Image image{8, 8, std::vector<std::uint32_t>(64, 0xFFFFFF)};
  const std::string difference = difference_from_baseline("no-such-baseline", image);
  EXPECT_NE(difference.find("there is no baseline"), std::string::npos);
  const std::filesystem::path candidate =
      std::filesystem::path(MAPPROOF_VISUAL) / "differing/no-such-baseline.png";
  EXPECT_TRUE(std::filesystem::exists(candidate));
  std::filesystem::remove(candidate);
}

}  // namespace
}  // namespace mapproof::test
