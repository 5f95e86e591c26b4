#include "core/records/evaluations/space_path_text.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/records/evaluations/pose_errors_csv.hpp"
#include "tests/support/byte_sources.hpp"

namespace mapproof {
namespace {

SpacePath path_of(const std::string& text) {
  ByteSource source = test::source_of(text);
  return read_space_path(source);
}

std::string error_of(const std::string& text) {
  try {
    path_of(text);
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

TEST(SpacePathText, ReadsTheSamePoseInEveryFormat) {
  // 90 degrees about z at (1, 2, 3).
  const SpacePath tum = path_of("# t x y z qx qy qz qw\n5 1 2 3 0 0 2 2\n");
  const SpacePath kitti = path_of("0 -1 0 1 1 0 0 2 0 0 1 3\n");
  const SpacePath euroc = path_of("#ns,x,y,z,w,x,y,z\n5000000000,1,2,3,1,0,0,1,9\n");
  const SpacePath graph = path_of("VERTEX_SE3:QUAT 7 1 2 3 0 0 1 1\nEDGE_SE2 0 1\n");
  for (const SpacePath* path : {&tum, &kitti, &euroc, &graph}) {
    ASSERT_EQ(path->size(), 1);
    EXPECT_EQ(path->positions_m.row(0), Eigen::RowVector3d(1.0, 2.0, 3.0));
    EXPECT_NEAR(path->orientations[0](1, 0), 1.0, 1e-15);
  }
  EXPECT_EQ(tum.time_s(0), 5.0);
  EXPECT_EQ(euroc.time_s(0), 5.0);
  EXPECT_TRUE(tum.has_times);
  EXPECT_FALSE(kitti.has_times);
  EXPECT_FALSE(graph.has_times);
}

TEST(SpacePathText, VerticesAreInTheOrderOfTheirNumbers) {
  const SpacePath path = path_of("VERTEX_SE2 2 4 0 0\nVERTEX_SE2 1 3 0 0\n");
  EXPECT_EQ(path.positions_m(0, 0), 3.0);
  EXPECT_EQ(path.positions_m(1, 0), 4.0);
}

TEST(SpacePathText, NamesTheLineOfWhatIsWrong) {
  EXPECT_NE(error_of("1 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n").find("line 2"), std::string::npos);
  EXPECT_NE(error_of("1 0 0 0 0 0 0 0\n").find("quaternion"), std::string::npos);
  EXPECT_NE(error_of("1 0 0\n").find("8 (TUM)"), std::string::npos);
  EXPECT_NE(error_of("1 0 0 nan 0 0 0 1\n").find("line 1"), std::string::npos);
  EXPECT_NE(error_of("2 0 0 0 0 1 0 0 0 0 1 0\n").find("rotation"), std::string::npos);
  EXPECT_NE(error_of("0.5,1,2,3,1,0,0,0\n").find("nanoseconds"), std::string::npos);
  EXPECT_NE(error_of("# nothing\n").find("no pose"), std::string::npos);
}

TEST(PoseErrorsCsv, ReadsBackWhatWasWritten) {
  PoseErrors errors{
      .time_s = Eigen::Vector2d(0.1, 0.3),
      .distance_m = Eigen::Vector2d(0.0, 1.0 / 3.0),
      .estimate_m = SpacePoints::Constant(2, 3, 1.0 / 7.0),
      .ground_truth_m = SpacePoints::Constant(2, 3, 1e300),
      .error_m = Eigen::Vector2d(0.7, 1e-17),
      .error_deg = Eigen::Vector2d(3.0, 4.0),
      .ground_truth_alone = {Eigen::Vector3d(0.0, 0.2, 0.3),
                             SpacePoints::Constant(3, 3, 1.0 / 9.0)},
      .estimate_alone = {Eigen::Vector2d(0.2, 0.4), SpacePoints::Constant(2, 3, 1.0 / 11.0)}};
  const PoseErrors again = parse_pose_errors_csv(pose_errors_csv(errors), "errors.csv");
  EXPECT_EQ(again.time_s, errors.time_s);
  EXPECT_EQ(again.distance_m, errors.distance_m);
  EXPECT_EQ(again.estimate_m, errors.estimate_m);
  EXPECT_EQ(again.ground_truth_m, errors.ground_truth_m);
  EXPECT_EQ(again.error_m, errors.error_m);
  EXPECT_EQ(again.error_deg, errors.error_deg);
  EXPECT_EQ(again.ground_truth_alone.time_s, errors.ground_truth_alone.time_s);
  EXPECT_EQ(again.ground_truth_alone.positions_m, errors.ground_truth_alone.positions_m);
  EXPECT_EQ(again.estimate_alone.time_s, errors.estimate_alone.time_s);
  EXPECT_EQ(again.estimate_alone.positions_m, errors.estimate_alone.positions_m);
  EXPECT_THROW(parse_pose_errors_csv("time_s,x_m\n1,2\n", "errors.csv"), IoError);
  EXPECT_THROW(
      parse_pose_errors_csv("pose,distance_m,x_m,y_m,true_x_m,true_y_m,error_m\n0,0,0,0,0,0,-1\n",
                            "errors.csv"),
      IoError);
}

TEST(PoseErrorsCsv, HasRowsOfOnePathAlone) {
  const std::string head = "time_s,distance_m,x_m,y_m,true_x_m,true_y_m,error_m\n";
  const PoseErrors errors = parse_pose_errors_csv(
      head + "1,,,,5,6,\n2,0,7,8,7,8,0\n3,,,,9,9,\n4,,1,2,,,\n", "errors.csv");
  EXPECT_EQ(errors.size(), 1);
  EXPECT_EQ(errors.ground_truth_alone.time_s, Eigen::Vector2d(1.0, 3.0));
  EXPECT_EQ(errors.ground_truth_alone.positions_m.row(0), Eigen::RowVector3d(5.0, 6.0, 0.0));
  EXPECT_EQ(errors.estimate_alone.time_s(0), 4.0);
  EXPECT_EQ(errors.estimate_alone.positions_m.row(0), Eigen::RowVector3d(1.0, 2.0, 0.0));
  for (const char* wrong : {"1,,,,5,,\n2,0,7,8,7,8,0\n",    // No position.
                            "1,,,3,5,6,\n2,0,7,8,7,8,0\n",  // Half an estimate.
                            "3,,,,5,6,\n2,0,7,8,7,8,0\n",   // Time descends.
                            "1,,,,5,6,\n"})                 // No associated pose.
    EXPECT_THROW(parse_pose_errors_csv(head + wrong, "errors.csv"), IoError) << wrong;
  EXPECT_THROW(parse_pose_errors_csv("pose,distance_m,x_m,y_m,true_x_m,true_y_m,error_m\n"
                                     "0,,,,5,6,\n1,0,7,8,7,8,0\n",
                                     "errors.csv"),
               IoError);
}

}  // namespace
}  // namespace mapproof
