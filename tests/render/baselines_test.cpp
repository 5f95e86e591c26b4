#include "tests/support/baselines.hpp"

#include <filesystem>

#include <gtest/gtest.h>

#include "render/cairo/cairo_backend.hpp"
#include "render/plot/layout.hpp"
#include "tests/support/sample_figures.hpp"

namespace mapproof::test {
namespace {

class Baseline : public ::testing::TestWithParam<Figure> {};

TEST_P(Baseline, IsMatched) {
  const Figure& figure = GetParam();
  EXPECT_EQ(difference_from_baseline(figure.id, to_image(lay_out(figure, baseline_theme()))), "");
}

/// Those that differ most in what they show.
std::vector<Figure> chosen() {
  std::vector<Figure> figures = sample_figures();
  std::erase_if(figures, [](const Figure& figure) {
    for (const char* id :
         {"map-usual",           "map-one-far-off", "map-some-missing", "map-shape",
          "curve-usual",         "curve-log",       "curve-filled",     "measurement-visibility",
          "measurement-bearing", "parameter-usual", "ranks-10",         "ellipses-usual",
          "shepard-usual",       "spectrum-usual",  "film-four",        "pair-usual",
          "idea-visibility",     "anchors-usual",   "levels-usual",     "occlusion-usual",
          "pareto-usual",        "path-usual",      "path-walk",        "convergence-usual",
          "cost-usual",          "singular-usual",  "windows-usual",    "starts-usual",
          "wall-eleven"})
      if (figure.id == id) return false;
    return true;
  });
  return figures;
}

INSTANTIATE_TEST_SUITE_P(Of, Baseline, ::testing::ValuesIn(chosen()), [](const auto& one) {
  std::string text = one.param.id;
  std::ranges::replace(text, '-', '_');
  return text;
});

TEST(Baselines, AMissingOneIsAFailureThatLeavesACandidate) {
  const Image image{8, 8, std::vector<std::uint32_t>(64, 0xFFFFFF)};
  const std::string difference = difference_from_baseline("no-such-baseline", image);
  EXPECT_NE(difference.find("there is no baseline"), std::string::npos);
  const std::filesystem::path candidate =
      std::filesystem::path(MAPPROOF_VISUAL) / "no-such-baseline.png";
  EXPECT_TRUE(std::filesystem::exists(candidate));
  std::filesystem::remove(candidate);
}

}  // namespace
}  // namespace mapproof::test
