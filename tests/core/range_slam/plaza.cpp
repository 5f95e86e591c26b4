#include "tests/core/range_slam/plaza.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "core/score/trajectory_error.hpp"

namespace mapproof::test {
namespace {

using Row = std::vector<double>;

std::vector<Row> rows_of(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  std::vector<Row> rows;
  std::string line;
  std::getline(file, line);  // names
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    Row row;
    for (double value = 0.0; fields >> value;) row.push_back(value);
    rows.push_back(row);
  }
  return rows;
}

Trajectory truth_of(const std::vector<Row>& rows) {
  Trajectory truth;
  const auto T = std::ssize(rows);
  truth.time_s.resize(T);
  truth.positions_m.resize(T, 2);
  truth.heading_rad.resize(T);
  for (Eigen::Index t = 0; t < T; ++t) {
    const Row& row = rows[static_cast<std::size_t>(t)];
    truth.time_s(t) = row[0];
    truth.positions_m.row(t) << row[1], row[2];
    truth.heading_rad(t) = row[3];
  }
  return truth;
}

Trajectory integrated(const Row& start, const std::vector<Row>& motions) {
  Trajectory path;
  const auto T = std::ssize(motions) + 1;
  path.time_s.resize(T);
  path.positions_m.resize(T, 2);
  path.heading_rad.resize(T);
  path.time_s(0) = start[0];
  path.positions_m.row(0) << start[1], start[2];
  path.heading_rad(0) = start[3];
  for (Eigen::Index t = 1; t < T; ++t) {
    const Row& motion = motions[static_cast<std::size_t>(t - 1)];
    const double heading = path.heading_rad(t - 1);
    path.time_s(t) = motion[0];
    path.positions_m.row(t) = path.positions_m.row(t - 1) +
                              motion[1] * Eigen::RowVector2d(std::cos(heading), std::sin(heading));
    path.heading_rad(t) = heading + motion[2];
  }
  return path;
}

}  // namespace

std::optional<Plaza> plaza(const std::string& name) {
  const char* folder = std::getenv("MAPPROOF_PLAZA");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  const std::string prefix = std::string(folder) + "/" + name + "/";
  Plaza plaza;
  const std::vector<Row> landmarks = rows_of(prefix + "landmarks.csv");
  plaza.log.true_landmarks = Points(std::ssize(landmarks), 2);
  for (std::size_t n = 0; n < landmarks.size(); ++n) {
    plaza.log.landmarks.push_back(std::to_string(static_cast<int>(landmarks[n][0])));
    plaza.log.true_landmarks->row(std::ptrdiff_t(n)) << landmarks[n][1], landmarks[n][2];
  }
  for (const Row& row : rows_of(prefix + "ranges.csv")) {
    const auto found = std::ranges::find(landmarks, row[1], [](const Row& r) { return r[0]; });
    plaza.log.ranges.push_back(
        {.time_s = row[0], .landmark = found - landmarks.begin(), .range_m = row[2]});
  }
  plaza.log.truth = truth_of(rows_of(prefix + "groundtruth.csv"));
  plaza.odometry = integrated(rows_of(prefix + "odometry_drp_start.csv").at(0),
                              rows_of(prefix + "odometry_drp.csv"));
  return plaza;
}

double mean_error_m(const Plaza& plaza, const SlamEstimate& estimate, Alignment alignment) {
  const auto error =
      trajectory_error(estimate, *plaza.log.truth, plaza.log.true_landmarks, alignment);
  return error ? error->mean_m : std::numeric_limits<double>::infinity();
}

}  // namespace mapproof::test
