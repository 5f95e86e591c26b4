// Tables of one's own with headers of one's own: every command understands them alike.
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kHall = fs::path(MAPPROOF_SOURCE_DIR) / "examples/hall";
const fs::path kDrive = fs::path(MAPPROOF_SOURCE_DIR) / "examples/drive";

/// The file with another first line.
std::string with_header(const fs::path& file, const std::string& header) {
  const std::string text = read_file(file);
  return header + text.substr(text.find('\n'));
}

json validated(std::vector<std::string> words) {
  words.insert(words.begin(), {"validate", "--json"});
  return json::parse(mapproof(words).out).at("files");
}

class UserFiles : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& bytes) const {
    return folder_.file(name, bytes).string();
  }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }

  TemporaryFolder folder_;
};

TEST_F(UserFiles, ValidateTakesTheFilesOfARangeLogAsSlamDoes) {
  const std::string ranges = file("r.csv", with_header(kDrive / "ranges.csv", "Zeit,Bake,Entf"));
  const std::string wheels =
      file("w.csv", with_header(kDrive / "odometry.csv", "Zeit,Gefahren,Gedreht"));
  const std::string beacons =
      file("b.csv", with_header(kDrive / "landmarks.csv", "Bake,Ort1,Ort2"));
  const std::string gps =
      file("g.csv", with_header(kDrive / "groundtruth.csv", "Zeit,Ort1,Ort2,Kurs"));
  const std::vector<std::string> words = {
      ranges,
      "--odometry",
      wheels,
      "--anchors",
      beacons,
      "--ground-truth",
      gps,
      "--columns",
      "time=Zeit,landmark=Bake,range=Entf,distance=Gefahren,heading_change=Gedreht,"
      "x=Ort1,y=Ort2,heading=Kurs"};
  const json files = validated(words);
  ASSERT_EQ(files.size(), 4U);
  for (const json& one : files) EXPECT_EQ(one.at("problem"), "") << one;
  EXPECT_EQ(files[1].at("kind"), "odometry of a range log, CSV");
  EXPECT_EQ(files[2].at("kind"), "landmarks with positions");
  EXPECT_EQ(files[3].at("kind"), "path, CSV");
  std::vector<std::string> slam = words;
  slam.insert(slam.begin(), "slam");
  slam.insert(slam.end(), {"--out", at("out")});
  const Outcome outcome = mapproof(slam);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
}

TEST_F(UserFiles, ValidateGroupsStampsIntoScansAsMapDoes) {
  const std::string seen = file("s.csv", "time,landmark\n0.00,a\n0.01,b\n1.00,a\n1.02,c\n2,b\n");
  const json wide = validated({seen, "--scan-window", "0.1"});
  EXPECT_EQ(wide[0].at("input").at("steps"), 3);
  const json narrow = validated({seen, "--scan-window", "1ms"});
  EXPECT_EQ(narrow[0].at("input").at("steps"), 5);
}

TEST_F(UserFiles, ValidateTakesNoOdometryPathOrPositionsForBearings) {
  const std::vector<std::pair<std::string, std::string>> kinds = {
      {"stamp,dist,turn\n0,0.1,0.01\n0.5,0.2,0.02\n1,0.1,0\n", "odometry of a range log, CSV"},
      {"Bake,Ost,Nord\n1,0,0.1\n2,3,1\n3,2,2\n", "landmarks with positions"},
      {"id,easting,northing\n1,0,0.1\n2,3,1\n3,2,2\n", "landmarks with positions"},
      {"time,px,py\n0,0,0.1\n1,3,1\n2,2,2\n", "path, CSV"}};
  for (const auto& [text, kind] : kinds) {
    const json one = validated({file("t.csv", text)})[0];
    EXPECT_EQ(one.at("kind"), kind) << text;
    EXPECT_EQ(one.at("problem"), "") << text;
  }
  for (const char* text : {"t,v,omega\n0,0.1,0.01\n0.5,0.2,0.02\n1,0.1,0\n",
                           "time,lat,lon\n0,48.1,11.2\n1,48.1,11.2\n2,48.1,11.2\n"}) {
    const std::string problem = validated({file("t.csv", text)})[0].at("problem");
    EXPECT_NE(problem.find("is neither odometry"), std::string::npos) << problem;
  }
}

