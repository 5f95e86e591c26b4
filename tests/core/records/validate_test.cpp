#include "core/studies/validate.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/records/maps/map_json.hpp"
#include "tests/core/records/samples.hpp"

namespace mapproof {
namespace {

using test::data_file;
using test::TemporaryFolder;

Finding only(const std::filesystem::path& path, const ForeignReader& foreign = nullptr) {
  const std::vector<Finding> findings = validate(path, foreign);
  EXPECT_EQ(findings.size(), 1U);
  return findings.at(0);
}

TEST(Validate, KnowsEveryKindOfFileThatIsRead) {
  const std::vector<std::pair<std::string, std::string>> kinds = {
      {"experiments/small.json", "mapproof.experiment 1"},
      {"landmarks/anchors.csv", "landmarks with positions"},
      {"landmarks/groundtruth.csv", "landmarks with positions"},
      {"maps/map.json", "mapproof.map 1"},
      {"mrclam", "MRCLAM observations"},
      {"mrclam/Landmark_Groundtruth.dat", "landmarks with positions"},
      {"observations/long.csv", "long CSV observations"},
      {"observations/long_detections.csv", "long CSV observations"},
      {"observations/observations.json", "mapproof.observations 1"},
      {"observations/wide_named.csv", "wide CSV observations"},
      {"observations/wide_plain.csv", "wide CSV observations"},
      {"observations/wide_semicolon.csv", "wide CSV observations"},
      {"observations/wide_tabs.tsv", "wide CSV observations"}};
  for (const auto& [file, kind] : kinds) {
    const Finding finding = only(data_file(file));
    EXPECT_EQ(finding.kind, kind) << file;
    EXPECT_EQ(finding.problem, "") << file;
  }
}

TEST(Validate, KnowsTheMapsThatAreWritten) {
  const TemporaryFolder folder;
  const std::string map = read_file(data_file("maps/map.json"));
  const auto path = folder.file("map.csv", map_csv(parse_map(map, "map")));
  EXPECT_EQ(only(path).kind, "map CSV");
  EXPECT_EQ(only(path).problem, "");
  folder.file("map.json", map);
  EXPECT_EQ(validate(folder.path()).size(), 2U);
}

TEST(Validate, GoesThroughAllOfAStudy) {
  const TemporaryFolder folder;
  {
    StudyWriter store = StudyWriter(
        folder.path(), study_start(test::small_experiment(), test::made_up_provenance()));
    store.write(part_of(test::made_up_result({1, 1})));
    store.write_session(test::made_up_session());
  }
  folder.file("figures/map.figure.json",
              R"({"schema": {"name": "mapproof.figure", "version": 1}})");
  std::vector<std::string> kinds;
  for (const Finding& finding : validate(folder.path())) {
    kinds.push_back(finding.kind);
    EXPECT_EQ(finding.problem, "") << finding.path;
  }
  EXPECT_EQ(kinds, (std::vector<std::string>{"study", "mapproof.details 1", "mapproof.figure 1",
                                             "mapproof.maps 1", "mapproof.run 1",
                                             "mapproof.study 1", "timings"}));
}

TEST(Validate, TellsAFaultOfAStudyOnceAndRemarksBesideIt) {
  const TemporaryFolder folder;
  const std::string head = R"({"schema": {"name": "mapproof.results_study", "version": 1},
    "title": "T", "quantities": [{"id": "q", "label": "Q", "unit": "%", "better": "higher"}])";
  folder.file("results.csv", "setup,method,quantity,value\ns,m,q,0.5\n");
  const auto problems = [&](const std::string& end) {
    folder.file("study.json", head + end);
    std::vector<std::string> reported;
    for (const Finding& finding : validate(folder.path())) {
      if (!finding.problem.empty()) reported.push_back(finding.problem);
      reported.insert(reported.end(), finding.remarks.begin(), finding.remarks.end());
    }
    return reported;
  };
  EXPECT_EQ(problems(", \"metods\": []}").size(), 1U);
  ASSERT_EQ(problems("}").size(), 1U);
  EXPECT_NE(problems("}")[0].find("results.csv: all values of q lie between 0 and 1"),
            std::string::npos);
}

TEST(Validate, NamesTheDamagedFileOfAStudy) {
  const TemporaryFolder folder;
  StudyWriter(folder.path(), study_start(test::small_experiment(), test::made_up_provenance()))
      .write(part_of(test::made_up_result({1, 1})));
  folder.file("maps/layout-1-pose-1.json", "{");
  const std::vector<Finding> findings = validate(folder.path());
  EXPECT_EQ(std::ranges::count_if(findings, [](const Finding& f) { return !f.problem.empty(); }),
            1);
  EXPECT_NE(findings[1].problem.find("maps/layout-1-pose-1.json: line 1, column 2: the file is"),
            std::string::npos);
}

TEST(Validate, NamesWhatStandsInThePlaceOfAFileOfAStudy) {
  namespace fs = std::filesystem;
  using Make = bool (*)(const fs::path& path);
  const std::vector<std::pair<std::string, Make>> others = {
      {"a named pipe",
       [](const fs::path& path) { return ::mknod(path.c_str(), S_IFIFO | 0600, 0) == 0; }},
      {"a socket",
       [](const fs::path& path) { return ::mknod(path.c_str(), S_IFSOCK | 0600, 0) == 0; }},
      {"a device",
       [](const fs::path& path) {
         fs::create_symlink("/dev/zero", path);
         return true;
       }},
      {"a folder", [](const fs::path& path) { return fs::create_directory(path); }}};
  for (const char* file : {"study.json", "results.csv", "timings.jsonl",
                           "runs/layout-1-pose-1.json", "maps/layout-1-pose-1.json"})
    for (const auto& [other, make] : others) {
      const TemporaryFolder folder;
      StudyWriter(folder.path(), study_start(test::small_experiment(), test::made_up_provenance()))
          .write(part_of(test::made_up_result({1, 1})));
      const fs::path path = folder / file;
      fs::remove(path);
      ASSERT_TRUE(make(path)) << path << other;
      std::vector<std::string> problems;
      for (const Finding& finding : validate(folder.path()))
        if (!finding.problem.empty()) problems.push_back(finding.problem);
      EXPECT_EQ(problems, std::vector<std::string>(
                              {path.string() + ": is " + other + ", a file was expected"}));
    }
}

TEST(Validate, AsksForForeignFilesWhetherTheyAreKnown) {
  const TemporaryFolder folder;
  const auto path =
      folder.file("f.json", R"({"schema": {"name": "mapproof.figure", "version": 1}})");
  const ForeignReader strict = [](std::string_view schema, std::string_view,
                                  const std::string& source) {
    if (schema == "mapproof.figure") throw IoError(source, "/layers", "missing");
    return false;
  };
  EXPECT_EQ(only(path).problem, "");
  EXPECT_EQ(only(path, strict).problem, path.string() + ": /layers: missing");
}

TEST(Validate, SaysWhatItDoesNotKnow) {
  const TemporaryFolder folder;
  EXPECT_NE(only(folder.file("a.png", "\x89PNG\r\n\x1a\n\x01")).problem.find("is a PNG image"),
            std::string::npos);
  EXPECT_NE(only(folder.file("b.json", "{}")).problem.find("does not state what it is"),
            std::string::npos);
  EXPECT_NE(only(folder.file("c.json", R"({"schema": {"name": "x", "version": 1}})"))
                .problem.find("unknown schema \"x\""),
            std::string::npos);
  EXPECT_NE(only(folder / "missing").problem.find("cannot be opened"), std::string::npos);
  EXPECT_NE(only(folder.path()).problem.find("no study"), std::string::npos);
  EXPECT_NE(only(folder.file("d.csv", "a,1,2\nb,-1\n")).problem.find("line 2"), std::string::npos);
}

TEST(Validate, TakesATableForWhatItsHeaderSays) {
  const TemporaryFolder folder;
  const Finding landmarks = only(folder.file("a.csv", "name,x,y\ndoor,1,2\ndesk,3,\n"));
  EXPECT_EQ(landmarks.kind, "landmarks with positions");
  EXPECT_NE(landmarks.problem.find("line 3: a coordinate is missing"), std::string::npos);
  const Finding wide = only(folder.file("b.csv", "name,first,second\ndoor,1,0\ndesk,0,\n"));
  EXPECT_EQ(wide.kind, "wide CSV observations");
  EXPECT_EQ(wide.problem, "");
  const Finding plain = only(folder.file("c.csv", "1,0,1\n0,1,1\n1,1,0\n"));
  EXPECT_EQ(plain.kind, "wide CSV observations");
  EXPECT_EQ(plain.problem, "");
  const Finding torn = only(folder.file("d.csv", "0,oak,1\n1,elm\n"));
  EXPECT_EQ(torn.kind, "long CSV observations");
  EXPECT_NE(torn.problem.find("line 2: has 2 cells"), std::string::npos);
}

TEST(Validate, ChecksEveryProfileOfAnExperiment) {
  const TemporaryFolder folder;
  std::string text = read_file(data_file("experiments/small.json"));
  text.replace(text.find("\"noise\": 0.1}"), 13, "\"noise\": 0.9}");
  EXPECT_NE(
      only(folder.file("e.json", text)).problem.find("with profile noisy: /sensors/visibility"),
      std::string::npos);
}

}  // namespace
}  // namespace mapproof
