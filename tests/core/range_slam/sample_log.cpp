#include "tests/core/range_slam/sample_log.hpp"

#include <matio.h>

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace mapproof::test {
namespace {

void add_table(mat_t* file, const char* name, Eigen::MatrixXd values, bool is_compressed) {
  std::size_t dims[2] = {static_cast<std::size_t>(values.rows()),
                         static_cast<std::size_t>(values.cols())};
  matvar_t* variable = Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, values.data(), 0);
  const int problem =
      Mat_VarWrite(file, variable, is_compressed ? MAT_COMPRESSION_ZLIB : MAT_COMPRESSION_NONE);
  Mat_VarFree(variable);
  if (problem != 0) throw std::runtime_error("matio wrote no variable");
}

Eigen::MatrixXd path_table(const RangeLog& log) {
  Eigen::MatrixXd values(log.ground_truth->size(), 4);
  values << log.ground_truth->time_s, log.ground_truth->positions_m, log.ground_truth->heading_rad;
  return values;
}

std::string number(double value) { return fmt::format("{}", value); }

}  // namespace

RangeLog sample_log() {
  RangeLog log{.name = "sample",
               .landmarks = {"0", "1", "5"},
               .ranges = {},
               .start = {.time_s = 10.0, .x_m = 1.0, .y_m = 2.0, .heading_rad = 0.25},
               .odometry = {},
               .ground_truth = Trajectory{},
               .true_landmarks = Points(3, 2),
               .remarks = {}};
  *log.true_landmarks << -4.0, 3.0, 9.0, -1.5, 5.0, 12.0;
  constexpr Eigen::Index kPoses = 13;
  Trajectory& path = *log.ground_truth;
  path.time_s.setLinSpaced(kPoses, 10.0, 16.0);
  path.positions_m.resize(kPoses, 2);
  path.heading_rad.resize(kPoses);
  Eigen::RowVector2d position(log.start.x_m, log.start.y_m);
  double heading = log.start.heading_rad;
  for (Eigen::Index i = 0; i < kPoses; ++i) {
    path.positions_m.row(i) = position;
    path.heading_rad(i) = heading;
    for (const Eigen::Index landmark : {i % 3, (i + 1) % 3})
      if (i > 0)
        log.ranges.push_back({.time_s = path.time_s(i),
                              .landmark = landmark,
                              .range_m = (log.true_landmarks->row(landmark) - position).norm()});
    if (i + 1 == kPoses) break;
    const Motion motion{.time_s = path.time_s(i + 1),
                        .distance_m = 0.5 + 0.05 * static_cast<double>(i),
                        .heading_change_rad = i == 5 ? 1.0 : 0.02,
                        .sideways_m = 0.0};
    log.odometry.push_back(motion);
    position += motion.distance_m * Eigen::RowVector2d(std::cos(heading), std::sin(heading));
    heading += motion.heading_change_rad;
  }
  return log;
}

std::string ranges_csv_of(const RangeLog& log) {
  std::string text = "t,beacon,range,raw_row\n";
  for (const RangeMeasurement& measured : log.ranges)
    text +=
        fmt::format("{},{},{},7\n", measured.time_s,
                    log.landmarks[static_cast<std::size_t>(measured.landmark)], measured.range_m);
  return text;
}

std::string odometry_csv_of(const RangeLog& log) {
  std::string text = "dheading,t,ddist\n";
  for (const Motion& motion : log.odometry)
    text += fmt::format("{},{},{}\n", motion.heading_change_rad, motion.time_s, motion.distance_m);
  return text;
}

std::string start_csv_of(const RangeLog& log) {
  return fmt::format("t,x,y,heading\n{},{},{},{}\n", log.start.time_s, log.start.x_m, log.start.y_m,
                     log.start.heading_rad);
}

std::string ground_truth_csv_of(const RangeLog& log) {
  std::string text = "t,x,y,heading\n";
  const Eigen::MatrixXd values = path_table(log);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    text += fmt::format("{},{},{},{}\n", values(i, 0), values(i, 1), values(i, 2), values(i, 3));
  return text;
}

std::string landmarks_csv_of(const RangeLog& log) {
  std::string text = "id,x,y\n";
  for (std::size_t i = 0; i < log.landmarks.size(); ++i) {
    const auto row = log.true_landmarks->row(static_cast<Eigen::Index>(i));
    text += fmt::format("{},{},{}\n", log.landmarks[i], row(0), row(1));
  }
  return text;
}

