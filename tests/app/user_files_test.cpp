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
  const Outcome report = mapproof({"report", map});
  EXPECT_EQ(report.exit_code, 2);
  EXPECT_NE(report.error.find("is the folder of a map: its report is " + map + "/report.html"),
            std::string::npos)
      << report.error;
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

TEST_F(UserFiles, OneRoleHasAHeaderForEachFile) {
  const std::string observed =
      file("o.csv", with_header(kHall / "range_bearing.csv", "Uhr,Kennung,Weite,Richtung"));
  const std::string anchors =
      file("a.csv", with_header(kHall / "anchors.csv", "Punktnummer,Lage1,Lage2"));
  std::vector<std::string> words = {"map",
                                    observed,
                                    "--anchors",
                                    anchors,
                                    "--out",
                                    at("out"),
                                    "--columns",
                                    "time=Uhr,landmark=Kennung,landmark=Punktnummer,range=Weite,"
                                    "bearing=Richtung,x=Lage1,y=Lage2"};
  const Outcome outcome = mapproof(words);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_NE(outcome.error.find("landmark = Kennung"), std::string::npos) << outcome.error;
  words.back() =
      "time=Uhr,landmark=Kennung,landmark=Nummer,range=Weite,bearing=Richtung,x=Lage1,y=Lage2";
  EXPECT_NE(mapproof(words).error.find("names for landmark; there are \"Punktnummer\""),
            std::string::npos);
  words.back() = "landmark=Kennung,landmark=kennung";
  EXPECT_NE(mapproof(words).error.find("landmark is given twice"), std::string::npos);
  words.back() = "landmark=1,landmark=2";
  EXPECT_NE(mapproof(words).error.find("landmark is given twice"), std::string::npos);
}

TEST_F(UserFiles, OneRoleHasAHeaderForEachFileOfARangeLog) {
  const std::string ranges = file("r.csv", with_header(kDrive / "ranges.csv", "Zeit,Bake,Entf"));
  const std::string wheels =
      file("w.csv", with_header(kDrive / "odometry.csv", "Uhr,Gefahren,Gedreht"));
  const std::vector<std::string> words = {
      ranges, "--odometry", wheels, "--columns",
      "time=Zeit,time=Uhr,range=Entf,distance=Gefahren,heading_change=Gedreht"};
  for (const json& one : validated(words)) EXPECT_EQ(one.at("problem"), "") << one;
  const std::string both = file("b.csv", with_header(kDrive / "ranges.csv", "Zeit,Bake,Uhr"));
  const json one = validated({both, "--columns", "time=Zeit,time=Uhr,range=Entf"})[0];
  EXPECT_FALSE(one.at("valid"));
}

TEST_F(UserFiles, DetectionsOfRosAreReadAsLinesOfJson) {
  // As apriltag_ros writes them: a list for the ID, and lists that are empty.
  std::string lines;
  for (int k = 0; k < 3; ++k)
    lines += R"({"header": {"stamp": {"sec": )" + std::to_string(k) +
             R"(, "nanosec": 0}}, "detections": [{"id": [7], "results": [], "pose": {"position": )"
             R"({"x": 1.5, "y": 0.5}}}, {"id": [9], "results": [], "pose": {"position": )"
             R"({"x": 2.5, "y": -0.5}}}]})" +
             "\n";
  const std::string path = file("d.jsonl", lines);
  const Outcome unnamed = mapproof({"map", path, "--sensor", "range-bearing", "--out", at("o")});
  EXPECT_NE(unnamed.error.find("there is \"pose.position.x\""), std::string::npos) << unnamed.error;
  const json one = validated({path, "--columns", "x=pose.position.x,y=pose.position.y"})[0];
  EXPECT_EQ(one.at("problem"), "");
  EXPECT_EQ(one.at("input").at("sensor"), "range-bearing");
  EXPECT_EQ(one.at("input").at("landmarks"), 2);
}

TEST_F(UserFiles, ColumnsOfUnknownNamesBesideTimesAndIdsAreNoTransposedTable) {
  std::string text = "stamp,tag_id,pose.position.x,pose.position.y\n";
  for (int step = 0; step < 60; ++step)
    for (const char* tag : {"3", "5"})
      text += std::to_string(1700000000.0 + step) + "," + tag + ",1.5,0.25\n";
  const json one = validated({file("d.csv", text)})[0];
  EXPECT_NE(one.at("problem").dump().find("there is \\\"pose.position.x\\\""), std::string::npos)
      << one;
}

