#include "core/range_slam/factors/windowed_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/align/path_at.hpp"
#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/range_slam/factors/spread_rows.hpp"
#include "core/range_slam/log_checks.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kTurns = 5;
/// Blocks of held-out measurements per window.
constexpr double kBlocks = 6.0;
/// Lengths tried: down to 1/181 of all the time.
constexpr int kLengths = 16;
/// Coverage is judged on about this many of the times.
constexpr Eigen::Index kCoverageTimes = 500;
/// A length is unusable if no window determines more than this share of held-out ranges.
constexpr double kMostUndetermined = 0.02;

/// Sum of absolute errors over the determined ranges, and how many ranges were determined or not.
struct HeldOut {
  double error_m = 0.0;
  Eigen::Index observed = 0;
  Eigen::Index undetermined = 0;
};

/// The blocks of consecutive measurements that are held out together.
struct HeldOutBlocks {
  Eigen::Index turn = 0;   ///< From 0 to kTurns - 1.
  Eigen::Index phase = 0;  ///< Shifts the blocks: landmarks are not held out at the same times.
  double first_s = 0.0;    ///< Start of the first block.
};

void hold_out(const LandmarkRanges& measurements, const HeldOutBlocks& blocks,
              const WindowOptions& options, HeldOut& result) {
  std::vector<Eigen::Index> kept, out;
  for (Eigen::Index i = 0; i < measurements.size(); ++i) {
    const double block =
        std::floor((measurements.time_s(i) - blocks.first_s) * kBlocks / options.length_s);
    const bool is_out =
        std::fmod(block + static_cast<double>(blocks.phase), kTurns) == double(blocks.turn);
    (is_out ? out : kept).push_back(i);
  }
  const LandmarkRanges asked = measurements.at(out);
  // Evaluated at all measurements, so that the windows lie as they do for the whole.
  const Eigen::VectorXd half_squares = windowed_half_squares(
      measurements.at(kept), measurements.time_s, measurements.positions_m, options);
  const double scale = options.range_scale;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double half_square = half_squares(out[i]);
    if (!std::isfinite(half_square)) {
      ++result.undetermined;
      continue;
    }
    const double range_m = scale * std::sqrt(std::max(0.0, 2.0 * half_square));
    result.error_m += std::abs(range_m - asked.range_m(static_cast<Eigen::Index>(i)));
    ++result.observed;
  }
}

WindowCandidate tried(const std::vector<LandmarkRanges>& measurements, const Trajectory& path,
                      const Eigen::VectorXd& some_s, double length_s) {
  const double first_s = some_s(0), last_s = some_s(some_s.size() - 1);
  WindowOptions options{.length_s = length_s,
                        .range_scale = range_scale_of(measurements, first_s, last_s, length_s)};
  HeldOut held_out;
  for (Eigen::Index n = 0; n < std::ssize(measurements); ++n)
    for (Eigen::Index turn = 0; turn < kTurns; ++turn)
      hold_out(measurements[static_cast<std::size_t>(n)],
               {.turn = turn, .phase = n, .first_s = first_s}, options, held_out);
  const auto covered = windowed_ranges(measurements, path, some_s, options).columns.size();
  const bool usable = held_out.observed > 0 && double(held_out.undetermined) <=
                                                   kMostUndetermined * double(held_out.observed);
  return {.length_s = length_s,
          .range_scale = options.range_scale,
          .error_m = usable ? held_out.error_m / double(held_out.observed) : kNaN,
          .covered = double(covered) / double(some_s.size())};
}

constexpr int kRounds = 6;
constexpr double kHuber = 1.5;
/// Median of absolute values of a standard normal, inverted.
constexpr double kMedianToSigma = 1.4826;
/// Of the trace, added to normal equations: a straight stretch has a spread in one direction alone.
constexpr double kRidge = 1e-9;

/// Share of the typical range that is added to each before it is inverted.
constexpr double kNear = 0.05;
/// Share of the squared distances that the others must leave unexplained if they are to determine
/// the scale.
constexpr double kLeastBend = 1e-6;

/// Weights of r^2: the inverse of its error, but not without bound where the robot passes a
/// landmark.
Eigen::ArrayXd range_weights(const Eigen::ArrayXd& range_m) {
  const double typical = std::sqrt(range_m.square().mean());
  return typical > 0.0 ? Eigen::ArrayXd((range_m + kNear * typical).inverse())
                       : Eigen::ArrayXd::Ones(range_m.size());
}

/// Weighted normal equations and their solution, the last of kRounds.
template <int K>
struct RobustFit {
  using Vector = Eigen::Matrix<double, K, 1>;
  using Square = Eigen::Matrix<double, K, K>;
  Vector solution = Vector::Zero();
  Square normal = Square::Zero();