std::string pyfg_of(const RangeLog& log) {
  const Eigen::MatrixXd path = path_table(log);
  std::string text;
  for (Eigen::Index i = 0; i < path.rows(); ++i)
    text += fmt::format("VERTEX_SE2 {} A{} {} {} {}\n", path(i, 0), i, path(i, 1), path(i, 2),
                        path(i, 3));
  for (std::size_t i = 0; i < log.landmarks.size(); ++i) {
    const auto row = log.true_landmarks->row(static_cast<Eigen::Index>(i));
    text += fmt::format("VERTEX_XY L{} {} {}\n", log.landmarks[i], row(0), row(1));
  }
  for (std::size_t i = 0; i < log.odometry.size(); ++i)
    text += fmt::format("EDGE_SE2 {} A{} A{} {} 0 {} 1 0 0 1 0 1\n", log.odometry[i].time_s, i,
                        i + 1, log.odometry[i].distance_m, log.odometry[i].heading_change_rad);
  for (const RangeMeasurement& measured : log.ranges)
    text +=
        fmt::format("EDGE_RANGE {} A{} L{} {} 0.25\n", measured.time_s,
                    std::lround(2.0 * (measured.time_s - 10.0)),
                    log.landmarks[static_cast<std::size_t>(measured.landmark)], measured.range_m);
  return text;
}

std::string td_text_of(const RangeLog& log) {
  std::string text;
  for (const RangeMeasurement& measured : log.ranges)
    text += "  " + number(measured.time_s) + "\t 2.0e+000\t " +
            log.landmarks[static_cast<std::size_t>(measured.landmark)] + "\t " +
            number(measured.range_m) + "\t \n";
  return text;
}

std::string dr_text_of(const RangeLog& log) {
  std::string text;
  for (const Motion& motion : log.odometry)
    text += number(motion.time_s) + " " + number(motion.distance_m) + " " +
            number(motion.heading_change_rad) + "\n";
  return text;
}

std::filesystem::path csv_folder(const TemporaryFolder& folder, const RangeLog& log) {
  folder.file("set/odometry.csv", odometry_csv_of(log));
  folder.file("set/odometry_start.csv", start_csv_of(log));
  folder.file("set/groundtruth.csv", ground_truth_csv_of(log));
  folder.file("set/landmarks.csv", landmarks_csv_of(log));
  return folder.file("set/ranges.csv", ranges_csv_of(log)).parent_path();
}

void write_mat(const RangeLog& log, const std::filesystem::path& path, bool is_compressed) {
  mat_t* file = Mat_CreateVer(path.c_str(), "MATLAB 5.0 MAT-file, made by a test", MAT_FT_MAT5);
  if (file == nullptr) throw std::runtime_error("matio made no file");
  Eigen::MatrixXd motions(static_cast<Eigen::Index>(log.odometry.size()), 3);
  for (Eigen::Index i = 0; i < motions.rows(); ++i) {
    const Motion& motion = log.odometry[static_cast<std::size_t>(i)];
    motions.row(i) << motion.time_s, motion.distance_m, motion.heading_change_rad;
  }
  Eigen::MatrixXd ranges(static_cast<Eigen::Index>(log.ranges.size()), 4);
  for (Eigen::Index i = 0; i < ranges.rows(); ++i) {
    const RangeMeasurement& measured = log.ranges[static_cast<std::size_t>(i)];
    const double id = std::stod(log.landmarks[static_cast<std::size_t>(measured.landmark)]);
    ranges.row(i) << measured.time_s, 2.0, id, measured.range_m;
  }
  Eigen::MatrixXd landmarks(log.true_landmarks->rows(), 3);
  for (Eigen::Index i = 0; i < landmarks.rows(); ++i)
    landmarks.row(i) << std::stod(log.landmarks[static_cast<std::size_t>(i)]),
        log.true_landmarks->row(i);
  add_table(file, "DR", motions, is_compressed);
  add_table(file, "DRp", path_table(log), is_compressed);
  add_table(file, "GT", path_table(log), is_compressed);
  add_table(file, "TD", ranges, is_compressed);
  add_table(file, "TL", landmarks, is_compressed);
  Mat_Close(file);
}

bool remarks_hold(const RangeLog& log, std::string_view words) {
  for (const std::string& remark : log.remarks)
    if (remark.find(words) != std::string::npos) return true;
  return false;
}

void expect_same(const RangeLog& log, const RangeLog& expected, double tolerance) {
  ASSERT_EQ(log.ranges.size(), expected.ranges.size());
  for (std::size_t i = 0; i < log.ranges.size(); ++i) {
    EXPECT_EQ(log.ranges[i].time_s, expected.ranges[i].time_s);
    EXPECT_EQ(log.ranges[i].landmark, expected.ranges[i].landmark);
    EXPECT_EQ(log.ranges[i].range_m, expected.ranges[i].range_m);
  }
  ASSERT_EQ(log.odometry.size(), expected.odometry.size());
  for (std::size_t i = 0; i < log.odometry.size(); ++i) {
    EXPECT_EQ(log.odometry[i].time_s, expected.odometry[i].time_s);
    EXPECT_NEAR(log.odometry[i].distance_m, expected.odometry[i].distance_m, tolerance);
    if (i + 1 < log.odometry.size() || tolerance == 0.0) {
      EXPECT_NEAR(log.odometry[i].heading_change_rad, expected.odometry[i].heading_change_rad,
                  tolerance);
    }
    EXPECT_EQ(log.odometry[i].sideways_m, 0.0);
  }
}

}  // namespace mapproof::test
