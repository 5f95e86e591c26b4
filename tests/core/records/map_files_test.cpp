#include "core/records/map_files.hpp"

#include <gtest/gtest.h>

#include "core/base/files.hpp"
#include "core/records/landmarks_csv.hpp"
#include "tests/core/records/samples.hpp"

namespace mapproof {
namespace {

using test::data_file;
using test::error_of;

MapRecord sample() {
  const std::string path = data_file("maps/map.json").string();
  return parse_map(read_file(path), path);
}

TEST(MapJson, ComesBackTheSame) {
  const MapRecord map = sample();
  EXPECT_EQ(map.setting, (MethodSetting{Method::kIsomap, 4.0}));
  EXPECT_EQ(map.statuses[0].code, StatusCode::kLandmarkUnseen);
  EXPECT_TRUE(map.estimate.row(2).array().isNaN().all());
  EXPECT_TRUE(map.truth_m->row(3).array().isNaN().all());
  EXPECT_EQ(map_json(map), read_file(data_file("maps/map.json")));
}

TEST(MapJson, NeedsARowForEveryName) {
  MapRecord map = sample();
  map.estimate.conservativeResize(3, 2);
  EXPECT_EQ(error_of([&] { parse_map(map_json(map), "m"); }),
            "m: /estimate: expected 4 rows, one a name, got 3");
}

TEST(MapJson, KnowsItsAnchorsAndMethods) {
  MapRecord map = sample();
  map.anchors = {0, 4};
  EXPECT_EQ(error_of([&] { parse_map(map_json(map), "m"); }),
            "m: /anchors/1: expected an integer from 0 to 3, got 4");
  map = sample();
  map.setting = {Method::kLpca, std::nullopt};
  std::string text = map_json(map);
  text.replace(text.find("\"lpca\""), 6, "\"lpca\", \"K\": 4");
  EXPECT_EQ(error_of([&] { parse_map(text, "m"); }), "m: /: unknown key \"K\"");
}

TEST(MapCsv, LeavesEmptyWhatIsNotKnown) {
  EXPECT_EQ(map_csv(sample()),
            "name,x_m,y_m,true_x_m,true_y_m,error_m,anchor\r\n"
            "oak,0,0,0,0,0,1\r\n"
            "ash,4,0,4,0,0,1\r\n"
            "elm,,,4,3,,0\r\n"
            "yew,3,4,,,,0\r\n");
}

TEST(MapCsv, GivesNoErrorsOutsideTheFrameOfTheTruth) {
  MapRecord map = sample();
  map.frame = Frame::kSimilarity;
  map.truth_m.reset();
  EXPECT_TRUE(map_csv(map).starts_with("name,x,y,true_x_m,true_y_m,anchor\r\noak,0,0,,,1\r\n"));
}

TEST(MapCsv, KeepsHostileNamesAsTheyAre) {
  MapRecord map = sample();
  map.names = {"=1+1", "a\"b,c", "two\nlines", " padded "};
  map.truth_m.reset();
  const std::string csv = map_csv(map);
  EXPECT_NE(csv.find("\r\n=1+1,0,0,"), std::string::npos);
  EXPECT_NE(csv.find("\r\n\"a\"\"b,c\",4,0,"), std::string::npos);
  EXPECT_NE(csv.find("\r\n\"two\nlines\",,,"), std::string::npos);
  EXPECT_NE(csv.find("\r\n\" padded \",3,4,"), std::string::npos);
}

}  // namespace
}  // namespace mapproof
