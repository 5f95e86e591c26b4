#include "core/records/ranges/gathered_range_log.hpp"

namespace mapproof {

Eigen::VectorXd pose_times(const RangeLogParts& parts) {
  if (parts.odometry.empty()) return {};
  Eigen::VectorXd times_s(std::ssize(parts.odometry) + 1);
  for (Eigen::Index i = 0; i + 1 < times_s.size(); ++i)
    times_s(i + 1) = parts.odometry[static_cast<std::size_t>(i)].time_s;
  times_s(0) = parts.start          ? parts.start->time_s
               : times_s.size() > 2 ? 2.0 * times_s(1) - times_s(2)
                                    : times_s(1) - 1.0;
  return times_s;
}

}  // namespace mapproof
