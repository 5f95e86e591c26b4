#include "core/records/trajectory_files.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/base/csv.hpp"
#include "core/base/errors.hpp"

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