  RobustFit(const Eigen::Matrix<double, Eigen::Dynamic, K>& A, const Eigen::ArrayXd& y,
            const Eigen::ArrayXd& base) {
    Eigen::ArrayXd weights = base.square();
    for (int round = 0; round < kRounds; ++round) {
      normal = A.transpose() * weights.matrix().asDiagonal() * A;
      normal.diagonal().array() += kRidge * normal.trace();
      const Vector right = A.transpose() * (weights * y).matrix();
      solution = normal.ldlt().solve(right);
      const Eigen::ArrayXd misfit = (base * (y - (A * solution).array())).abs();
      const double limit = kHuber * kMedianToSigma * upper_median({misfit.begin(), misfit.end()});
      if (!(limit > 0.0)) break;
      weights = base.square() * (limit / misfit.max(limit));
    }
  }
};

/// Offsets from their mean, in units of their spread.
struct CentredFrame {
  Eigen::RowVector2d center_m;
  double unit_m;
  Points offsets;

  explicit CentredFrame(const Points& positions) : center_m(positions.colwise().mean()) {
    offsets = positions.rowwise() - center_m;
    unit_m = std::sqrt(offsets.squaredNorm() / static_cast<double>(offsets.rows()));
    if (!(unit_m > 0.0)) unit_m = 1.0;
    offsets /= unit_m;
  }
};

/// Windows that lie over any one time.
constexpr double kOverlap = 4.0;
/// Measurements that a window needs.
constexpr Eigen::Index kMeasurementsToInterpolate = 6;

/// Windows to a landmark.
constexpr double kMostWindows = 1e6;
/// A window's least weight in a mean, at its ends.
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

LandmarkRanges LandmarkRanges::at(const std::vector<Eigen::Index>& rows) const {
  return {.time_s = time_s(rows),
          .positions_m = positions_m(rows, Eigen::all),
          .range_m = range_m(rows)};
}

double LocalRange::squared_range(const Eigen::RowVector2d& position) const {
  const Eigen::RowVector2d offset = position - center_m;
  return squared_scale * offset.squaredNorm() + coefficients(0) +
         offset.dot(coefficients.tail<2>()) / unit_m;
}

double LocalRange::variance(const Eigen::RowVector2d& position) const {
  Eigen::Vector3d row;
  row << 1.0, (position - center_m).transpose() / unit_m;
  return row.dot(covariance * row);
}

LocalRange fit_local_range(const LandmarkRanges& measurements, Eigen::Index first,
                           Eigen::Index count, double range_scale) {
  if (count < 4) throw InvalidInput("a regression of ranges needs 4 measurements");
  const CentredFrame frame(measurements.positions_m.middleRows(first, count));
  const Eigen::ArrayXd range_m = measurements.range_m.segment(first, count).array();
  LocalRange local{.center_m = frame.center_m,
                   .unit_m = frame.unit_m,
                   .squared_scale = range_scale * range_scale,
                   .coefficients = Eigen::Vector3d::Zero(),
                   .covariance = Eigen::Matrix3d::Zero()};
  Eigen::MatrixX3d A(count, 3);
  A << Eigen::VectorXd::Ones(count), frame.offsets;
  const double quadratic = local.squared_scale * frame.unit_m * frame.unit_m;
  const RobustFit<3> fit(
      A, range_m.square() - quadratic * frame.offsets.rowwise().squaredNorm().array(),
      range_weights(range_m));
  local.coefficients = fit.solution;
  local.covariance = fit.normal.ldlt().solve(Eigen::Matrix3d::Identity());
  return local;
}

ScaleEvidence local_scale(const LandmarkRanges& measurements, Eigen::Index first,
                          Eigen::Index count) {
  if (count < 6) return {};
  const CentredFrame frame(measurements.positions_m.middleRows(first, count));
  const Eigen::ArrayXd range_m = measurements.range_m.segment(first, count).array();
  Eigen::MatrixX4d A(count, 4);
  A << frame.offsets.rowwise().squaredNorm(), Eigen::VectorXd::Ones(count), frame.offsets;
  const RobustFit<4> fit(A, range_m.square(), range_weights(range_m));
  // What of the first column the others do not explain.
  const Eigen::Matrix3d others = fit.normal.bottomRightCorner<3, 3>();
  const Eigen::Vector3d shared = fit.normal.topRightCorner<1, 3>().transpose();
  const double left = fit.normal(0, 0) - shared.dot(others.ldlt().solve(shared));
  if (!(left > kLeastBend * fit.normal(0, 0))) return {};
  const double unit_square = frame.unit_m * frame.unit_m;
  return {.squared_scale = fit.solution(0) / unit_square,
          .weight = left * unit_square * unit_square};
}

std::string windowed_size_problem(Eigen::Index landmarks, Eigen::Index times) {
  if (static_cast<double>(landmarks) * static_cast<double>(times) <= kMostWindowedRanges) return "";
  return fmt::format(
      "ranges to {} landmarks at {} times are more than {:g}: give fewer poses or landmarks",
      landmarks, times, kMostWindowedRanges);
}