TEST_F(UserFiles, ACamerasFrameIsReadBesideAColumnYAndLeavesTheGroundTruthAsItIs) {
  // A camera looks along z; x is to its right, y down.
  const auto detections = [](const char* header) {
    std::string text = header;
    for (int step = 0; step < 40; ++step)
      for (int tag = 0; tag < 6; ++tag) {
        const double ahead = 2.0 + tag + 0.05 * step, right = tag % 3 - 1.0;
        text += std::to_string(step) + "," + std::to_string(tag) + "," + std::to_string(right) +
                ",0.7," + std::to_string(ahead) + "\n";
      }
    return text;
  };
  std::string positions = "id,x,y,z\n";
  for (int tag = 0; tag < 6; ++tag)
    positions += std::to_string(tag) + "," + std::to_string(2.0 + tag) + "," +
                 std::to_string(1.0 - tag % 3) + ",0.7\n";
  const std::string ground_truth = file("g.csv", positions);
  const auto error_of = [&](const std::string& path, const char* columns) {
    const Outcome outcome =
        mapproof({"map", path, "--sensor", "range-bearing", "--columns", columns, "--ground-truth",
                  ground_truth, "--json", "--force", "--out", at("camera")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    return outcome.exit_code == 0 ? json::parse(outcome.out).at("score").at("mpe_m").get<double>()
                                  : 1e300;
  };
  EXPECT_LT(error_of(file("named.csv", detections("step,id,x,y,z\n")), "x=z,right=x"), 0.01);
  EXPECT_LT(error_of(file("bare.csv", detections("")), "step=1,landmark=2,right=3,x=5"), 0.01);
}

TEST_F(UserFiles, NumbersCountColumnsThoughIdsAreNumbersToo) {
  std::string text;
  for (int step = 0; step < 30; ++step)
    for (int id = 1; id < 5; ++id)
      text += std::to_string(step) + " " + std::to_string(id) + " 1." + std::to_string(id) + " 0." +
              std::to_string(id) + "\n";
  const json one =
      validated({file("d.txt", text), "--columns", "time=1,landmark=2,range=3,bearing=4"})[0];
  EXPECT_EQ(one.at("problem"), "");
  EXPECT_EQ(one.at("input").at("landmarks"), 4);
}

TEST_F(UserFiles, AColumnOfLandmarksOfAnUnknownNameIsWhatTheMessageNames) {
  const std::string path = file("d.csv", "time,Zielmarke,range,bearing\n0,a,1,0\n0,b,2,1\n");
  const Outcome outcome = mapproof({"map", path, "--out", at("o")});
  EXPECT_NE(outcome.error.find("no column is named landmark; there is \"Zielmarke\""),
            std::string::npos)
      << outcome.error;
}

TEST_F(UserFiles, TheIdOfWhatWasNotIdentifiedIsRemarkedOn) {
  const json one = validated(
      {file("d.csv", "step,tag_id,range,bearing\n0,3,1,0\n0,-1,2,0\n1,4,2,1\n1,-1,1,1\n")})[0];
  EXPECT_NE(one.at("remarks").dump().find("2 detections of a landmark"), std::string::npos) << one;
  const json none = validated({file("d.csv", "step,tag_id,range,bearing\n0,3,1,0\n0,4,2,0\n")})[0];
  EXPECT_EQ(none.at("remarks").size(), 0U) << none;
}

TEST_F(UserFiles, TablesAsOtherProgramsPrintThemAreRead) {
  const std::vector<std::pair<std::string, std::string>> tables = {
      {"time,variable,value\n0,a,0.5\n0,b,1\n1,a,0.2\n", "long table"},  // pandas melts
      {"time,,0\n0,a,0.5\n0,b,1\n1,a,0.2\n", "long table"},              // and stacks.
      {R"({"9": {"a": 0.5, "b": 1}, "10": {"a": 0.2, "b": null}})", "transposed table"},
      {R"({"schema": {"fields": [{"name": "index"}]}, "data": [{"index": 0, "a": 0.5, "b": 1},)"
       R"( {"index": 1, "a": 0.2, "b": null}]})",
       "transposed table"}};
  for (const auto& [text, form] : tables) {
    const json one = validated({file("t", text), "--sensor", "bearing"})[0];
    EXPECT_EQ(one.at("problem"), "") << text;
    EXPECT_EQ(one.at("input").at("form"), form) << text;
    EXPECT_EQ(one.at("input").at("landmarks"), 2) << text;
    EXPECT_EQ(one.at("input").at("steps"), 2) << text;
  }
  const std::vector<std::string> lists = {
      "step|landmark|range|bearing\n0|a|1.5|0.5\n1|b|2|1\n",  // sqlite3
      "step  landmark  range  bearing\n----  --------  -----  -------\n0     a         1.5    0.5\n"
      "1     b         2      1\n",
      "0,a,1.5,0.5\n1,b,2,1\n", "0.0 a 1.5 0.5\n0.1 b 2 1\n"};
  for (const std::string& text : lists) {
    const json one = validated({file("t", text)})[0];
    EXPECT_EQ(one.at("problem"), "") << text;
    EXPECT_EQ(one.at("input").at("sensor"), "range-bearing") << text;
    EXPECT_EQ(one.at("input").at("form"), "detections") << text;
  }
  const json graph = validated({file("g",
                                     "EDGE_BEARING_SE2_XY 0 9 0.5 100\n"
                                     "EDGE_BEARING_SE2_XY 1 8 0.5 100\n")})[0];
  EXPECT_EQ(graph.at("input").at("sensor"), "bearing") << graph;
}

TEST_F(UserFiles, BearingsAreNotTakenForRanges) {
  std::string degrees = "name", radians = "name";
  for (int j = 0; j < 72; ++j)
    degrees += "," + std::to_string(j), radians += "," + std::to_string(j);
  for (int i = 0; i < 5; ++i) {
    degrees += "\nL" + std::to_string(i);
    radians += "\nL" + std::to_string(i);
    for (int j = 0; j < 72; ++j) {
      const int angle = (i * 72 + j * 31) % 360;
      degrees += "," + std::to_string(angle);
      radians += "," + std::to_string(angle * 0.0174532925);
    }
  }
  const std::string in_degrees = file("d.csv", degrees + "\n");
  for (const auto& [path, remedy] :
       {std::pair(in_degrees, "If they are bearings: map --sensor bearing --degrees"),
        {file("r.csv", radians + "\n"), "If they are bearings: map --sensor bearing"}})
    for (const char* command : {"map", "validate"}) {
      std::vector<std::string> words = {command, path, "--sensor", "range"};
      if (command != std::string("validate")) words.insert(words.end(), {"--out", at("o")});
      const Outcome outcome = mapproof(words);
      EXPECT_NE((outcome.out + outcome.error).find(remedy), std::string::npos)
          << outcome.out << outcome.error;
      fs::remove_all(at("o"));
    }
  const Outcome ranges =
      mapproof({"validate", (kHall / "ranges.csv").string(), "--sensor", "range"});
  EXPECT_EQ(ranges.out.find("If they are bearings"), std::string::npos) << ranges.out;
  const Outcome negative =
      mapproof({"validate", (kHall / "bearings.csv").string(), "--sensor", "range"});
  EXPECT_NE(negative.out.find("is it a bearing?"), std::string::npos) << negative.out;
}

TEST_F(UserFiles, AColumnOfAnglesIsNoColumnOfRanges) {
  for (const char* header : {"Winkel", "Wert_deg", "Wert [rad]", "bearing"}) {
    const std::string path =
        file("t.csv", std::string("time,landmark,") + header + "\n0,a,0.5\n1,b,1\n");
    for (const char* command : {"map", "slam"}) {
      const Outcome outcome =
          mapproof({command, path, "--columns", std::string("range=") + header, "--out", at("o")});
      EXPECT_EQ(outcome.exit_code, 2) << header;
      EXPECT_NE(outcome.error.find("in that unit"), std::string::npos) << outcome.error;
    }
  }
}

TEST_F(UserFiles, FeetAndHeadersInFrenchAndSpanishAreRead) {
  const json feet = validated({file("f.csv",
                                    "horodatage;balise;distance (ft)\n0,5;A1;10\n"
                                    "0,5;A2;20\n1,5;A1;11\n")})[0];
  EXPECT_EQ(feet.at("problem"), "");
  EXPECT_EQ(feet.at("input").at("sensor"), "range");
  const json anchors = validated({"--anchors", file("a.csv",
                                                    "ancre,x_ft,y_ft\nA1,0,0\nA2,10,0\n"
                                                    "A3,10,20\n")})[0];
  EXPECT_NEAR(anchors.at("input").at("extent_m")[1], 6.096, 1e-9) << anchors;
  EXPECT_EQ(validated({file("s.csv", "tiempo,baliza,distancia\n0,a,1\n0,b,2\n")})[0].at("problem"),
            "");
}

TEST_F(UserFiles, ValidateSaysWhatOdometryPathsAndPositionsHold) {
  const std::string wheels = file("w.csv", "t,ddist,dheading\n0,0.5,0.1\n1,0.5,-0.1\n2,1,0\n");
  const Outcome odometry = mapproof({"validate", "--odometry", wheels});
  EXPECT_NE(odometry.out.find("3 motions, 2 s, a way of 2 m, heading changes of 0.2 rad in all; "
                              "columns time = t, distance = ddist, heading_change = dheading"),
            std::string::npos)
      << odometry.out;
  const Outcome path = mapproof({"validate", file("p.csv", "t,x,y\n0,0,0\n1,3,4\n")});
  EXPECT_NE(path.out.find("2 poses, 1 s, a way of 5 m within 3 m x 4 m"), std::string::npos)
      << path.out;
  const Outcome anchors =
      mapproof({"validate", "--anchors", file("a.csv", "name,x,y\na,0,0\nb,3,1\n")});
  EXPECT_NE(anchors.out.find("2 landmarks, within 3 m x 1 m"), std::string::npos) << anchors.out;
  EXPECT_NE(anchors.out.find("aligned to 3 or more anchors"), std::string::npos) << anchors.out;
  std::string degrees = "t,ddist,dheading\n";
  for (int i = 0; i < 30; ++i) degrees += std::to_string(i) + ",0.1,20\n";
  EXPECT_NE(mapproof({"validate", file("d.csv", degrees)}).out.find("dheading_deg"),
            std::string::npos);
}

TEST_F(UserFiles, AMapThatIsReflectedOntoItsGroundTruthSaysSo) {
  std::string mirrored = "name,x,y\n";
  const std::string text = read_file(kHall / "ground_truth.csv");
  for (std::size_t at = text.find('\n') + 1; at < text.size(); at = text.find('\n', at) + 1) {
    const std::size_t second = text.find(',', text.find(',', at) + 1);
    mirrored +=
        text.substr(at, second - at) + ",-" + text.substr(second + 1, text.find('\n', at) - second);
  }
  const std::string observed = (kHall / "range_bearing.csv").string();
  const auto said = [&](const std::string& positions) {
    return mapproof({"map", observed, "--ground-truth", positions, "--force", "--out", at("o")})
        .error;
  };
  EXPECT_NE(said(file("m.csv", mirrored)).find("the map was reflected, rotated and translated"),
            std::string::npos);
  EXPECT_NE(said((kHall / "ground_truth.csv").string()).find("the map was rotated and translated"),
            std::string::npos);
}

TEST_F(UserFiles, TheChoiceOfAMethodNamesCandidatesThatAreEquallyGood) {
  // Four landmarks in two groups: all methods order the neighbours alike.
  std::string table = "name";
  for (int j = 0; j < 40; ++j) table += "," + std::to_string(j);
  for (int i = 0; i < 4; ++i) {
    table += std::string("\n") + static_cast<char>('a' + i);
    for (int j = 0; j < 40; ++j) table += (j / 4 + i) % 2 == 0 ? ",1" : ",0";
  }
  const Outcome outcome = mapproof({"map", file("t.csv", table + "\n"), "--sensor", "visibility",
                                    "--method", "auto", "--out", at("o")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_NE(outcome.error.find("candidates are equally good by"), std::string::npos)
      << outcome.error;
}

TEST_F(UserFiles, AMisfitThatIdsMayExplainNamesTheirCheck) {
  std::string swapped = "time,landmark,range,bearing\n";
  const std::string text = read_file(kHall / "range_bearing.csv");
  std::size_t row = 0;
  for (std::size_t at = text.find('\n') + 1; at < text.size(); at = text.find('\n', at) + 1) {
    std::string line = text.substr(at, text.find('\n', at) + 1 - at);
    ++row;
    const bool is_wrong = row > 600 && row < 1200;
    for (const auto& [one, other] : {std::pair(",L3,", ",L14,"), {",L14,", ",L3,"}})
      if (const std::size_t id = line.find(one); is_wrong && id != std::string::npos) {
        line.replace(id, std::string(one).size(), other);
        break;
      }
    swapped += line;
  }
  std::vector<std::string> words = {"map", file("s.csv", swapped), "--out", at("o")};
  EXPECT_NE(mapproof(words).error.find("--check-ids looks for landmark IDs"), std::string::npos);
  words.insert(words.end(), {"--repair-ids", "--force"});
  EXPECT_EQ(mapproof(words).error.find("--check-ids looks for"), std::string::npos);
}

}  // namespace
}  // namespace mapproof::test
