#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/files/files.hpp"
#include "core/records/studies/results_table.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/studies/study_kind.hpp"
#include "core/studies/validate.hpp"
#include "core/topics/topic.hpp"
#include "core/topics/topics.hpp"
#include "tests/core/records/samples.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;
using test::contents;
using test::made_up_provenance;
using test::TemporaryFolder;

/// An experiment in the program that is made of no data from outside, in its shortest form.
struct ShortStudy {
  std::string name;
  std::string text;
};

void PrintTo(const ShortStudy& study, std::ostream* out) { *out << study.name; }

std::vector<ShortStudy> every_topic() {
  std::vector<ShortStudy> studies;
  for (const auto& entry : fs::directory_iterator(MAPPROOF_SOURCE_DIR "/experiments")) {
    const std::string text = read_file(entry.path());
    const StudyKind& kind = kind_of_experiment(text, entry.path().string());
    if (kind.needs_data == nullptr || !kind.needs_data(text, entry.path().string()))
      studies.push_back({entry.path().stem().string(), text});
  }
  std::ranges::sort(studies, {}, &ShortStudy::name);
  return studies;
}

class EveryTopic : public testing::TestWithParam<ShortStudy> {
 protected:
  StudyPlan plan(std::uint64_t seed = 5) const {
    return kind().plan(GetParam().text, GetParam().name,
                       {.profile = "quick",
                        .changes = {.seed = seed, .layouts = 2, .poses = 1},
                        .one_of_several = true});
  }

  const StudyKind& kind() const { return kind_of_experiment(GetParam().text, GetParam().name); }

  /// Makes what is missing. @return How far it came.
  Progress make(const StudyPlan& study, const fs::path& folder, int jobs) const {
    StudyWriter writer(folder, study.start(made_up_provenance()));
    Progress last;
    run_study(study, writer, jobs, [&](const Progress& progress) { last = progress; });
    write_results_table(folder);
    return last;
  }

  /// A copy of the whole study, which is made once.
  void copy_whole(const fs::path& to) const {
    static std::map<std::string, TemporaryFolder> made;
    const auto [whole, is_new] = made.try_emplace(GetParam().name);
    if (is_new) make(plan(), whole->second.path(), 2);
    fs::copy(whole->second.path(), to, fs::copy_options::recursive);
  }

  TemporaryFolder folder_;
};

/// All files below a folder that are JSON, but for study.json.
std::vector<fs::path> json_records(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".json" && entry.path().filename() != kStudyFile)
      files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

TEST_P(EveryTopic, EndsInTheSameBytesWhateverTheJobsTheOrderAndTheInterruptions) {
  const StudyPlan study = plan();
  copy_whole(folder_ / "one");
  const std::string whole = contents(folder_ / "one");

  StudyPlan backwards = study;
  std::ranges::reverse(backwards.tasks);
  const Progress first = make(backwards, folder_ / "two", 1);
  EXPECT_EQ(first.reused, 0);
  EXPECT_EQ(first.finished, first.total);
  EXPECT_TRUE(contents(folder_ / "two") == whole) << "jobs or order change bytes";

  // A record that is cut short, and one that is gone.
  const std::vector<fs::path> records = json_records(folder_ / "one");
  ASSERT_FALSE(records.empty());
  fs::resize_file(records.front(), fs::file_size(records.front()) / 2);
  if (records.size() > 1) fs::remove(records.back());
  fs::remove(folder_ / "one" / kResultsFile);
  const Progress again = make(study, folder_ / "one", 2);
  EXPECT_LT(again.reused, again.total);
  EXPECT_EQ(again.finished, again.total);
  EXPECT_TRUE(contents(folder_ / "one") == whole) << "resuming changes bytes";
  EXPECT_EQ(make(study, folder_ / "one", 1).reused, first.total) << "nothing was missing";
}

TEST_P(EveryTopic, IsReadAsOneTableOfResultsThatItsFileHolds) {
  copy_whole(folder_ / "study");
  const StudyContents read = read_study_contents(folder_ / "study", {});
  EXPECT_EQ(read.kind, kind().study);
  EXPECT_TRUE(read.problems.empty());
  ASSERT_FALSE(read.results.rows.empty());
  EXPECT_TRUE(std::ranges::is_sorted(read.results.rows, comes_before));
  for (const Result& row : read.results.rows) {
    EXPECT_NE(read.results.quantities.find(row.quantity), nullptr) << row.quantity;
    EXPECT_FALSE(row.method.empty());
    EXPECT_EQ(row.run.empty(), row.group.empty());
  }
  const std::string csv = read_file(folder_ / "study" / kResultsFile);
  EXPECT_EQ(csv, results_csv(read.results.rows));
  EXPECT_EQ(results_csv(parse_results_csv(csv, kResultsFile, read.results.quantities)), csv);
}

TEST_P(EveryTopic, IsValidAndADamagedFileIsNamed) {
  const fs::path study = folder_ / "study";
  copy_whole(study);
  for (const Finding& finding : validate(study)) EXPECT_EQ(finding.problem, "");
  for (const fs::path& record : json_records(study)) {
    const std::string whole = read_file(record);
    write_file(record, whole.substr(0, whole.size() / 2));
    bool is_named = false;
    for (const Finding& finding : validate(study))
      is_named |= finding.problem.find(record.filename().string()) != std::string::npos;
    EXPECT_TRUE(is_named) << record;
    write_file(record, whole);
  }
}

TEST_P(EveryTopic, OfAnotherSeedIsRefusedAndOfAnotherSolverTakenAway) {
  const fs::path study = folder_ / "study";
  copy_whole(study);
  const std::string whole = contents(study);
  EXPECT_NE(test::error_of([&] {
              StudyWriter(study, plan(6).start(made_up_provenance()));
            }).find("holds another experiment (/seed is 5 there and 6 here)"),
            std::string::npos);
  EXPECT_TRUE(contents(study) == whole) << "a refused folder was changed";
  const StudyWriter writer(study, plan().start(made_up_provenance("another")));
  EXPECT_EQ(writer.redone(), "another solver");
  EXPECT_TRUE(json_records(study).empty());
  EXPECT_FALSE(fs::exists(study / kResultsFile));
}

INSTANTIATE_TEST_SUITE_P(Topics, EveryTopic, testing::ValuesIn(every_topic()),
                         [](const auto& one) { return one.param.name; });

TEST(Topics, AreAllAmongTheExperimentsOfTheProgram) {
  std::size_t of_data = 0;
  for (const Topic* topic : all_topics()) of_data += topic->of_data ? 1 : 0;
  EXPECT_EQ(every_topic().size(), all_topics().size() - of_data + 2) << "and the two papers";
}

}  // namespace
}  // namespace mapproof
