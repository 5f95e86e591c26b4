#include "core/model/range_log.hpp"

#include <algorithm>
#include <functional>

namespace mapproof {

std::string times_problem(const Trajectory& path) {
  if (path.positions_m.rows() != path.size() ||
      (path.heading_rad.size() > 0 && path.heading_rad.size() != path.size()))
    return "a path needs a position, and a heading or none, for each of its times";
  const Eigen::VectorXd& times = path.time_s;
  if (!times.allFinite() ||
      std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) != times.end())
    return "the times of a path must be finite and ascend";
  return "";
}

std::string path_problem(const Trajectory& path) {
  if (std::string problem = times_problem(path); !problem.empty()) return problem;
  if (!path.positions_m.allFinite() || !path.heading_rad.allFinite())
    return "the positions and headings of a path must be finite";
  return "";
}

}  // namespace mapproof
