#include "core/records/observations/trajectories.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/csv.hpp"
#include "core/json/text_input.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {
namespace {

bool has_heading(const Trajectory& path) { return path.heading_rad.size() > 0; }

void check(const Trajectory& path) {
  if (const std::string problem = path_problem(path); !problem.empty()) throw InvalidInput(problem);
}

}  // namespace

std::string trajectory_tum(const Trajectory& path) {
  check(path);
  std::string text;
  for (Eigen::Index i = 0; i < path.size(); ++i) {
    const double half = has_heading(path) ? 0.5 * path.heading_rad(i) : 0.0;
    fmt::format_to(std::back_inserter(text), "{} {} {} 0 0 0 {} {}\n", path.time_s(i),
                   path.positions_m(i, 0), path.positions_m(i, 1), std::sin(half), std::cos(half));
  }
  return text;
}

Trajectory parse_trajectory_tum(std::string_view text, const std::string& source) {
  constexpr std::size_t kColumns = 8;
  TableReader reader(checked_text(text, source), source, TableReader::kBlanks);
  TableRow row;
  std::vector<std::array<double, kColumns>> poses;
  while (reader.next(row)) {
    if (row.cells.front().starts_with('#')) continue;
    const std::string location = fmt::format("line {}", row.line);
    if (row.cells.size() != kColumns)
      throw IoError(source, location,
                    fmt::format("has {} numbers, expected {}: t x y z qx qy qz qw",
                                row.cells.size(), kColumns));
    std::array<double, kColumns>& pose = poses.emplace_back();
    for (std::size_t i = 0; i < kColumns; ++i) {
      const std::optional<double> number = number_in(row.cells[i]);
      if (!number || !std::isfinite(*number))
        throw IoError(source, location, number_problem(row.cells[i]));
      pose[i] = *number;
    }
    if (pose[4] == 0.0 && pose[5] == 0.0 && pose[6] == 0.0 && pose[7] == 0.0)
      throw IoError(
          source, location,
          "the quaternion qx qy qz qw is 0 0 0 0, which is not an orientation; without one it "
          "is 0 0 0 1");
    if (poses.size() < 2) continue;
    const double before = poses[poses.size() - 2][0];
    if (pose[0] < before)
      throw IoError(source, location, "its time is before that of the pose above");
    if (pose[0] == before) poses.pop_back();  // As motion capture repeats one now and then.
  }
  if (poses.empty()) throw IoError(source, "has no pose");
  const auto count = std::ssize(poses);
  Trajectory path{.time_s = Eigen::VectorXd(count),
                  .positions_m = Points(count, 2),
                  .heading_rad = Eigen::VectorXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [t, x, y, z, qx, qy, qz, qw] = poses[static_cast<std::size_t>(i)];
    path.time_s(i) = t;
    path.positions_m.row(i) << x, y;
    path.heading_rad(i) = std::atan2(2.0 * (qw * qz + qx * qy), 1.0 - 2.0 * (qy * qy + qz * qz));
  }
  return path;
}

std::string trajectory_csv(const Trajectory& path) {
  check(path);
  std::string text = has_heading(path) ? "time_s,x_m,y_m,heading_rad\r\n" : "time_s,x_m,y_m\r\n";
  for (Eigen::Index i = 0; i < path.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{},{}", path.time_s(i), path.positions_m(i, 0),
                   path.positions_m(i, 1));
    if (has_heading(path)) fmt::format_to(std::back_inserter(text), ",{}", path.heading_rad(i));
    text += "\r\n";
  }
  return text;
}

std::string landmarks_csv(const std::vector<std::string>& names, const Points& positions_m) {
  if (positions_m.rows() != static_cast<Eigen::Index>(names.size()))
    throw InvalidInput("landmarks need a name each");
  std::string text = "name,x_m,y_m\r\n";
  for (Eigen::Index i = 0; i < positions_m.rows(); ++i)
    if (positions_m.row(i).allFinite())
      text += fmt::format("{},{},{}\r\n", csv_field(names[static_cast<std::size_t>(i)]),
                          positions_m(i, 0), positions_m(i, 1));
  return text;
}

}  // namespace mapproof
