#include "core/records/maps/map_json.hpp"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/records/observations/landmarks_csv.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/support/schemas/schema_problem.hpp"

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
  EXPECT_EQ(*setting_of(map), (MethodSetting{Method::kIsomap, 4.0}));
  EXPECT_EQ(map.statuses[0].code, StatusCode::kLandmarkUnseen);
  EXPECT_TRUE(map.estimate.row(2).array().isNaN().all());
  EXPECT_TRUE(map.ground_truth_m->row(3).array().isNaN().all());
  EXPECT_EQ(map_json(map), read_file(data_file("maps/map.json")));
}

TEST(MapJson, KeepsTheFitOfItsData) {
  const Fit fit{.verdict = FitVerdict::kNotTestable, .why = {FitMissing::kRedundancy}};
  const std::string text = map_json(sample(), {}, {}, fit);
  EXPECT_EQ(parse_map_fit(text, "m"), fit);
  EXPECT_EQ(test::schema_problem("map", nlohmann::json::parse(text)), "");
  std::string sound = text;
  sound.replace(sound.find("\"not_testable\""), 14, "\"fits\"");
  EXPECT_EQ(error_of([&] { parse_map_fit(sound, "m"); }),
            "m: /fit/why: is of the verdict not_testable alone");
}

TEST(MapJson, OfMeasuredPairsSaysSo) {
  MapRecord map = sample();
  map.origin = FromPairs{};
  std::string text = map_json(map);
  EXPECT_NE(text.find("\"range-bearing\""), std::string::npos);
  EXPECT_NE(text.find("\"pairs\""), std::string::npos);
  const MapRecord again = parse_map(text, "m");
  EXPECT_EQ(again.origin, map.origin);
  EXPECT_EQ(map_json(again), text);
  EXPECT_EQ(test::schema_problem("map", nlohmann::json::parse(text)), "");
  text.replace(text.find("\"pairs\""), 7, "\"smacof\"");
  EXPECT_EQ(error_of([&] { parse_map(text, "m"); }),
            "m: /method: expected pairs for range-bearing, got \"smacof\"");
}

TEST(MapJson, OfSeveralSensorsNamesThem) {
  MapRecord map = sample();
  map.origin = FromSensors{{Sensor::kBearing, Sensor::kRange}, {Method::kIsomap, 4.0}};
  const std::string text = map_json(map);
  EXPECT_EQ(parse_map(text, "m").origin, map.origin);
  EXPECT_EQ(test::schema_problem("map", nlohmann::json::parse(text)), "");
  nlohmann::json one = nlohmann::json::parse(text);
  one["sensor"] = "bearing";
  EXPECT_NE(error_of([&] { parse_map(one.dump(), "m"); }).find("m: /sensors: "), std::string::npos);
}

TEST(MapJson, HoldsAStatusToItsReason) {
  const std::string text = map_json(sample());
  const auto error_with = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    other.replace(other.find(from), from.size(), to);
    return error_of([&] { parse_map(other, "m"); });
  };
  EXPECT_EQ(error_with("never_observed", "never_obseved"),
            "m: /statuses/0/reason: unknown reason \"never_obseved\": did you mean "
            "\"never_observed\"?");
  EXPECT_EQ(error_with("\"values\": [1, 4]", "\"values\": [1]"),
            "m: /statuses/0/values: expected 2 values of never_observed, got 1");
  EXPECT_EQ(error_with("never_observed", "few_anchors_mapped"),
            "m: /statuses/0/names: expected no names");
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
  map.origin = FromSensor{Sensor::kVisibility, {Method::kLpca, std::nullopt}};
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

TEST(MapCsv, GivesNoErrorsOutsideTheFrameOfTheGroundTruth) {
  MapRecord map = sample();
  map.frame = Frame::kSimilarity;
  map.ground_truth_m.reset();
  EXPECT_TRUE(map_csv(map).starts_with("name,x,y,true_x_m,true_y_m,anchor\r\noak,0,0,,,1\r\n"));
}

