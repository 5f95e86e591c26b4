#include "core/align/path_at.hpp"

#include <algorithm>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {

Points positions_at(const Trajectory& path, const Eigen::VectorXd& times_s) {
  const Eigen::VectorXd& own = path.time_s;
  if (const std::string problem = times_problem(path); !problem.empty())
    throw InvalidInput(problem);
  Points positions = Points::Constant(times_s.size(), 2, kNaN);
  for (Eigen::Index i = 0; i < times_s.size(); ++i) {
    const auto after = std::lower_bound(own.begin(), own.end(), times_s(i)) - own.begin();
    if (after == own.size()) continue;
    if (own(after) == times_s(i)) {
      positions.row(i) = path.positions_m.row(after);
    } else if (after > 0) {
      const double share = (times_s(i) - own(after - 1)) / (own(after) - own(after - 1));
      positions.row(i) =
          (1.0 - share) * path.positions_m.row(after - 1) + share * path.positions_m.row(after);
    }
  }
  return positions;
}

}  // namespace mapproof
