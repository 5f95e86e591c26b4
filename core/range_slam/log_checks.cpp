#include "core/range_slam/log_checks.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {

void check_ranges(const RangeLog& log) {
  const auto landmarks = static_cast<Eigen::Index>(log.landmarks.size());
  double last_s = -HUGE_VAL;
  for (const RangeReading& reading : log.ranges) {
    if (reading.landmark < 0 || reading.landmark >= landmarks || !std::isfinite(reading.range_m) ||
        !std::isfinite(reading.time_s))
      throw InvalidInput("a range must be finite and of a landmark of the log");
    if (reading.time_s < last_s) throw InvalidInput("the ranges of a log must ascend in time");
    last_s = reading.time_s;
  }
}

std::string known_problem(const KnownLandmarks& known, Eigen::Index n) {
  if (known.positions_m.rows() != static_cast<Eigen::Index>(known.rows.size()) ||
      !known.positions_m.allFinite())
    return "known landmarks need a finite place each";
  for (const Eigen::Index row : known.rows)
    if (row < 0 || row >= n) return fmt::format("no landmark is number {}", row);
  return "";
}

}  // namespace mapproof
