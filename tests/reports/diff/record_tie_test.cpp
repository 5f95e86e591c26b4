#include <gtest/gtest.h>

#include "reports/diff/records/record_tie.hpp"

namespace mapproof {
namespace {

constexpr const char* kUnchanged = "its records did not change";

/// Two subjects in three layouts.
RecordSet two_subjects() {
  RecordSet set;
  set.kind = "mapproof.study";
  set.seed = "7";
  for (int layout = 1; layout <= 3; ++layout) {
    const std::string run = "layout-" + std::to_string(layout) + "-pose-1";
    set.runs.set(run, "layout-" + std::to_string(layout));
    for (const char* subject : {"bearing/lpca/100", "bearing/isomap-K6/100"})
      set.values[{subject, "mpe_m"}][run] = 1.0 + 0.1 * layout;
  }
  return set;
}

/// Of a figure that differs in a number.
FigureDiff figure_diff_of(bool other_records = false) {
  FigureLog log(false);
  log.change(ChangeKind::kData, "figure", "note", "1", "2");
  if (other_records) log.change(ChangeKind::kData, "figure", kRecordsWord, "a", "b");
  return log.take();
}

std::string cause_of(const RecordDiff& records, const FigureDiff& figure, const std::string& id) {
  return tied_judgement("fig", figure, judge(figure), {id}, {.records = {&records}}).cause;
}

TEST(RecordTie, StatesThatRecordsDidNotChangeOnlyWhereNoneDid) {
  const RecordSet before = two_subjects();
  const std::string lpca = "bearing/lpca/100 of 3 runs";
  const RecordDiff same = record_diff(before, before);
  EXPECT_NE(cause_of(same, figure_diff_of(), lpca).find(kUnchanged), std::string::npos);

  RecordSet after = before;
  after.values[{"bearing/isomap-K6/100", "mpe_m"}]["layout-1-pose-1"] = 3.0;
  const std::string elsewhere = cause_of(record_diff(before, after), figure_diff_of(), lpca);
  EXPECT_EQ(elsewhere.find(kUnchanged), std::string::npos) << elsewhere;
  EXPECT_NE(elsewhere.find("no score and no position of its records changed"), std::string::npos)
      << elsewhere;

  after = before;
  after.seed = "8";
  after.settings["/seed"] = "8";
  const std::string seeds = cause_of(record_diff(before, after), figure_diff_of(), lpca);
  EXPECT_NE(seeds.find("different seeds or true positions"), std::string::npos) << seeds;
  EXPECT_EQ(seeds.find("records"), std::string::npos) << seeds;

  // A change of its records is not a reason to mention the former ones.
  const std::string others = cause_of(same, figure_diff_of(true), lpca);
  EXPECT_NE(others.find("it shows other records, a \u2192 b"), std::string::npos) << others;
  EXPECT_EQ(others.find(kUnchanged), std::string::npos) << others;
}

TEST(RecordTie, FindsRecordsWithANameOtherThanTheirSubject) {
  RecordSet before = two_subjects();
  before.families["bearing/isomap-K6/100"] = {"bearing/isomap/100", "K = 6"};
  before.called["map"] = "bearing/isomap-K6/100";
  RecordSet after = before;
  after.values[{"bearing/isomap-K6/100", "mpe_m"}]["layout-1-pose-1"] = 3.0;
  const RecordDiff diff = record_diff(before, after);
  for (const char* id : {"bearing/isomap-K6/100", "bearing/isomap/100", "map"})
    EXPECT_EQ(tie(diff, id).comparisons.size(), 1U) << id;
  EXPECT_TRUE(tie(diff, "bearing/lpca/100").comparisons.empty());
}

TEST(RecordTie, NamesTheFileThatHoldsWhatAFigureShows) {
  RecordDiff records = record_diff(two_subjects(), two_subjects());
  records.others = {
      {.file = "space.json", .beyond = 2, .first = "/known/1", .baseline = "2", .current = "3"}};
  records.judgement.verdict = Verdict::kChanged;
  const std::string cause = cause_of(records, figure_diff_of(), "space");
  EXPECT_NE(cause.find("space.json: 2 numbers differ, the first at /known/1 2"), std::string::npos)
      << cause;
}

}  // namespace
}  // namespace mapproof