std::vector<LandmarkRanges> ranges_by_landmark(const std::vector<RangeMeasurement>& ranges,
                                               Eigen::Index landmarks, const Trajectory& path) {
  if (const std::string problem = path_problem(path); !problem.empty()) throw InvalidInput(problem);
  check_ranges(ranges, landmarks);
  std::vector<std::vector<Eigen::Index>> rows(static_cast<std::size_t>(landmarks));
  std::vector<double> time_s, range_m;
  for (const RangeMeasurement& measured : ranges) {
    if (path.size() == 0 || measured.time_s < path.time_s(0) ||
        measured.time_s > path.time_s(path.size() - 1))
      continue;
    rows[static_cast<std::size_t>(measured.landmark)].push_back(std::ssize(time_s));
    time_s.push_back(measured.time_s);
    range_m.push_back(measured.range_m);
  }
  const LandmarkRanges all{
      .time_s = Eigen::Map<Eigen::VectorXd>(time_s.data(), std::ssize(time_s)),
      .positions_m =
          positions_at(path, Eigen::Map<Eigen::VectorXd>(time_s.data(), std::ssize(time_s))),
      .range_m = Eigen::Map<Eigen::VectorXd>(range_m.data(), std::ssize(range_m))};
  std::vector<LandmarkRanges> result;
  result.reserve(rows.size());
  for (const std::vector<Eigen::Index>& own : rows) result.push_back(all.at(own));
  return result;
}

Eigen::VectorXd windowed_half_squares(const LandmarkRanges& measurements,
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
    const Slice inside(measurements.time_s, from_s, to_s);
    if (inside.count < kMeasurementsToInterpolate) continue;
    const LocalRange local =
        fit_local_range(measurements, inside.first, inside.count, options.range_scale);
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

WindowedRanges windowed_ranges(const std::vector<LandmarkRanges>& measurements,
                               const Trajectory& path, const Eigen::VectorXd& time_s,
                               const WindowOptions& options) {
  check(time_s, options);
  if (const std::string problem = windowed_size_problem(std::ssize(measurements), time_s.size());
      !problem.empty())
    throw InvalidInput(problem);
  const Points path_m = positions_at(path, time_s);
  if (!path_m.allFinite()) throw InvalidInput("ranges are asked for beyond the path");
  Eigen::MatrixXd Y(std::ssize(measurements), time_s.size());
  for (Eigen::Index n = 0; n < Y.rows(); ++n)
    Y.row(n) =
        windowed_half_squares(measurements[static_cast<std::size_t>(n)], time_s, path_m, options);
  WindowedRanges result;
  for (Eigen::Index n = 0; n < Y.rows(); ++n)
    result.observed.push_back(Y.row(n).array().isFinite().count());
  for (Eigen::Index t = 0; t < Y.cols(); ++t)
    if (Y.col(t).allFinite()) result.columns.push_back(t);
  if (std::ssize(result.columns) == Y.cols())
    result.Y = std::move(Y);
  else
    result.Y = Y(Eigen::all, result.columns);
  return result;
}

double range_scale_of(const std::vector<LandmarkRanges>& measurements, double first_s,
                      double last_s, double length_s) {
  check_length(length_s);
  if (!std::isfinite(first_s) || !std::isfinite(last_s) || first_s > last_s)
    throw InvalidInput("times must be finite and ascend");
  const WindowGrid grid(first_s, last_s, length_s);
  double sum = 0.0, weight = 0.0;
  for (const LandmarkRanges& landmark : measurements)
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

WindowSearch choose_window(const std::vector<LandmarkRanges>& measurements, const Trajectory& path,
                           const Eigen::VectorXd& time_s) {
  if (time_s.size() < 2 || !(time_s(time_s.size() - 1) > time_s(0)))
    throw InvalidInput("windows need two times or more");
  const Eigen::VectorXd some_s = time_s(spread_rows(time_s.size(), kCoverageTimes));
  const double all_s = some_s(some_s.size() - 1) - some_s(0);
  WindowSearch search;
  search.options.length_s = all_s;
  const WindowCandidate* best = nullptr;
  for (int i = 0; i < kLengths; ++i)
    search.candidates.push_back(
        tried(measurements, path, some_s, all_s * std::pow(std::numbers::sqrt2, -i)));
  for (const WindowCandidate& candidate : search.candidates) {
    if (std::isnan(candidate.error_m)) continue;
    if (best == nullptr || candidate.covered > best->covered ||
        (candidate.covered == best->covered && candidate.error_m < best->error_m))
      best = &candidate;
  }
  if (best == nullptr) {
    search.all_covered = false;
    return search;
  }
  search.options = {.length_s = best->length_s, .range_scale = best->range_scale};
  search.all_covered = best->covered == 1.0;
  return search;
}

WindowCurve summary(const WindowSearch& search) {
  WindowCurve curve;
  for (const WindowCandidate& candidate : search.candidates) {
    curve.lengths_s.push_back(candidate.length_s);
    curve.held_out_m.push_back(candidate.error_m);
  }
  curve.chosen_s = search.options.length_s;
  return curve;
}

}  // namespace mapproof
