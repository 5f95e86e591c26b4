#include "tests/support/slam_checks.hpp"

#include <algorithm>
#include <limits>

#include "core/score/trajectory_error.hpp"

namespace mapproof::test {

bool has(const std::vector<Status>& statuses, StatusCode code) {
  return std::ranges::find(statuses, code, &Status::code) != statuses.end();
}

KnownLandmarks all_known(const RangeLog& log) {
  KnownLandmarks known{.rows = {}, .positions_m = *log.true_landmarks};
  for (Eigen::Index n = 0; n < known.positions_m.rows(); ++n) known.rows.push_back(n);
  return known;
}

double mean_error_m(const RangeLog& log, const SlamEstimate& estimate, Alignment alignment) {
  const auto error = trajectory_error(estimate, *log.ground_truth, log.true_landmarks, alignment);
  return error ? error->mean_m : std::numeric_limits<double>::infinity();
}

}  // namespace mapproof::test
