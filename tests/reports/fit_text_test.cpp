#include "reports/sections/fit_text.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "reports/sections/fit_section.hpp"

namespace mapproof {
namespace {

Fit late_fit() {
  return {.verdict = FitVerdict::kDoesNotFit,
          .causes = {{.code = FitCode::kTimeOffset,
                      .landmarks = {},
                      .values = {{.id = "offset_s", .value = 5.02, .sigma = 0.01}},
                      .statistic = 812.0,
                      .bound = 20.0,
                      .figure = "fit"}},
          .numbers = {{"fit_chi2_ratio", 3.5, 1.1},
                      {"fit_heading_sigma_rad", 6.04e-4},
                      {"fit_outliers_percent", 0.01487}},
          .tests = {{.code = FitCode::kTimeOffset, .statistic = 812.0, .bound = 20.0},
                    {.code = FitCode::kCommonOffset,
                     .statistic = 2.0,
                     .bound = 20.0,
                     .limit = FitValue{.id = "offset_m", .value = 0.31}}}};
}

TEST(FitSentences, NameVerdictAndCauseWithItsSize) {
  EXPECT_EQ(verdict_text(late_fit()),
            "The data do not fit the map: ranges are stamped 5.02\u00a0s late.");
  EXPECT_EQ(cause_text(late_fit().causes[0]),
            "Ranges are stamped 5.02\u00a0s late (statistic 812, bound 20.0).");
  EXPECT_EQ(verdict_text(Fit{.verdict = FitVerdict::kFits}), "The data fit the map.");
}

TEST(FitSentences, SayWhatIsMissingForATest) {
  const Fit fit{.verdict = FitVerdict::kNotTestable, .why = {FitMissing::kOdometry}};
  EXPECT_EQ(verdict_text(fit),
            "The fit cannot be tested: there is no odometry that ranges could be compared with.");
}

TEST(FitSentences, SayWhichEffectCouldNotBeSeen) {
  EXPECT_EQ(limit_text(late_fit().tests[1]),
            "An offset of all ranges below 0.31\u00a0m could not be seen in these data.");
  EXPECT_EQ(limit_text(late_fit().tests[0]), "");
}

TEST(FitSentences, NameEveryCodeInWords) {
  for (int i = 0; i <= static_cast<int>(FitCode::kDisconnected); ++i) {
    const auto code = static_cast<FitCode>(i);
    EXPECT_EQ(test_label(code, {"A", "B"}).find('_'), std::string::npos) << name(code);
    const std::string text = cause_text({.code = code, .landmarks = {"A", "B"}, .bound = 1.0});
    EXPECT_NE(text.substr(0, 2), " (") << name(code);
  }
}

TEST(FitFigure, GivesTheTestsOfGivenPositionsNamesThatDifferAndExplainsThem) {
  const Fit fit{
      .verdict = FitVerdict::kFits,
      .tests = {
          {.code = FitCode::kKnownLandmarksAtOdds, .statistic = 0.1, .bound = 0.8},
          {.code = FitCode::kKnownLandmarksAtOdds,
           .landmarks = {"a", "b", "c", "d"},
           .statistic = 0.2,
           .bound = 0.8},
          {.code = FitCode::kAnchorMissed, .statistic = 0.3, .bound = 1.0},
          {.code = FitCode::kAnchorMissed, .landmarks = {"a"}, .statistic = 0.4, .bound = 0.8},
          {.code = FitCode::kKnownLandmarkOff,
           .landmarks = {"a"},
           .statistic = 0.5,
           .bound = 8.0}}};
  const Figure figure = fit_figure(fit, "fit", {"map"});
  const std::vector<std::string>& names = figure.panels.at(0).y.names;
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), fit.tests.size());
  for (const char* explained :
       {"Misfit to given positions: ", "Misfit of an anchor: ", "Mean of the anchors: "})
    EXPECT_NE(figure.caption.find(explained), std::string::npos) << figure.caption;
  EXPECT_EQ(figure.caption.find("Misfit of an anchor: "),
            figure.caption.rfind("Misfit of an anchor: "));
}

TEST(FitSection, BeginsWithTheVerdictAndShowsItsFigure) {
  const Fit fit = late_fit();
  const Figure figure = fit_figure(fit, "fit", {"drive"});
  EXPECT_NE(figure.alt.find("time offset of ranges 41"), std::string::npos) << figure.alt;
  FigureBlock block;
  block.id = "fit";
  const Section section = fit_section(fit, {block});
  const auto& callout = std::get<Callout>(section.blocks.at(0));
  EXPECT_EQ(callout.title, "Verdict: does not fit");
  EXPECT_EQ(callout.tone, Callout::Tone::kWarning);
  const auto holds = [](const Block& block) { return std::holds_alternative<KeyValues>(block); };
  const auto found = std::ranges::find_if(section.blocks, holds);
  ASSERT_NE(found, section.blocks.end());
  const auto& numbers = std::get<KeyValues>(*found).items;
  EXPECT_EQ(numbers.at(0).value.text, "3.50 (bound 1.10)");
  EXPECT_EQ(numbers.at(1).key, "noise of the heading after 1 m [mrad]");
  EXPECT_EQ(numbers.at(1).value.text, "0.604");
  EXPECT_EQ(numbers.at(2).key, "estimated share of gross outliers [%]");
  EXPECT_EQ(numbers.at(2).value.text, "0.0149");
}

}  // namespace
}  // namespace mapproof
