#include "app/study/folder_report.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace mapproof {
namespace {

/// Studies of one origin, with a number each.
std::vector<FolderReport> studies(StudyOrigin origin, int count) {
  std::vector<FolderReport> parts;
  for (int i = 0; i < count; ++i) {
    FolderReport part{.folder = fmt::format("study-{}", i), .origin = origin, .runs = 2};
    part.report.title = fmt::format("Study {}", i);
    part.report.opening.numbers.items.push_back(
        {.label = "MPE", .value = "0.1 m", .detail = fmt::format("of study {}", i)});
    parts.push_back(std::move(part));
  }
  return parts;
}

Report joined(const std::vector<FolderReport>& parts) {
  return joined_report("folder", parts).report;
}

TEST(JoinedReport, IsBeyondThePapersOnlyOfTopics) {
  std::vector<FolderReport> parts = studies(StudyOrigin::kTopic, 3);
  EXPECT_EQ(joined(parts).title, "Beyond the papers: studies side by side");
  parts.back().origin = StudyOrigin::kTable;
  EXPECT_EQ(joined(parts).title, "Studies side by side");
  parts.back().origin = StudyOrigin::kPaper;
  EXPECT_EQ(joined(parts).title, "Maps from what a robot observed");
}

TEST(JoinedReport, OfPapersHasTheLinesOfEachAfterItsName) {
  std::vector<FolderReport> parts = studies(StudyOrigin::kPaper, 2);
  for (FolderReport& part : parts) part.report.opening.compared_with = {{phrase(": theory.")}};
  std::string text;
  for (const Phrase& phrase : joined(parts).opening.compared_with.phrases) text += phrase.text;
  EXPECT_EQ(text, ", Study 0: theory. Study 1: theory.");
}

TEST(JoinedReport, CountsStudiesThatAimAtSomethingAlone) {
  std::vector<FolderReport> parts = studies(StudyOrigin::kTopic, 9);
  for (std::size_t i = 0; i < 4; ++i) parts[i].reached_aim = i != 2;
  const Highlights::Item first = joined(parts).opening.numbers.items.at(0);
  EXPECT_EQ(first.label, "studies gave the expected result");
  EXPECT_EQ(first.value, "3 of 4");
  EXPECT_EQ(first.detail, "not: Study 2; 5 studies have no expected result");
  EXPECT_TRUE(first.falls_short);
}

TEST(JoinedReport, NamesTheStudiesThatHaveWarnings) {
  std::vector<FolderReport> parts = studies(StudyOrigin::kTopic, 4);
  // What a finding says to readers is not what is named.
  for (FolderReport& part : parts)
    part.report.opening.wrong = {{phrase(": every map is as it should be.")}};
  const auto warnings = [&] { return joined(parts).opening.wrong.phrases.at(0).text; };
  EXPECT_EQ(warnings(), ": no run is missing.");
  parts[0].report.opening.warnings = {"no map of b: too few data", "one run is short"};
  parts[1].report.opening.warnings = {"2 of 9 maps have warnings"};
  parts[2].report.opening.warnings = {"the sensor does not win"};
  parts[2].reached_aim = false;
  EXPECT_EQ(warnings(),
            ": no run is missing. Not as expected: Study 2. To be looked at: Study 0 (no map of b "
            "and 1 more) and Study 1 (2 of 9 maps have warnings).");
}

TEST(JoinedReport, OfTablesWithoutAnAimHasTheirNumbersAlone) {
  for (const Highlights::Item& item : joined(studies(StudyOrigin::kTable, 9)).opening.numbers.items)
    EXPECT_EQ(item.label, "MPE");
}

}  // namespace
}  // namespace mapproof
