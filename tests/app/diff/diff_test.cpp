#include <sys/stat.h>

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/app/two_studies.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

using nlohmann::json;

TEST(DiffCommand, PassesAStudyAndItsCopy) {
  const TwoStudies two;
  const Outcome outcome = mapproof({"diff", two.before, two.after});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.error;
  EXPECT_NE(outcome.out.find("passes: 4 identical"), std::string::npos) << outcome.out;
}

TEST(DiffCommand, FailsWhatDiffersUnlessItIsAllowed) {
  const TwoStudies two;
  two.change_image();
  two.change_score();
  const Outcome outcome = mapproof({"diff", two.before, two.after});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("map-usual: png, by its pixels alone"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("records: MPE "), std::string::npos) << outcome.out;
  EXPECT_EQ(mapproof({"diff", two.before, two.after, "--allow", "style"}).exit_code, 1);
  EXPECT_EQ(mapproof({"diff", two.before, two.after, "--allow", "changed,worse"}).exit_code, 0);
}

TEST(DiffCommand, QuietTellsOfWhatDoesNotPassAlone) {
  const TwoStudies two;
  // Where ctest runs it, its measurements are printed all the same.
  EXPECT_EQ(mapproof({"diff", two.before, two.after, "--quiet"}).out.find("passes"),
            std::string::npos);
  two.change_score();
  const Outcome outcome = mapproof({"diff", two.before, two.after, "--quiet"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("does not pass"), std::string::npos) << outcome.out;
}

TEST(DiffCommand, WritesWhatIsAskedFor) {
  const TwoStudies two;
  two.change_image();
  const std::string out = two.folder / "diff";
  const Outcome outcome = mapproof({"diff", two.before, two.after, "--json", "--junit",
                                    out + ".xml", "--markdown", out + ".md"});
  EXPECT_EQ(outcome.exit_code, 1);
  const json found = json::parse(outcome.out);
  EXPECT_EQ(found["schema"]["name"], "mapproof.diff");
  EXPECT_EQ(found["items"][0]["id"], "map-usual");
  EXPECT_NE(read_file(out + ".xml").find("failures=\"1\""), std::string::npos);
  EXPECT_NE(read_file(out + ".md").find("map-usual"), std::string::npos);
}

TEST(DiffCommand, WritesOneOfItsOutputsToStandardOutput) {
  const TwoStudies two;
  two.change_image();
  for (const auto& [option, begin] : {std::pair{"--junit", "<?xml"},
                                      {"--markdown", "### mapproof diff"},
                                      {"--page", "<!DOCTYPE html>"}}) {
    const Outcome outcome = mapproof({"diff", two.before, two.after, option, "-"});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
    EXPECT_TRUE(outcome.out.starts_with(begin)) << outcome.out.substr(0, 100);
    EXPECT_FALSE(fs::exists("-"));
  }
  EXPECT_EQ(mapproof({"diff", two.before, two.after, "--json", "--junit", "-"}).exit_code, 2);
}

TEST(DiffCommand, NeverReplacesWhatItCompares) {
  const TwoStudies two;
  const auto before = contents(two.before);
  fs::create_directory_symlink(two.before, two.folder / "link");
  const std::string image = two.after + "/figures/map-usual.png";
  for (const auto& [option, location] :
       {std::pair<std::string, std::string>{"--junit", two.before + "/study.json"},
        {"--junit", two.folder / "link/study.json"},
        {"--page", image},
        {"--page", two.after + "/report.html"},
        {"--markdown", two.after + "/figures/new.svg"},
        {"--junit", two.before + "/runs/layout-1-pose-1.json"}}) {
    const Outcome outcome = mapproof({"diff", two.before, two.after, option, location});
    EXPECT_EQ(outcome.exit_code, 2) << option << " " << location;
    EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  }
  EXPECT_EQ(contents(two.before), before);
  EXPECT_EQ(mapproof({"diff", image, image, "--page", image}).exit_code, 2);
  const std::string one = two.folder / "one";
  EXPECT_EQ(mapproof({"diff", image, image, "--page", one, "--junit", one}).exit_code, 2);
  for (int run = 0; run < 2; ++run)  // Its own outputs may stand there.
    EXPECT_EQ(mapproof({"diff", two.before, two.after, "--page", two.after + "/diff.html",
                        "--junit", two.after + "/diff.xml", "--markdown", two.after + "/diff.md"})
                  .exit_code,
              0);
}

TEST(DiffCommand, WritesThroughLinksAndRefusesWhatIsNoFile) {
  const TwoStudies two;
  const std::string pipe = two.folder / "pipe", link = two.folder / "link.md";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const fs::path target = two.folder.file("target.md", "old");
  fs::create_symlink(target, link);
  for (const std::string& location :
       {pipe, std::string("/dev/full"), std::string(two.folder / "")}) {
    const Outcome outcome = mapproof({"diff", two.before, two.after, "--markdown", location});
    EXPECT_EQ(outcome.exit_code, 2) << location;
    EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  }
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(mapproof({"diff", two.before, two.after, "--markdown", link}).exit_code, 0);
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_NE(read_file(target).find("### mapproof diff"), std::string::npos);
}

TEST(DiffCommand, NeverWaitsForWhatHasNoEnd) {
  const TwoStudies two;
  const std::string image = two.after + "/figures/map-usual.png";
  const std::string run = two.after + "/runs/layout-1-pose-1.json";
  for (const std::string& file : {image, run}) {
    fs::remove(file);
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  }
  fs::remove(two.after + "/figures/pair-usual.png");
  fs::create_symlink("/dev/zero", two.after + "/figures/pair-usual.png");
  const Outcome outcome = mapproof({"diff", two.before, two.after});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
  EXPECT_NE(outcome.out.find("3 unreadable, 1 identical"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("is a named pipe"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("is a device"), std::string::npos) << outcome.out;
  for (const std::string& sole : {image, std::string("/dev/zero")}) {
    const Outcome alone = mapproof({"diff", two.before + "/figures/map-usual.png", sole});
    EXPECT_EQ(alone.exit_code, 2);
    EXPECT_EQ(std::ranges::count(alone.error, '\n'), 1) << alone.error;
  }
}

TEST(DiffCommand, EndsWithTwoWhereNothingCanBeCompared) {
  const TwoStudies two;
  const TemporaryFolder empty;
  const auto expect_two = [](const std::vector<std::string>& arguments, const std::string& word) {
    const Outcome outcome = mapproof(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out << outcome.error;
    EXPECT_NE(outcome.error.find(word), std::string::npos) << outcome.error;
  };
  expect_two({"diff", two.before, two.folder / "nowhere"}, "nowhere");
  expect_two({"diff", empty.path(), empty.path()}, "hold no records");
  expect_two({"diff", two.before, two.after + "/study.json"}, "they cannot be compared");
  expect_two({"diff", two.before}, "CURRENT");
  expect_two({"diff", two.before, two.after, "--allow", "beter"}, "did you mean \"better\"");
  const fs::path settings = two.folder.file(
      "s.json", R"({"schema": {"name": "mapproof.diff_settings", "version": 1}, "ignored": []})");
  expect_two({"diff", two.before, two.after, "--settings", settings}, "ignored");
}

TEST(DiffCommand, GoesByTheSettingsBesideTheBaseline) {
  const TwoStudies two;
  two.change_score();
  write_file(fs::path(two.before) / "mapproof-diff.json",
             R"({"schema": {"name": "mapproof.diff_settings", "version": 1},
                 "records": {"tolerances": {"mpe_m": {"absolute": 10}}}})");
  EXPECT_EQ(mapproof({"diff", two.before, two.after}).exit_code, 0);
  EXPECT_EQ(mapproof({"diff", two.after, two.before}).exit_code, 1);
}

TEST(DiffCommand, ReadsNoSettingsBehindALinkAndDropsNone) {
  const TwoStudies two;
  const fs::path settings = fs::path(two.before) / "mapproof-diff.json";
  const fs::path secret = two.folder.file("secret.txt", "root:x:0");
  for (const fs::path& target : {secret, two.folder / "none", fs::path("/dev/zero")}) {
    fs::remove(settings);
    fs::create_symlink(target, settings);
    const Outcome outcome = mapproof({"diff", two.before, two.after});
    EXPECT_EQ(outcome.exit_code, 2) << target;
    EXPECT_EQ(outcome.error.find("mapproof: " + settings.string() + ": is "), 0) << outcome.error;
    EXPECT_EQ(outcome.error.find("root"), std::string::npos);
  }
}

TEST(DiffCommand, TakesFoldersOfImagesOfOthersAndTwoFiles) {
  const TwoStudies two;
  const std::string before = two.before + "/figures", after = two.after + "/figures";
  EXPECT_EQ(mapproof({"diff", before, after}).exit_code, 0);
  two.change_image();
  EXPECT_EQ(mapproof({"diff", before, after}).exit_code, 1);
  EXPECT_EQ(mapproof({"diff", before + "/map-usual.png", after + "/map-usual.png"}).exit_code, 1);
  EXPECT_EQ(mapproof({"diff", before + "/pair-usual.png", after + "/pair-usual.png"}).exit_code, 0);
  fs::remove(after + "/map-usual.png");
  const Outcome outcome = mapproof({"diff", before, after});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("missing"), std::string::npos);
}

TEST(DiffCommand, TakesTheMostAlikeOfSeveralBaselines) {
  const TwoStudies two;
  two.change_image();
  fs::copy_file(two.after + "/figures/map-usual.png",
                two.before + "/figures/map-usual@cairo-1.18.png");
  const Outcome outcome = mapproof({"diff", two.before, two.after, "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  EXPECT_NE(outcome.out.find("\"baseline_key\": \"cairo-1.18\""), std::string::npos);
}

TEST(DiffCommand, HandsItsImagesToCtest) {
  const TwoStudies two;
  two.change_image();
  const Environment ctest({{"DASHBOARD_TEST_FROM_CTEST", "3.25"}});
  const Outcome outcome = mapproof({"diff", two.before, two.after});
  EXPECT_NE(
      outcome.out.find("<CTestMeasurementFile type=\"image/png\" name=\"map-usual current\">"),
      std::string::npos)
      << outcome.out;
}

}  // namespace
}  // namespace mapproof::test
