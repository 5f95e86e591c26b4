#include "core/range_slam/log_checks.hpp"

#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/linalg/planarity.hpp"

namespace mapproof {
namespace {

/// Longer ranges are not ranges; their fourth powers must not overflow.
constexpr double kLongest_m = 1e9;

template <StatusReason kReason>
std::optional<Status> on_a_line(const Points& points) {
  const double flatness = points.allFinite() ? planarity(points) : 1.0;
  if (flatness > kNearlyFlat) return std::nullopt;
  return status_of<kReason>(1.0 / flatness);
}

}  // namespace

void check_ranges(const std::vector<RangeMeasurement>& ranges, Eigen::Index landmarks) {
  double last_s = -HUGE_VAL;
  for (const RangeMeasurement& measured : ranges) {
    if (measured.landmark < 0 || measured.landmark >= landmarks)
      throw InvalidInput("a range is to none of the landmarks");
    if (!(measured.range_m >= 0.0 && measured.range_m < kLongest_m))
      throw InvalidInput(fmt::format("ranges must be at least 0 and below {:g} m", kLongest_m));
    if (!std::isfinite(measured.time_s) || measured.time_s < last_s)
      throw InvalidInput("the times of ranges must be finite and ascend");
    last_s = measured.time_s;
  }
}

std::vector<bool> heard_between(const RangeLog& log, double first_s, double last_s) {
  std::vector<bool> is_heard(log.landmarks.size(), false);
  for (const RangeMeasurement& measured : log.ranges)
    if (measured.time_s >= first_s && measured.time_s <= last_s)
      is_heard[static_cast<std::size_t>(measured.landmark)] = true;
  return is_heard;
}

void report_unplaced(const RangeLog& log, const std::vector<bool>& is_placed,
                     std::vector<Status>& statuses) {
  std::vector<std::string> names;
  for (std::size_t n = 0; n < is_placed.size(); ++n)
    if (!is_placed[n]) names.push_back(log.landmarks[n]);
  if (!names.empty()) statuses.push_back(status_of<StatusReason::kTooFewRanges>(std::move(names)));
}

std::optional<Status> landmarks_on_a_line(const Points& landmarks_m) {
  return on_a_line<StatusReason::kLandmarksNearlyOnALine>(landmarks_m);
}

std::optional<Status> path_on_a_line(const Points& positions_m) {
  return on_a_line<StatusReason::kPathNearlyOnALine>(positions_m);
}

}  // namespace mapproof
