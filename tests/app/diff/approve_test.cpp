#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/app/two_studies.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

TEST(ApproveCommand, TakesWhatIsNamedAndNothingElse) {
  const TwoStudies two;
  two.change_image();
  fs::remove(two.after + "/figures/pair-usual.png");
  EXPECT_EQ(mapproof({"approve", two.before, two.after}).exit_code, 2);
  EXPECT_EQ(mapproof({"approve", two.before, two.after, "map-usul"}).exit_code, 2);
  EXPECT_EQ(mapproof({"approve", two.before, two.after, "map-usual"}).exit_code, 0);
  EXPECT_EQ(read_file(two.before + "/figures/map-usual.png"),
            read_file(two.after + "/figures/map-usual.png"));
  EXPECT_TRUE(fs::exists(two.before + "/figures/pair-usual.png"));
  EXPECT_EQ(mapproof({"diff", two.before, two.after}).exit_code, 1);
  EXPECT_EQ(mapproof({"approve", two.before, two.after, "--all"}).exit_code, 0);
  EXPECT_EQ(mapproof({"diff", two.before, two.after}).exit_code, 0);
}

TEST(ApproveCommand, TakesAnIdThatIsCalledAsACommand) {
  const TwoStudies two;
  const Outcome outcome = mapproof({"approve", two.before, two.after, "map"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.error.find("\"map\""), std::string::npos) << outcome.error;
  EXPECT_EQ(outcome.error.find("OBSERVATIONS"), std::string::npos) << outcome.error;
}

TEST(ApproveCommand, TakesAFileOfApprovals) {
  const TwoStudies two;
  two.change_image();
  const fs::path approvals = two.folder.file(
      "a.json",
      R"({"schema": {"name": "mapproof.approvals", "version": 1}, "ids": ["map-usual"]})");
  EXPECT_EQ(mapproof({"approve", two.before, two.after, "--from", approvals}).exit_code, 0);
  EXPECT_EQ(mapproof({"diff", two.before, two.after}).exit_code, 0);
  const fs::path bad = two.folder.file(
      "b.json", R"({"schema": {"name": "mapproof.approvals", "version": 1}, "id": []})");
  EXPECT_EQ(mapproof({"approve", two.before, two.after, "--from", bad}).exit_code, 2);
  const fs::path none = two.folder.file(
      "c.json", R"({"schema": {"name": "mapproof.approvals", "version": 1}, "ids": []})");
  const Outcome outcome = mapproof({"approve", two.before, two.after, "--from", none});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.error.find("/ids: expected at least 1"), std::string::npos) << outcome.error;
}

TEST(ApproveCommand, NeverTakesWhatCannotBeRead) {
  const TwoStudies two;
  fs::resize_file(two.after + "/figures/map-usual.png", 100);
  const std::string before = read_file(two.before + "/figures/map-usual.png");
  EXPECT_EQ(mapproof({"approve", two.before, two.after, "map-usual"}).exit_code, 2);
  EXPECT_EQ(read_file(two.before + "/figures/map-usual.png"), before);
}