TEST_F(UserFiles, ValidateNamesWhatMapproofWrote) {
  const std::string map = at("map");
  const Outcome mapped =
      mapproof({"map", (kHall / "bearings.csv").string(), "--sensor", "bearing", "--anchors",
                (kHall / "anchors.csv").string(), "--method", "isomap", "--out", map});
  ASSERT_EQ(mapped.exit_code, 0) << mapped.error;
  EXPECT_TRUE(mapped.out.starts_with("Method: ISOMAP")) << mapped.out;
  ASSERT_EQ(mapproof({"render", map, "--as", "svg,png,pdf,eps,json,csv,matplotlib,latex", "--out",
                      at("drawn")})
                .exit_code,
            0);
  file("drawn/style.json",
       R"({"schema": {"name": "mapproof.style", "version": 1}, "words": {"estimate": "Karte"}})");
  std::vector<std::string> words = {map + "/map.csv"};
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "drawn"))
    words.push_back(entry.path().string());
  for (const json& one : validated(words)) EXPECT_EQ(one.at("problem"), "") << one;
  EXPECT_EQ(validated({file("s.json", R"({"schema": {"name": "mapproof.style", "version": 1},
                                          "widht_in": 3})")})[0]
                .at("valid"),
            false);
}

TEST_F(UserFiles, ValidatePrintsTheEncodingAsMapDoes) {
  const std::string latin = file("l.csv", "name,0,1,2\nT\xFCr,0,1,0.5\nb,1,0,0.2\nc,1,1,0.3\n");
  EXPECT_NE(mapproof({"validate", latin, "--sensor", "bearing"}).out.find("Windows-1252"),
            std::string::npos);
  std::string wide = "\xFF\xFE";
  for (const char c : std::string("name,0,1,2\na,0,1,0.5\nb,1,0,0.2\nc,1,1,0.3\n"))
    wide += std::string{c, '\0'};
  EXPECT_NE(mapproof({"validate", file("w.csv", wide), "--sensor", "bearing"}).out.find("UTF-16"),
            std::string::npos);
}

TEST_F(UserFiles, AHeaderThatTheFileLacksIsRefusedWithThoseThatThereAre) {
  const std::vector<std::pair<std::string, std::string>> files = {
      {"l.jsonl",
       "{\"zeit\":0,\"marke\":\"a\",\"abst\":1}\n{\"zeit\":1,\"marke\":\"b\",\"abst\":2}\n"},
      {"l.csv", "zeit,marke,abst\n0,a,1\n1,b,2\n"},
      {"w.csv", "zeit,marke,abst\n0,0.5,1\n1,0.2,2\n"}};
  for (const auto& [name, text] : files)
    for (const char* command : {"map", "slam", "validate"}) {
      std::vector<std::string> words = {command, file(name, text), "--columns", "range=dist"};
      if (command != std::string("validate")) words.insert(words.end(), {"--out", at("o")});
      const Outcome outcome = mapproof(words);
      const std::string said = outcome.out + outcome.error;
      EXPECT_NE(outcome.exit_code, 0) << command << name;
      EXPECT_NE(
          said.find("no column \"dist\", which --columns names for range; there are \"zeit\", "),
          std::string::npos)
          << command << ' ' << name << '\n'
          << said;
    }
}

