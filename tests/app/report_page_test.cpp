// What a report's page carries, and commands on the page alone.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/records/studies/study_page.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

const std::string kData = MAPPROOF_TEST_DATA;

/// A study of the test data with its report.
struct ReportedStudy {
  TemporaryFolder folder;
  std::string study = folder / "study";
  std::string page = folder / "study/report.html";

  explicit ReportedStudy(const std::string& name = "study") {
    fs::copy(kData + "/" + name, study, fs::copy_options::recursive);
    report();
  }
  void report() const {
    const Outcome outcome = mapproof({"report", study});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  }
  /// The page alone, in a folder of its own.
  std::string sent(const std::string& name) const {
    fs::create_directories(folder / "mail");
    fs::copy_file(page, folder / "mail" / name, fs::copy_options::overwrite_existing);
    return folder / "mail" / name;
  }
};

class EveryStudysPage : public ::testing::TestWithParam<const char*> {};

TEST_P(EveryStudysPage, HasTheResultsOfTheFolder) {
  const ReportedStudy study(GetParam());
  const Outcome from_page = mapproof({"results", study.sent("A.html")});
  EXPECT_EQ(from_page.exit_code, 0) << from_page.error;
  EXPECT_EQ(from_page.out, read_file(study.study + "/results.csv"));
  EXPECT_EQ(mapproof({"results", study.study}).out, from_page.out);
}

