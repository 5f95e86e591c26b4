#include "render/figures/status_text.hpp"

#include <cmath>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/files/files.hpp"

namespace mapproof {
namespace {

/// A status for a reason that holds what its place in the table asks for.
Status full(const StatusReasonInfo& reason) {
  Status status{.code = reason.code, .reason = reason.reason};
  for (std::size_t i = 0; i < reason.value_count(); ++i)
    status.values.push_back(11.0 + static_cast<double>(i));
  if (reason.names != StatusNames::kNone) status.names = {"oak"};
  return status;
}

TEST(StatusReasons, StandInTheOrderOfTheirEnumerators) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kStatusReasons.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(kStatusReasons[i].reason), i);
    EXPECT_TRUE(names.insert(kStatusReasons[i].name).second) << kStatusReasons[i].name;
    EXPECT_EQ(kStatusReasons[i].name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"),
              std::string_view::npos);
  }
  EXPECT_EQ(kStatusReasons.back().reason, StatusReason::kMessage);
}

TEST(StatusReasons, AreInTheManualWithTheirValues) {
  const std::string manual =
      read_file(std::string(MAPPROOF_SOURCE_DIR) + "/docs/methods/warnings.md");
  for (const StatusReasonInfo& reason : kStatusReasons) {
    std::string values(reason.values);
    for (std::size_t at = 0; (at = values.find(", ", at)) != std::string::npos; at += 4)
      values.replace(at, 2, "`, `");
    const std::string row = fmt::format("| `{}` | `{}` | {} |", reason.name, name(reason.code),
                                        values.empty() ? "" : "`" + values + "`");
    EXPECT_NE(manual.find(row), std::string::npos) << row;
  }
}

TEST(StatusReasons, HaveASentenceThatEndsAndTellsItsNames) {
  for (const StatusReasonInfo& reason : kStatusReasons) {
    if (reason.reason == StatusReason::kMessage) continue;
    const std::string words = status_text(full(reason));
    EXPECT_TRUE(words.ends_with('.')) << reason.name << ": " << words;
    EXPECT_EQ(words.find("oak") != std::string::npos, reason.names != StatusNames::kNone) << words;
  }
}

/// The words distinguish a plane from space, and four dimensions from five.
TEST(StatusReasons, HaveASentenceThatTellsEveryValue) {
  for (const StatusReasonInfo& reason : kStatusReasons)
    for (std::size_t i = 0; i < reason.value_count(); ++i) {
      Status status = full(reason);
      const std::string before = status_text(status);
      std::set<std::string> all = {before};
      for (const double value : {1.0, 2.0, 4.0}) {
        status.values[i] = value;
        all.insert(status_text(status));
      }
      EXPECT_GT(all.size(), 1U) << reason.name << ": value " << i << " of " << before;
      status.values.pop_back();
      EXPECT_THROW(status_text(status), std::out_of_range) << reason.name;
    }
}

TEST(StatusReasons, NameAnInfiniteConditionNumberInWords) {
  EXPECT_EQ(status_text(status_of<StatusReason::kLandmarksNearlyOnALine>(INFINITY)),
            "The landmarks lie nearly on one line, infinite condition number: on which side of it "
            "the robot was is hardly determined.");
  for (const StatusReasonInfo& reason : kStatusReasons) {
    if (reason.values.find("condition") == std::string_view::npos) continue;
    Status status = full(reason);
    status.values.back() = INFINITY;
    EXPECT_EQ(status_text(status).find("inf,"), std::string::npos) << status_text(status);
    EXPECT_EQ(status_text(status).find("inf."), std::string::npos) << status_text(status);
  }
}

TEST(StatusWords, BeginWithThePartThatTheyAreOf) {
  Status status = status_of<StatusReason::kStressFalling>(300);
  EXPECT_EQ(status_text(status), "The stress still fell after 300 iterations.");
  status.starts = {Method::kLpca};
  status.submaps = SubmapCount{.count = 2, .submaps = 7};
  EXPECT_EQ(status_text(status),
            "2 of 7 sub-maps: Its start, LPCA: The stress still fell after 300 iterations.");
}

TEST(StatusWords, NameTenLandmarksAndCountTheRest) {
  std::vector<std::string> names;
  for (int i = 1; i <= 15; ++i) names.push_back(fmt::format("L{}", i));
  EXPECT_TRUE(status_text(status_of<StatusReason::kNeverObserved>(names, 15, 20))
                  .ends_with("L9, L10 and 5 more."));
}

TEST(StatusWords, CountOneThingAsOne) {
  EXPECT_EQ(status_text(status_of<StatusReason::kFewSeenTogether>(1, 6, 1)),
            "1 landmark has fewer than K = 6 others ever seen together with it; the rest of the K "
            "are arbitrary.");
  EXPECT_EQ(status_text(status_of<StatusReason::kNoCommonStep>(1)),
            "1 pair of landmarks has no step in common; its distance is the shortest path over the "
            "others.");
  EXPECT_EQ(status_text(status_of<StatusReason::kFewSteps>(1, 3)),
            "1 observation used, a map needs 3 at least to mean anything.");
}

TEST(StatusWords, OfAMessageAreTheMessage) {
  EXPECT_EQ(status_text(status_with_message(StatusCode::kFailed, "ranges are not ascending")),
            "ranges are not ascending");
}

}  // namespace
}  // namespace mapproof
