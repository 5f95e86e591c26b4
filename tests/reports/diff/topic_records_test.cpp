#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/records/studies/topic_store.hpp"
#include "reports/diff/folder_diff.hpp"
#include "reports/diff/records/record_diff.hpp"
#include "reports/diff/records/record_set.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

TopicStudy two_runs() {
  TopicStudy study;
  study.experiment.name = "association";
  study.experiment.topic = "association";
  study.experiment.layouts = 2;
  study.design = {.setups = {{.id = "all", .title = "All"}},
                  .methods = {{.id = "joint", .label = "Joint"}},
                  .quantities = {known_quantity("mpe_m"),
                                 study_quantity("found", "found", "%", Better::kHigher)}};
  return study;
}

/// A study whose runs all came to these values.
void write_study(const std::filesystem::path& folder, double mpe_m, double found) {
  StudyWriter store = StudyWriter(folder, study_start(two_runs()));
  for (const int layout : {1, 2}) {
    TopicPart part;
    part.run = RunId{.layout = layout, .pose = 1};
    part.id = slug(*part.run);
    part.outcomes = {{.at = condition("all"),
                      .method = "joint",
                      .values = {{"mpe_m", mpe_m}, {"found", found}},
                      .statuses = {}}};
    store.write(part_of(part, ""));
  }
}

RecordDiff diff_of(double mpe_m, double found) {
  const test::TemporaryFolder folder;
  write_study(folder / "a", 0.1, 90.0);
  write_study(folder / "b", mpe_m, found);
  const RecordSets sets = read_records(folder / "a", folder / "b");
  return record_diff(sets.baseline, sets.current);
}

TEST(TopicRecords, OfEqualStudiesAreIdentical) {
  EXPECT_EQ(diff_of(0.1, 90.0).judgement.verdict, Verdict::kIdentical);
}

TEST(TopicRecords, AreWorseWhereAnErrorRoseOrAShareFell) {
  const RecordDiff error = diff_of(0.2, 90.0);
  EXPECT_EQ(error.judgement.verdict, Verdict::kWorse);
  EXPECT_NE(error.judgement.cause.find("MPE"), std::string::npos) << error.judgement.cause;
  const RecordDiff share = diff_of(0.1, 80.0);
  EXPECT_EQ(share.judgement.verdict, Verdict::kWorse);
  EXPECT_NE(share.judgement.cause.find("found"), std::string::npos) << share.judgement.cause;
}

TEST(TopicRecords, AreBetterWhereAnErrorFellOrAShareRose) {
  EXPECT_EQ(diff_of(0.05, 90.0).judgement.verdict, Verdict::kBetter);
  EXPECT_EQ(diff_of(0.1, 95.0).judgement.verdict, Verdict::kBetter);
}

TEST(TopicRecords, CompareWhatAStudyDeclaresUnderItsNameWithDirectionAndTest) {
  const RecordDiff share = diff_of(0.1, 80.0);
  ASSERT_EQ(share.comparisons.size(), 1U);
  EXPECT_EQ(share.comparisons[0].quantity, study_quantity("found", "found", "%", Better::kHigher));
  EXPECT_EQ(share.comparisons[0].subject, "all/joint");
  EXPECT_EQ(share.comparisons[0].outcome, Outcome::kWorse);
  EXPECT_NE(share.judgement.cause.find("found 90 \u2192 80 % over 2 runs of All, Joint"),
            std::string::npos)
      << share.judgement.cause;
}

TEST(TopicRecords, HaveTheTolerancesThatSettingsGiveDeclaredQuantities) {
  const test::TemporaryFolder folder;
  write_study(folder / "a", 0.1, 90.0);
  write_study(folder / "b", 0.1, 89.5);
  DiffSettings settings;
  settings.records.tolerances["found"] = {.absolute = 1.0, .relative = 0.0};
  EXPECT_EQ(folder_diff(folder / "a", folder / "b", settings).items.front().judgement.verdict,
            Verdict::kWithinTolerance);
  settings.records.tolerances["fond"] = {.absolute = 1.0, .relative = 0.0};
  EXPECT_THROW(folder_diff(folder / "a", folder / "b", settings), InvalidInput);
}

TEST(TopicRecords, ThatAreDamagedAreAProblemAndTheRestGoesOn) {
  const test::TemporaryFolder folder;
  write_study(folder / "a", 0.1, 90.0);
  write_study(folder / "b", 0.1, 90.0);
  folder.file("b/parts/layout-2-pose-1.json", "{");
  const RecordSet set = read_records(folder / "a", folder / "b").current;
  ASSERT_EQ(set.problems.size(), 1U);
  EXPECT_EQ(set.problems[0].file, "parts/layout-2-pose-1.json");
  EXPECT_EQ(set.values.at({"all/joint", "mpe_m"}).size(), 1U);
}

}  // namespace
}  // namespace mapproof