TEST_P(EveryStudysPage, IsIdenticalToItself) {
  const ReportedStudy study(GetParam());
  const Outcome outcome = mapproof({"diff", study.sent("A.html"), study.sent("B.html")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.error;
  EXPECT_EQ(outcome.error, "");
}

TEST_P(EveryStudysPage, DrawsItsFiguresAsTheFolderHasThem) {
  const ReportedStudy study(GetParam());
  const fs::path drawn = study.folder / "drawn";
  const Outcome outcome = mapproof({"render", study.sent("A.html"), "--out", drawn, "--as", "svg"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const Contents files = contents(drawn);
  EXPECT_FALSE(files.empty());
  for (const auto& [name, bytes] : files)
    EXPECT_EQ(bytes, read_file(fs::path(study.study) / "figures" / name)) << name;
}

INSTANTIATE_TEST_SUITE_P(All, EveryStudysPage,
                         ::testing::Values("study", "slam_study", "topic_study"),
                         [](const auto& info) { return std::string(info.param); });

void worsen(const ReportedStudy& study) {
  for (const auto& run : fs::directory_iterator(fs::path(study.study) / "runs")) {
    std::string text = read_file(run.path());
    for (std::size_t at = 0; (at = text.find("\"mpe_m\": 0.", at)) != std::string::npos; ++at)
      text.replace(at, 11, "\"mpe_m\": 7.");
    write_file(run.path(), text);
  }
  study.report();
}

TEST(ReportPage, TellsADiffWhatGotWorse) {
  const ReportedStudy study;
  const std::string before = study.sent("A.html");
  worsen(study);
  const std::string after = study.sent("B.html");
  const Outcome pages = mapproof({"diff", before, after, "--json"});
  EXPECT_EQ(pages.exit_code, 1) << pages.error;
  const auto diff = nlohmann::json::parse(pages.out);
  EXPECT_EQ(diff["baseline"], before);
  EXPECT_EQ(diff["current"], after);
  EXPECT_EQ(pages.out.find("mapproof-page-"), std::string::npos);
  const auto& items = diff["items"];
  const auto records =
      std::ranges::find_if(items, [](const auto& item) { return item["id"] == "records"; });
  ASSERT_NE(records, items.end());
  EXPECT_EQ((*records)["verdict"], "worse");
  const std::string page = study.folder / "diff.html";
  EXPECT_EQ(mapproof({"diff", before, after, "--page", page}).exit_code, 1);
  EXPECT_NE(read_file(page).find("data:image/svg+xml"), std::string::npos)
      << "figures that differ are drawn";
}

TEST(ReportPage, IsComparedWithTheFolderThatHasItsOwn) {
  const ReportedStudy study;
  EXPECT_EQ(mapproof({"diff", study.sent("A.html"), study.study}).exit_code, 0);
  fs::remove(study.page);
  const Outcome outcome = mapproof({"diff", study.folder / "mail/A.html", study.study});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.error.find("is a page, and " + study.study + " is none"), std::string::npos)
      << outcome.error;
}

TEST(ReportPage, OfAMapCarriesTheMap) {
  const TemporaryFolder folder;
  const std::string out = folder / "map";
  ASSERT_EQ(mapproof({"map", kData + "/observations/wide_semicolon.csv", "--sensor", "bearing",
                      "--out", out})
                .exit_code,
            0);
  const StudyPage page(out + "/report.html");
  EXPECT_EQ(read_file(page.folder() / "map.json"), read_file(out + "/map.json"));
  EXPECT_EQ(read_file(page.folder() / "figures/map.figure.json"),
            read_file(out + "/figures/map.figure.json"));
  fs::copy_file(out + "/report.html", folder / "A.html");
  EXPECT_EQ(mapproof({"diff", folder / "A.html", out + "/report.html"}).exit_code, 0);
  EXPECT_EQ(mapproof({"results", folder / "A.html"}).exit_code, 2);
}

TEST(ReportPage, WithoutDataOrDamagedIsRefusedInOneLine) {
  const ReportedStudy study;
  const TemporaryFolder& folder = study.folder;
  const std::string html = read_file(study.page);
  std::string damaged = html;
  damaged.replace(damaged.rfind("mapproof-data") + 500, 4, "AAAA");
  const std::vector<std::string> pages = {
      folder.file("empty.html", "<!DOCTYPE html><html></html>"),
      folder.file("cut.html", html.substr(0, html.rfind("</script>") - 100)),
      folder.file("damaged.html", damaged)};
  for (const std::string& page : pages) {
    const std::vector<std::vector<std::string>> commands = {
        {"results", page}, {"render", page, "--out", folder / "drawn"}, {"diff", study.page, page}};
    for (const std::vector<std::string>& words : commands) {
      const Outcome outcome = mapproof(words);
      EXPECT_EQ(outcome.exit_code, 2) << words[0] << page;
      EXPECT_NE(outcome.error.find(page), std::string::npos) << outcome.error;
      EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
    }
  }
  EXPECT_FALSE(fs::exists(folder / "drawn"));
}

TEST(ReportPage, IsValidatedWithWhatItCarries) {
  const ReportedStudy study;
  EXPECT_EQ(mapproof({"validate", study.page}).exit_code, 0);
  std::string damaged = read_file(study.page);
  damaged.replace(damaged.rfind("mapproof-data") + 500, 4, "AAAA");
  const Outcome outcome = mapproof({"validate", study.folder.file("A.html", damaged)});
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("damaged"), std::string::npos) << outcome.out;
}

TEST(ReportPage, OfSeveralStudiesGivesTheOneThatIsNamed) {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  fs::create_directories(out);
  for (const auto& [name, data] :
       {std::pair("yairi2007", "/study"), std::pair("boots2013", "/slam_study")})
    fs::copy(kData + data, out + "/" + name, fs::copy_options::recursive);
  ASSERT_EQ(mapproof({"report", out}).exit_code, 0);
  const std::string page = out + "/report.html";
  EXPECT_EQ(mapproof({"results", page}).exit_code, 2);
  const Outcome outcome = mapproof({"results", page, "--study", "boots2013"});
  EXPECT_EQ(outcome.out, read_file(kData + "/slam_study/results.csv"));
  EXPECT_EQ(mapproof({"diff", page, page}).exit_code, 0);
}

}  // namespace
}  // namespace mapproof::test
