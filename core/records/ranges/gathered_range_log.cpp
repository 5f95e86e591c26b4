#include "core/records/ranges/gathered_range_log.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/base/median.hpp"

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

std::vector<std::string> odometry_remarks(const std::vector<Motion>& motions) {
  std::vector<std::string> remarks;
  constexpr std::size_t kFewest = 20;
  constexpr double kFastTurn = 3.0;     // rad/s in the mean: a robot turns slower.
  constexpr double kSharpTurn = 6.0;    // rad per metre in the mean.
  constexpr double kGrowth = 1.5;       // Of the last distance, over the median one.
  constexpr double kMostlyGrows = 0.8;  // Share of the rows.
  if (motions.size() < kFewest) return remarks;
  double turned = 0.0, way_m = 0.0, sharpest = 0.0;
  std::size_t grows = 0, shrinks = 0;
  std::vector<double> distances;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Motion& motion = motions[i];
    turned += std::abs(motion.heading_change_rad);
    sharpest = std::max(sharpest, std::abs(motion.heading_change_rad));
    way_m += std::hypot(motion.distance_m, motion.sideways_m);
    distances.push_back(motion.distance_m);
    if (i == 0) continue;
    const double growth_m = motion.distance_m - motions[i - 1].distance_m;
    grows += growth_m > 0.0 ? 1 : 0;
    shrinks += growth_m < 0.0 ? 1 : 0;
  }
  const double seconds = motions.back().time_s - motions.front().time_s;
  if (sharpest > std::numbers::pi || turned > kFastTurn * seconds || turned > kSharpTurn * way_m)
    remarks.push_back(fmt::format(
        "In radians, the odometry turns by {:.3g} rad/s in the mean and by up to {:.3g} rad at "
        "once. If its headings are in degrees, name the unit in the header (dheading_deg); if they "
        "are headings, give their changes.",
        turned / seconds, sharpest));
  const double last_m = motions.back().distance_m;
  if (shrinks == 0 && static_cast<double>(grows) > kMostlyGrows * double(distances.size()) &&
      last_m > kGrowth * median(distances))
    remarks.push_back(
        "The distances of the odometry grow from row to row. If they are the whole way since the "
        "start, give the way since the row before.");
  return remarks;
}

}  // namespace mapproof