TEST(ApproveCommand, TakesAllThatCanBeTakenAndNamesTheRest) {
  const TwoStudies two;
  two.change_score();
  fs::resize_file(two.after + "/figures/map-usual.png", 100);
  fs::copy_file(two.after + "/figures/curve-usual.png", two.after + "/figures/another.png");
  const std::string before = read_file(two.before + "/figures/map-usual.png");
  const Outcome outcome = mapproof({"approve", two.before, two.after, "--all"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
  EXPECT_TRUE(outcome.error.starts_with("mapproof: ")) << outcome.error;
  EXPECT_NE(outcome.error.find("map-usual: not approved: "), std::string::npos) << outcome.error;
  EXPECT_EQ(read_file(two.before + "/figures/map-usual.png"), before);
  EXPECT_TRUE(fs::exists(two.before + "/figures/another.png"));
  EXPECT_EQ(read_file(two.before + "/runs/layout-1-pose-1.json"),
            read_file(two.after + "/runs/layout-1-pose-1.json"));
}

TEST(ApproveCommand, TakesAFolderInAFilesPlaceForNoAbsence) {
  for (const bool is_current : {true, false})
    for (const std::string name : {"figures/map-usual.png", "runs/layout-1-pose-1.json"}) {
      SCOPED_TRACE(name);
      const TwoStudies two;
      const std::string file = two.before + "/" + name, was = read_file(file);
      const std::string location = (is_current ? two.after : two.before) + "/" + name;
      fs::remove(location);
      write_file(location + "/inside.txt", "Not of mapproof.");
      EXPECT_EQ(mapproof({"diff", two.before, two.after}).exit_code, 1);
      const Outcome outcome = mapproof({"approve", two.before, two.after, "--all"});
      EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
      EXPECT_NE(outcome.error.find(location), std::string::npos) << outcome.error;
      EXPECT_TRUE(fs::exists(location + "/inside.txt"));
      if (is_current) {
        EXPECT_EQ(read_file(file), was);
      }
    }
}

TEST(ApproveCommand, NeverTakesRecordsThatCannotBeRead) {
  const TwoStudies two;
  fs::resize_file(two.after + "/runs/layout-1-pose-1.json", 100);
  const std::string before = read_file(two.before + "/runs/layout-1-pose-1.json");
  EXPECT_EQ(mapproof({"approve", two.before, two.after, "records"}).exit_code, 2);
  EXPECT_EQ(mapproof({"approve", two.before, two.after, "--all"}).exit_code, 1);
  EXPECT_EQ(read_file(two.before + "/runs/layout-1-pose-1.json"), before);
}

TEST(ApproveCommand, KeepsImagesOfAnotherRendererBesideTheOthers) {
  const TwoStudies two;
  two.change_image();
  EXPECT_EQ(mapproof({"approve", two.before, two.after, "map-usual", "--key", "../x"}).exit_code,
            2);
  EXPECT_EQ(
      mapproof({"approve", two.before, two.after, "map-usual", "--key", "cairo-1.18"}).exit_code,
      0);
  EXPECT_EQ(mapproof({"diff", two.before, two.after}).exit_code, 0);
  EXPECT_EQ(mapproof({"diff", two.before, two.before}).exit_code, 0);
  const std::string keyed = two.before + "/figures/map-usual@cairo-1.18.png";
  EXPECT_TRUE(fs::exists(keyed));
  EXPECT_EQ(mapproof({"approve", two.before, two.after, "curve-usual"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(keyed));
  EXPECT_EQ(mapproof({"approve", two.before, two.after, "--all"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(keyed)) << "it is of the image that was replaced";
}

TEST(ApproveCommand, MakesTheTableOfResultsAgainForRecordsThatItTakes) {
  const TemporaryFolder folder;
  const std::string experiment = std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json";
  const std::string before = folder / "before", after = folder / "after";
  ASSERT_EQ(mapproof({"run", experiment, "--out", before}).exit_code, 0);
  fs::copy(before, after, fs::copy_options::recursive);
  const std::string run = "/runs/layout-1-pose-1.json";
  std::string text = read_file(after + run);
  const std::string key = "\"mpe_m\": ";
  text.replace(text.find(key), key.size() + 3, key + "7.5");
  write_file(after + run, text);
  ASSERT_EQ(mapproof({"run", experiment, "--out", after}).exit_code, 0);
  ASSERT_EQ(mapproof({"report", after}).exit_code, 0);
  ASSERT_NE(read_file(before + "/results.csv"), read_file(after + "/results.csv"));
  const Outcome outcome = mapproof({"approve", before, after, "fig-3"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(read_file(before + run), text);
  EXPECT_EQ(read_file(before + "/results.csv"), read_file(after + "/results.csv"));
  EXPECT_NE(outcome.out.find("results.csv"), std::string::npos) << outcome.out;
  EXPECT_EQ(mapproof({"validate", before}).exit_code, 0);
  std::string table = read_file(before + "/results.csv");
  write_file(before + "/results.csv", table.replace(table.find("7.5"), 3, "7.6"));
  EXPECT_EQ(mapproof({"validate", before}).exit_code, 1) << "the table contradicts its records";
}

TEST(CheckCommand, FailsWithoutABaselineAndKeepsTheCandidate) {
  const TemporaryFolder folder;
  const std::string experiment = std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json";
  const std::string baseline = folder / "baseline", out = folder / "out";
  const Outcome first = mapproof({"check", experiment, "--baseline", baseline, "--out", out});
  EXPECT_EQ(first.exit_code, 1) << first.error;
  EXPECT_NE(first.error.find("there is no baseline"), std::string::npos) << first.error;
  EXPECT_TRUE(fs::exists(out + "/study.json"));
  EXPECT_FALSE(fs::exists(baseline));
  write_file(baseline + "/tables/of-yore.csv", "a,b\n1,2\n");
  write_file(baseline + "/notes.txt", "Not of mapproof.");
  EXPECT_EQ(mapproof({"approve", baseline, out, "--all", "--force"}).exit_code, 0);
  fs::remove(baseline + "/notes.txt");
  EXPECT_EQ(contents(baseline), contents(out)) << "nothing old is left, nothing new is missing";
  EXPECT_NE(mapproof({"diff", baseline, out}).out.find("passes: "), std::string::npos);
  const Outcome second =
      mapproof({"check", experiment, "--baseline", baseline, "--out", folder / "again"});
  EXPECT_EQ(second.exit_code, 0) << second.out << second.error;
  const Outcome other = mapproof(
      {"check", experiment, "--baseline", baseline, "--out", folder / "other", "--seed", "77"});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.out.find("\u2192 77: different seeds or true positions"), std::string::npos)
      << other.out;
}

TEST(CheckCommand, WritesWhatIsAskedForWithoutABaseline) {
  const TemporaryFolder folder;
  const std::string experiment = std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json";
  const std::string diff = folder / "diff";
  const Outcome outcome =
      mapproof({"check", experiment, "--baseline", folder / "none", "--out", folder / "out",
                "--allow", "new,missing", "--json", "--junit", diff + ".xml", "--markdown",
                diff + ".md", "--page", diff + ".html"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
  EXPECT_NE(read_file(diff + ".xml").find("failures=\"1\""), std::string::npos);
  EXPECT_NE(read_file(diff + ".md").find("there is no baseline"), std::string::npos);
  EXPECT_NE(outcome.out.find("\"passes\": false"), std::string::npos);
  EXPECT_TRUE(read_file(diff + ".html").starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(fs::exists(folder / "out/study.json"));
  EXPECT_FALSE(fs::exists(folder / "none"));
}

TEST(CheckCommand, NeverWritesTheCandidateOverTheBaseline) {
  const TwoStudies two;
  const std::string experiment = std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json";
  fs::create_directory_symlink(two.before, two.folder / "link");
  const auto before = contents(two.folder.path());
  for (const std::string& out :
       {two.before, two.before + "/", std::string(two.folder / "link"), two.before + "/new",
        std::string(two.folder / "link/new"), two.folder.path().string()}) {
    const Outcome outcome = mapproof({"check", experiment, "--baseline", two.before, "--out", out});
    EXPECT_EQ(outcome.exit_code, 2) << out;
    EXPECT_EQ(contents(two.folder.path()), before) << out;
  }
}

TEST(CheckCommand, PassesAgainstAStudyOfRecordsAlone) {
  const TemporaryFolder folder;
  const std::string experiment = std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json";
  const std::string baseline = folder / "baseline", out = folder / "out";
  ASSERT_EQ(mapproof({"run", experiment, "--out", baseline}).exit_code, 0);
  const Outcome outcome = mapproof({"check", experiment, "--baseline", baseline, "--out", out});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.error;
  EXPECT_NE(outcome.out.find("without figures, tables and report"), std::string::npos);
  EXPECT_EQ(mapproof({"diff", out, baseline}).exit_code, 1) << "what is drawn must stay";
}

}  // namespace
}  // namespace mapproof::test