TEST(MapCsv, KeepsHostileNamesAsTheyAre) {
  MapRecord map = sample();
  map.names = {"=1+1", "a\"b,c", "two\nlines", " padded "};
  map.ground_truth_m.reset();
  const std::string csv = map_csv(map);
  EXPECT_NE(csv.find("\r\n=1+1,0,0,"), std::string::npos);
  EXPECT_NE(csv.find("\r\n\"a\"\"b,c\",4,0,"), std::string::npos);
  EXPECT_NE(csv.find("\r\n\"two\nlines\",,,"), std::string::npos);
  EXPECT_NE(csv.find("\r\n\" padded \",3,4,"), std::string::npos);
}

MapUncertainty sample_uncertainty() {
  MapUncertainty uncertainty{.covariances = {},
                             .squared_radius = 4.0,
                             .confidence = 0.95,
                             .replicates = 50,
                             .maps = 49,
                             .block_steps = 7};
  Eigen::Matrix2d C;
  C << 2.5, 1.5, 1.5, 2.5;
  uncertainty.covariances.assign(4, C);
  uncertainty.covariances[0].setZero();
  uncertainty.covariances[2].setConstant(std::numeric_limits<double>::quiet_NaN());
  return uncertainty;
}

TEST(MapJson, HoldsHowSureEachLandmarkIs) {
  const std::string text = map_json(sample(), sample_uncertainty());
  const auto uncertainty = parse_map_uncertainty(text, "m");
  ASSERT_TRUE(uncertainty);
  EXPECT_EQ(uncertainty->covariances[1], sample_uncertainty().covariances[1]);
  EXPECT_TRUE(uncertainty->covariances[2].array().isNaN().all());
  EXPECT_EQ(uncertainty->maps, 49);
  EXPECT_EQ(map_json(parse_map(text, "m"), uncertainty), text);
  EXPECT_FALSE(parse_map_uncertainty(map_json(sample()), "m"));
}

TEST(MapJson, HoldsTheSensorsOfAJointMap) {
  const MapSensors sensors{.sensors = {{Sensor::kBearing, 0.9, 0.75, 0.5, 0.98},
                                       {Sensor::kRange, 0.5, 0.25, 0.5, std::nan("")}},
                           .continuity = 0.99};
  const std::string text = map_json(sample(), {}, sensors);
  EXPECT_EQ(test::schema_problem("map", nlohmann::json::parse(text)), "");
  EXPECT_EQ(map_json(parse_map(text, "m")), map_json(sample()));
  MapSensors none = sensors;
  none.sensors.clear();
  EXPECT_TRUE(error_of([&] {
                parse_map(map_json(sample(), {}, none), "m");
              }).starts_with("m: /mixed/sensors: expected"));
}

TEST(MapJson, RefusesCovariancesThatAreNone) {
  MapUncertainty uncertainty = sample_uncertainty();
  uncertainty.covariances[3](0, 1) = uncertainty.covariances[3](1, 0) = 2.6;
  EXPECT_EQ(error_of([&] { parse_map(map_json(sample(), uncertainty), "m"); }),
            "m: /uncertainty/covariances/3: expected a covariance, xy^2 <= xx yy");
  uncertainty.covariances.pop_back();
  EXPECT_TRUE(error_of([&] {
                parse_map(map_json(sample(), uncertainty), "m");
              }).starts_with("m: /uncertainty/covariances: expected"));
}

TEST(MapCsv, GivesTheEllipsesOfLandmarksThatHaveOne) {
  const std::string csv = map_csv(sample(), sample_uncertainty());
  EXPECT_TRUE(
      csv.starts_with("name,x_m,y_m,true_x_m,true_y_m,error_m,anchor,ellipse_a_m,"
                      "ellipse_b_m,ellipse_rotation_deg\r\noak,0,0,0,0,0,1,0,0,0\r\n"));
  EXPECT_NE(csv.find("\r\nash,4,0,4,0,0,1,4,2,45\r\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\r\nelm,,,4,3,,0,,,\r\n"), std::string::npos) << csv;
}

}  // namespace
}  // namespace mapproof
