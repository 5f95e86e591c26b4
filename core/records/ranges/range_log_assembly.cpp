#include "core/records/ranges/range_log_assembly.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "core/base/angle.hpp"
#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "core/records/limits.hpp"
#include "core/records/ranges/range_companions.hpp"
#include "core/records/tables/cells.hpp"

namespace mapproof {
namespace {

/// Mean cosine of heading and travel below which headings are off by 180 degrees.
constexpr double kTurnedAbout = -0.5;
/// Heading changes that differ by less are the same to the last digit.
constexpr double kSameHeadingChange_rad = 1e-9;
/// A log without a heading change above this does not turn.
constexpr double kSomeHeadingChange_rad = 1e-3;

/// A name as letters and the number behind them; empty if it is none such.
std::optional<std::pair<std::string_view, long long>> numbered(std::string_view name) {
  const std::size_t first = std::min(name.find_first_of("-0123456789"), name.size());
  long long number = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + first, end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return std::pair(name.substr(0, first), number);
}

std::vector<std::string> names_of(const RangeLogParts& parts) {
  std::vector<std::string> names;
  std::set<std::string_view> known;
  for (const NamedMeasurement& measured : parts.measurements)
    if (known.insert(measured.landmark).second) names.push_back(measured.landmark);
  if (names.size() > kMostRangeLandmarks)
    throw IoError(parts.source,
                  fmt::format("ranges to more than {} landmarks", kMostRangeLandmarks));
  if (std::ranges::all_of(names, [](const auto& name) { return numbered(name).has_value(); }))
    std::ranges::stable_sort(names, {}, [](const auto& name) { return *numbered(name); });
  return names;
}

std::map<std::string_view, Eigen::Index> rows_by_name(const std::vector<std::string>& names) {
  std::map<std::string_view, Eigen::Index> rows;
  for (const std::string& name : names) rows.emplace(name, std::ssize(rows));
  return rows;
}

/// @throws IoError for ranges so small that differences of positions vanish in rounding.
void check_unit(const std::string& source, const std::vector<RangeMeasurement>& ranges) {
  std::vector<double> lengths_m;
  for (const RangeMeasurement& range : ranges) lengths_m.push_back(range.range_m);
  if (const double middle_m = upper_median(lengths_m); middle_m < kLeastMedianRange_m)
    throw IoError(source,
                  fmt::format("the median of its ranges is {:g} m, expected at least {:g} m: "
                              "ranges are in metres",
                              middle_m, kLeastMedianRange_m));
}

void take_measurements(const RangeLogOptions& options, RangeLogParts& parts, RangeLog& log) {
  std::size_t jumps = 0;
  double farthest_s = 0.0;
  for (std::size_t i = 1; i < parts.measurements.size(); ++i) {
    const double back_s = parts.measurements[i - 1].time_s - parts.measurements[i].time_s;
    if (back_s > 0.0) ++jumps;
    farthest_s = std::max(farthest_s, back_s);
  }
  if (jumps > 0)
    log.remarks.push_back(fmt::format(
        "The stamps of the ranges jump back {}, by up to {:.1f} s: the ranges are sorted by time.",
        counted(static_cast<long long>(jumps), "time"), farthest_s));
  std::ranges::stable_sort(parts.measurements, {}, &NamedMeasurement::time_s);
  const std::map<std::string_view, Eigen::Index> rows = rows_by_name(log.landmarks);
  log.ranges.reserve(parts.measurements.size());
  std::size_t zeros = 0, repeated = 0;
  std::vector<double> last_s(log.landmarks.size(), -kInfinity);
  for (const NamedMeasurement& measured : parts.measurements) {
    const Eigen::Index row = rows.at(measured.landmark);
    double& last = last_s[static_cast<std::size_t>(row)];
    if (!(measured.range_m > 0.0)) {
      ++zeros;
    } else if (measured.time_s == last && !options.keeps_repeats) {
      ++repeated;
    } else {
      last = measured.time_s;
      log.ranges.push_back({.time_s = measured.time_s,
                            .landmark = row,
                            .range_m = measured.range_m,
                            .sigma_m = measured.sigma_m});
    }
  }
  if (zeros > 0)
    log.remarks.push_back(fmt::format("Left out, since a range of 0 is not an echo: {}.",
                                      counted(static_cast<long long>(zeros), "range")));
  if (repeated > 0)
    log.remarks.push_back(
        fmt::format("Left out, since they repeat landmark and stamp of another one: {}.",
                    counted(static_cast<long long>(repeated), "range")));
  if (log.ranges.empty()) throw IoError(parts.source, "holds no ranges but zeros");
  check_unit(parts.source, log.ranges);
}

void take_true_landmarks(const RangeLogParts& parts, RangeLog& log) {
  const NamedPoints& ground_truth = parts.true_landmarks;
  if (ground_truth.names.empty()) return;
  if (ground_truth.names.size() > kMostRangeLandmarks)
    throw IoError(parts.source,
                  fmt::format("true positions of more than {} landmarks", kMostRangeLandmarks));
  const std::map<std::string_view, Eigen::Index> rows = rows_by_name(log.landmarks);
  log.true_landmarks = Points::Constant(static_cast<Eigen::Index>(log.landmarks.size()), 2, kNaN);
  std::vector<std::string> unheard;
  for (std::size_t i = 0; i < ground_truth.names.size(); ++i) {
    const auto found = rows.find(ground_truth.names[i]);
    if (found == rows.end())
      unheard.push_back(ground_truth.names[i]);
    else
      log.true_landmarks->row(found->second) =
          ground_truth.positions_m.row(static_cast<Eigen::Index>(i));
  }
  if (!unheard.empty())
    log.remarks.push_back("Left out, since there is no range to them: landmarks " +
                          printable(listed(unheard, 10), 1000) + ".");
  std::vector<std::string> unsurveyed;
  for (std::size_t i = 0; i < log.landmarks.size(); ++i)
    if (!log.true_landmarks->row(static_cast<Eigen::Index>(i)).allFinite())
      unsurveyed.push_back(log.landmarks[i]);
  if (!unsurveyed.empty())
    log.remarks.push_back("No true position is given for the landmarks " +
                          printable(listed(unsurveyed, 10), 1000) + ".");
}

/// Mean cosine between heading and direction of travel, weighted by the way; 0 without any way.
double agreement(const Trajectory& path) {
  double sum = 0.0;
  double way_m = 0.0;
  for (Eigen::Index i = 0; i + 1 < path.size(); ++i) {
    const Eigen::RowVector2d step = path.positions_m.row(i + 1) - path.positions_m.row(i);
    const double heading = path.heading_rad(i);
    sum += step(0) * std::cos(heading) + step(1) * std::sin(heading);
    way_m += step.norm();
  }
  return way_m > 0.0 ? sum / way_m : 0.0;
}

void check_true_heading(RangeLog& log) {
  if (!log.ground_truth || log.ground_truth->heading_rad.size() == 0) return;
  double forward_m = 0.0;
  for (const Motion& motion : log.odometry) forward_m += motion.distance_m;
  const double cosine = agreement(*log.ground_truth) * (forward_m < 0.0 ? -1.0 : 1.0);
  if (cosine >= kTurnedAbout) return;
  log.ground_truth->heading_rad.array() += std::numbers::pi;
  log.remarks.push_back(
      "The true heading is off by 180 degrees from the direction of travel: it was rotated.");
}

void take_start(const RangeLogParts& parts, RangeLog& log) {
  if (log.odometry.empty()) {
    log.remarks.push_back("There is no odometry.");
    return;
  }
  const double first_s = log.odometry.front().time_s;
  if (parts.start) {
    log.start = *parts.start;
    if (!(log.start.time_s < first_s))
      throw IoError(parts.source, fmt::format("the start at {} s is not before the first motion, "
                                              "which ends at {} s",
                                              log.start.time_s, first_s));
    return;
  }
  const bool has_second = log.odometry.size() > 1;
  const double step_s = has_second ? log.odometry[1].time_s - first_s : 1.0;
  log.start.time_s = first_s - step_s;
  log.remarks.push_back(
      fmt::format("No start is given: the frame is the log's own, and the first motion is taken to "
                  "last {:g} s{}.",
                  step_s, has_second ? ", as the second" : ""));
}

/// Ranges that are bearings by mistake.
void check_angles(const std::vector<NamedMeasurement>& measurements, RangeLog& log) {
  std::map<std::string_view, double> last;
  FullTurn turn;
  for (const NamedMeasurement& measured : measurements) {
    const auto [before, is_new] = last.emplace(measured.landmark, kNaN);
    turn.add(measured.range_m, before->second);
    before->second = measured.range_m;
  }
  if (std::string remark = turn.remark(); !remark.empty()) log.remarks.push_back(std::move(remark));
}

void count_outside(RangeLog& log) {
  if (log.odometry.empty()) return;
  const double first_s = log.start.time_s;
  const double last_s = log.odometry.back().time_s;
  const auto outside = std::ranges::count_if(log.ranges, [&](const RangeMeasurement& measured) {
    return measured.time_s < first_s || measured.time_s > last_s;
  });
  if (outside > 0)
    log.remarks.push_back(
        fmt::format("Outside the time of the odometry, where no method takes them: {}.",
                    counted(outside, "range")));
}

}  // namespace

bool turns_are_the_ground_truths(const std::vector<Motion>& motions,
                                 const Trajectory& ground_truth) {
  const auto steps = static_cast<Eigen::Index>(motions.size());
  if (ground_truth.heading_rad.size() != steps + 1) return false;
  double largest = 0.0;
  double most_change = 0.0;
  for (Eigen::Index i = 0; i < steps; ++i) {
    const double change = motions[static_cast<std::size_t>(i)].heading_change_rad;
    const double true_change = ground_truth.heading_rad(i + 1) - ground_truth.heading_rad(i);
    largest = std::max(largest, std::abs(wrapped(change - true_change)));
    most_change = std::max(most_change, std::abs(change));
  }
  return largest < kSameHeadingChange_rad && most_change > kSomeHeadingChange_rad;
}

RangeLog assemble(RangeLogParts parts, const RangeLogOptions& options) {
  if (parts.columns.empty()) parts.columns = options.columns;
  take_named_files(options, parts);
  const std::vector<std::string_view> header(parts.header.begin(), parts.header.end());
  require_columns(header, parts.columns, parts.source);
  if (parts.measurements.empty()) throw IoError(parts.source, "holds no ranges");
  RangeLog log{.name = parts.name,
               .landmarks = names_of(parts),
               .ranges = {},
               .start = {},
               .odometry = parts.odometry,
               .ground_truth = parts.ground_truth,
               .true_landmarks = std::nullopt,
               .remarks = parts.remarks,
               .columns = parts.read,
               .separator = parts.separator};
  take_measurements(options, parts, log);
  take_true_landmarks(parts, log);
  if (!parts.true_landmarks.heights.empty()) log.remarks.push_back(parts.true_landmarks.heights);
  take_start(parts, log);
  std::ranges::copy(odometry_remarks(log.odometry), std::back_inserter(log.remarks));
  count_outside(log);
  check_angles(parts.measurements, log);
  if (log.ground_truth && turns_are_the_ground_truths(log.odometry, *log.ground_truth))
    log.remarks.push_back(
        "The heading changes of the odometry are those of the true heading: a result "
        "that uses them is optimistic: they contain ground truth.");
  check_true_heading(log);
  if (!log.ground_truth) log.remarks.push_back("The true path is not known.");
  return log;
}

}  // namespace mapproof
