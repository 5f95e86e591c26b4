#include "core/range_slam/factors/windowed_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/align/path_at.hpp"
#include "core/base/errors.hpp"
#include "core/range_slam/log_checks.hpp"

namespace mapproof {
namespace {

/// Windows that lie over any one time.
constexpr double kOverlap = 4.0;
/// Readings that a window needs.
constexpr Eigen::Index kReadingsToInterpolate = 6;

/// Windows to a landmark.
constexpr double kMostWindows = 1e6;
/// A window's least say in a mean, at its ends.
constexpr double kLeastSay = 1e-3;

/// Windows of one length, evenly over a stretch of time.
struct WindowGrid {
  double first_center_s;
  double spacing_s;
  Eigen::Index count;
  double half_s;

  WindowGrid(double first_s, double last_s, double length_s) : half_s(0.5 * length_s) {
    const double room = last_s - first_s - length_s;
    if (!(room > 0.0)) {
      first_center_s = 0.5 * (first_s + last_s);
      half_s = std::max(half_s, 0.5 * (last_s - first_s));
      spacing_s = length_s;
      count = 1;
      return;
    }
    const double steps = std::ceil(room * kOverlap / length_s);
    if (steps > kMostWindows)
      throw InvalidInput("windows are too short for the time they are to cover");
    count = static_cast<Eigen::Index>(steps) + 1;
    first_center_s = first_s + half_s;
    spacing_s = room / steps;
  }

  double center_s(Eigen::Index i) const { return first_center_s + double(i) * spacing_s; }
};

/// First and number of ascending times within a window.
struct Slice {
  Eigen::Index first;
  Eigen::Index count;

