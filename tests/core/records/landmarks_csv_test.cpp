#include "core/records/observations/landmarks_csv.hpp"

#include <gtest/gtest.h>

#include "tests/core/records/samples.hpp"

namespace mapproof {
namespace {

using test::data_file;
using test::error_of;

std::string landmarks_error(const std::string& text) {
  const test::TemporaryFolder folder;
  const std::string path = folder.file("a.csv", text).string();
  return error_of([&] { read_landmarks(path); }).substr(path.size() + 2);
}

TEST(LandmarksCsv, NeedsNoHeader) {
  const NamedPoints anchors = read_landmarks(data_file("landmarks/anchors.csv"));
  EXPECT_EQ(anchors.names, (std::vector<std::string>{"door", "window", "shelf"}));
  Points expected(3, 2);
  expected << 0, 0, 4, 0.5, 0.25, 3;
  EXPECT_EQ(anchors.positions_m, expected);
  EXPECT_EQ(anchors.locations[2], "line 3");
}

TEST(LandmarksCsv, FollowsTheNamesOfItsColumns) {
  const NamedPoints ground_truth = read_landmarks(data_file("landmarks/groundtruth.csv"));
  EXPECT_EQ(ground_truth.names[2], "desk, left");
  EXPECT_EQ(ground_truth.positions_m(2, 0), 3.5);
  EXPECT_EQ(ground_truth.positions_m(2, 1), 2.75);
}

TEST(LandmarksCsv, ReadsMrclamsGroundtruthToo) {
  const NamedPoints ground_truth = read_landmarks(data_file("mrclam/Landmark_Groundtruth.dat"));
  EXPECT_EQ(ground_truth.names, (std::vector<std::string>{"6", "7", "8"}));
  EXPECT_EQ(ground_truth.positions_m(0, 1), -1.25);
}

TEST(LandmarksCsv, NamesTheLineThatIsWrong) {
  EXPECT_EQ(landmarks_error("a,0,0\nb,nan,0\n"), "line 2: a coordinate is missing");
  EXPECT_EQ(landmarks_error("a,0,0\nb,,0\n"), "line 2: a coordinate is missing");
  EXPECT_EQ(landmarks_error("a,0,inf\n"),
            "line 1: coordinates are in metres, at most 1000000000, got \"inf\"");
  EXPECT_EQ(landmarks_error("a,0,0\nb,0,zero\n"), "line 2: \"zero\" is not a number");
  EXPECT_EQ(landmarks_error("a,0,0\nb,0\n"), "line 2: has 2 cells, expected name, x, y");
  EXPECT_EQ(landmarks_error("a,0,0\nb,1,1\na,2,2\n"),
            "line 3: landmark \"a\" is already on line 1");
  EXPECT_EQ(landmarks_error(",0,0\n"), "line 1: a landmark without a name");
  EXPECT_EQ(landmarks_error("name,up,down\na,0,0\n"),
            "line 1: expected the columns name, x, y; got \"name,up,down\"; --columns "
            "landmark=HEADER,x=HEADER,y=HEADER names others");
  EXPECT_EQ(landmarks_error("name,x,y\n"), "holds no landmarks");
  EXPECT_EQ(landmarks_error(""), "is empty");
}

TEST(LandmarksCsv, ReadsTheUnitOfTheHeaderAndEastAndNorth) {
  const test::TemporaryFolder folder;
  const NamedPoints read =
      read_landmarks(folder.file("a.csv", "name,north [cm],east [km]\na,100,2\n"));
  EXPECT_DOUBLE_EQ(read.positions_m(0, 0), 2000.0);
  EXPECT_DOUBLE_EQ(read.positions_m(0, 1), 1.0);
}

}  // namespace
}  // namespace mapproof