TEST_F(UserFiles, ColumnsHoldForAnchorsAndGroundTruthToo) {
  const std::string anchors =
      file("a.csv", with_header(kHall / "anchors.csv", "Marke,Lage1,Lage2"));
  const std::string positions =
      file("p.csv", with_header(kHall / "ground_truth.csv", "Marke,Lage1,Lage2"));
  const std::vector<std::string> words = {"map",
                                          (kHall / "range_bearing.csv").string(),
                                          "--anchors",
                                          anchors,
                                          "--ground-truth",
                                          positions,
                                          "--out",
                                          at("out")};
  const Outcome without = mapproof(words);
  EXPECT_NE(without.error.find("--columns landmark=HEADER,x=HEADER,y=HEADER names others"),
            std::string::npos)
      << without.error;
  std::vector<std::string> named = words;
  named.insert(named.end(), {"--columns", "landmark=Marke,x=Lage1,y=Lage2"});
  const Outcome with = mapproof(named);
  EXPECT_EQ(with.exit_code, 0) << with.error;
  named.back() = "landmark=Marke,x=Lage1,y=Lage3";
  EXPECT_NE(mapproof(named).error.find("no column \"Lage3\""), std::string::npos);
}

TEST_F(UserFiles, PositionsAreReadInTheUnitOfTheirHeader) {
  const std::string metres = file("m.csv", "name,x,y\na,1,2\nb,3,4\n");
  const std::string centimetres = file("c.csv", "name,x [cm],y [cm]\na,100,200\nb,300,400\n");
  EXPECT_EQ(validated({centimetres})[0].at("kind"), "landmarks with positions");
  EXPECT_EQ(validated({metres})[0].at("problem"), "");
}

TEST_F(UserFiles, WhatATableWasIsSaidInsteadOfItsSeparator) {
  const std::string lines = file("l.jsonl",
                                 "{\"time\":0,\"landmark\":\"a\",\"range\":1}\n"
                                 "{\"time\":1,\"landmark\":\"b\",\"range\":2}\n");
  const std::string graph =
      file("g.g2o", "EDGE_SE2_XY 0 100 1 2 1 0 1\nEDGE_SE2_XY 1 101 2 1 1 0 1\n");
  for (const auto& [path, words] : {std::pair(lines, "JSON lines"), {graph, "a graph of g2o"}}) {
    const std::string said = mapproof({"validate", path}).out;
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_EQ(said.find("separated by"), std::string::npos) << said;
  }
}

TEST_F(UserFiles, FilesOfOtherKindsAreNamedWithWhatConvertsThem) {
  for (const auto& [text, kind, remedy] :
       {std::tuple("- time: 1\n  landmark: a\n", "is YAML", "yaml.safe_load"),
        {"%YAML 1.2\n---\nfoo: 1\n", "is YAML", "yaml.safe_load"},
        {"<!-- x -->\n<!doctype HTML>\n<html></html>\n", "is a web page", "read_html"},
        {"%PDF-1.4\n1 0 obj\n", "is a PDF", "pdftotext"}}) {
    const Outcome outcome =
        mapproof({"map", file("f", text), "--sensor", "bearing", "--out", at("o")});
    EXPECT_NE(outcome.error.find(kind), std::string::npos) << outcome.error;
    EXPECT_NE(outcome.error.find(remedy), std::string::npos) << outcome.error;
  }
}

TEST_F(UserFiles, MisspeltWordsAreAnsweredWithTheOneThatWasMeant) {
  const std::string experiment =
      file("e.json", R"({"schema": {"name": "mapproof.experiment", "version": 1}, "step_m": 0.2})");
  const std::vector<std::pair<std::vector<std::string>, std::string>> slips = {
      {{"run", experiment, "--out", at("o")}, "it is a key of \"walk\""},
      {{"reproduce", "yairi", "--out", at("o")}, "did you mean \"yairi2007\"?"},
      {{"diff", "a", "b", "--OUT", "x"}, "this option is now called --page"},
      {{"--versoin"}, "did you mean --version?"},
      {{"example", "hal"}, "did you mean \"hall\"?"}};
  for (const auto& [words, answer] : slips) {
    const Outcome outcome = mapproof(words);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.error;
    EXPECT_NE(outcome.error.find(answer), std::string::npos) << outcome.error;
  }
  EXPECT_FALSE(fs::exists("hal"));
}

}  // namespace
}  // namespace mapproof::test