  Slice(const Eigen::VectorXd& time_s, double from_s, double to_s) {
    const auto begin = std::lower_bound(time_s.begin(), time_s.end(), from_s);
    first = begin - time_s.begin();
    count = std::upper_bound(begin, time_s.end(), to_s) - begin;
  }
};

void check_length(double length_s) {
  if (!(length_s > 0.0) || !std::isfinite(length_s))
    throw InvalidInput("a window's length must be above 0");
}

void check(const Eigen::VectorXd& time_s, const WindowOptions& options) {
  check_length(options.length_s);
  if (!(options.range_scale > 0.0) || !std::isfinite(options.range_scale))
    throw InvalidInput("a range scale must be above 0");
  if (!time_s.allFinite() || !std::is_sorted(time_s.begin(), time_s.end()))
    throw InvalidInput("times must be finite and ascend");
}

}  // namespace

std::string windowed_size_problem(Eigen::Index landmarks, Eigen::Index times) {
  if (static_cast<double>(landmarks) * static_cast<double>(times) <= kMostWindowedRanges) return "";
  return fmt::format(
      "ranges to {} landmarks at {} times are more than {:g}: give fewer poses or landmarks",
      landmarks, times, kMostWindowedRanges);
}

std::vector<LandmarkReadings> readings_by_landmark(const std::vector<RangeReading>& ranges,
                                                   Eigen::Index landmarks, const Trajectory& path) {
  if (const std::string problem = path_problem(path); !problem.empty()) throw InvalidInput(problem);
  check_ranges(ranges, landmarks);
  std::vector<std::vector<Eigen::Index>> rows(static_cast<std::size_t>(landmarks));
  std::vector<double> time_s, range_m;
  for (const RangeReading& reading : ranges) {
    if (path.size() == 0 || reading.time_s < path.time_s(0) ||
        reading.time_s > path.time_s(path.size() - 1))
      continue;
    rows[static_cast<std::size_t>(reading.landmark)].push_back(std::ssize(time_s));
    time_s.push_back(reading.time_s);
    range_m.push_back(reading.range_m);
  }
  const LandmarkReadings all{
      .time_s = Eigen::Map<Eigen::VectorXd>(time_s.data(), std::ssize(time_s)),
      .positions_m =
          positions_at(path, Eigen::Map<Eigen::VectorXd>(time_s.data(), std::ssize(time_s))),
      .range_m = Eigen::Map<Eigen::VectorXd>(range_m.data(), std::ssize(range_m))};
  std::vector<LandmarkReadings> result;
  result.reserve(rows.size());
  for (const std::vector<Eigen::Index>& own : rows) result.push_back(all.at(own));
  return result;
}

Eigen::VectorXd windowed_half_squares(const LandmarkReadings& readings,
                                      const Eigen::VectorXd& time_s, const Points& path_m,
                                      const WindowOptions& options) {
  check(time_s, options);
  if (path_m.rows() != time_s.size()) throw InvalidInput("a path needs a position for each time");
  if (time_s.size() == 0) return {};
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(time_s.size());
  Eigen::ArrayXd weight = Eigen::ArrayXd::Zero(time_s.size());
  const WindowGrid grid(time_s(0), time_s(time_s.size() - 1), options.length_s);
  for (Eigen::Index i = 0; i < grid.count; ++i) {
    const double from_s = grid.center_s(i) - grid.half_s, to_s = grid.center_s(i) + grid.half_s;
    const Slice inside(readings.time_s, from_s, to_s);
    if (inside.count < kReadingsToInterpolate) continue;
    const LocalRange local =
        fit_local_range(readings, inside.first, inside.count, options.range_scale);
    const Slice asked(time_s, from_s, to_s);
    for (Eigen::Index t = asked.first; t < asked.first + asked.count; ++t) {
      const double off_center = std::abs(time_s(t) - grid.center_s(i)) / grid.half_s;
      const double w = std::max(kLeastSay, 1.0 - off_center) / local.variance(path_m.row(t));
      sum(t) += w * local.squared_range(path_m.row(t));
      weight(t) += w;
    }
  }
  return 0.5 * (sum / weight) / (options.range_scale * options.range_scale);
}

WindowedRanges windowed_ranges(const std::vector<LandmarkReadings>& readings,
                               const Trajectory& path, const Eigen::VectorXd& time_s,
                               const WindowOptions& options) {
  check(time_s, options);
  if (const std::string problem = windowed_size_problem(std::ssize(readings), time_s.size());
      !problem.empty())
    throw InvalidInput(problem);
  const Points path_m = positions_at(path, time_s);
  if (!path_m.allFinite()) throw InvalidInput("ranges are asked for beyond the path");
  Eigen::MatrixXd Y(std::ssize(readings), time_s.size());
  for (Eigen::Index n = 0; n < Y.rows(); ++n)
    Y.row(n) =
        windowed_half_squares(readings[static_cast<std::size_t>(n)], time_s, path_m, options);
  WindowedRanges result;
  for (Eigen::Index n = 0; n < Y.rows(); ++n)
    result.told.push_back(Y.row(n).array().isFinite().count());
  for (Eigen::Index t = 0; t < Y.cols(); ++t)
    if (Y.col(t).allFinite()) result.columns.push_back(t);
  if (std::ssize(result.columns) == Y.cols())
    result.Y = std::move(Y);
  else
    result.Y = Y(Eigen::all, result.columns);
  return result;
}

double range_scale_of(const std::vector<LandmarkReadings>& readings, double first_s, double last_s,
                      double length_s) {
  check_length(length_s);
  if (!std::isfinite(first_s) || !std::isfinite(last_s) || first_s > last_s)
    throw InvalidInput("times must be finite and ascend");
  const WindowGrid grid(first_s, last_s, length_s);
  double sum = 0.0, weight = 0.0;
  for (const LandmarkReadings& landmark : readings)
    for (Eigen::Index i = 0; i < grid.count; ++i) {
      const Slice inside(landmark.time_s, grid.center_s(i) - grid.half_s,
                         grid.center_s(i) + grid.half_s);
      const ScaleEvidence evidence = local_scale(landmark, inside.first, inside.count);
      sum += evidence.weight * evidence.squared_scale;
      weight += evidence.weight;
    }
  const double squared = weight > 0.0 ? sum / weight : 1.0;
  return squared > 0.0 ? std::sqrt(squared) : 1.0;
}

}  // namespace mapproof
