#include "core/range_slam/ekf.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/range_slam/dead_reckoning.hpp"
#include "core/range_slam/factors/spread_rows.hpp"
#include "core/range_slam/known_landmarks.hpp"
#include "core/range_slam/log_checks.hpp"
#include "core/range_slam/trilateration.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kMostFiltered = 500;
constexpr Eigen::Index kScale = 3;  ///< In the state: x, y, heading, range scale, landmarks.
/// Nearer than this a landmark has no direction.
constexpr double kNearestRange_m = 1e-9;
/// Measurements that a first position needs.
constexpr std::size_t kMeasurementsToStart = 5;
/// Share of the initial way after which a landmark without a position is tried again.
constexpr double kNextTry = 0.5;

/// A landmark that waits for its first position.
struct Waiting {
  std::vector<RangeMeasurement> measurements;
  double next_try_m = 0.0;  ///< Way at which it is tried again.
};

class Filter {
 public:
  Filter(const RangeLog& log, const Trajectory& odometry, const EkfOptions& options)
      : log_(log), options_(options), path_(odometry) {
    const auto landmarks = static_cast<Eigen::Index>(log.landmarks.size());
    x_ = Eigen::VectorXd::Zero(4 + 2 * landmarks);
    P_ = Eigen::MatrixXd::Zero(x_.size(), x_.size());
    x_.head<4>() << log.start.x_m, log.start.y_m, log.start.heading_rad, options.range_scale;
    P_(kScale, kScale) = options.scale_sigma * options.scale_sigma;
    is_placed_.assign(log.landmarks.size(), false);
    waiting_.resize(log.landmarks.size());
    for (Waiting& waiting : waiting_) waiting.next_try_m = options.initial_way_m;
    if (!options.known) return;
    for (std::size_t i = 0; i < options.known->rows.size(); ++i) {
      const Eigen::Index row = options.known->rows[i];
      x_.segment<2>(4 + 2 * row) =
          options.known->positions_m.row(static_cast<Eigen::Index>(i)).transpose();
      is_placed_[static_cast<std::size_t>(row)] = true;
    }
  }

  /// A share of a motion.
  void predict(const Motion& motion, double share) {
    const double cosine = std::cos(x_(2));
    const double sine = std::sin(x_(2));
    const double forward = share * motion.distance_m;
    const double left = share * motion.sideways_m;
    Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
    F(0, 2) = -forward * sine - left * cosine;
    F(1, 2) = forward * cosine - left * sine;
    Eigen::Matrix3d G = Eigen::Matrix3d::Identity();
    G.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
    const OdometryNoise& noise = options_.odometry;
    const Eigen::Vector3d Q(noise.forward_m * noise.forward_m, noise.sideways_m * noise.sideways_m,
                            noise.heading_change_rad * noise.heading_change_rad);
    x_.head<3>() += Eigen::Vector3d(forward * cosine - left * sine, forward * sine + left * cosine,
                                    share * motion.heading_change_rad);
    P_.topRows<3>() = (F * P_.topRows<3>()).eval();
    P_.leftCols<3>() = (P_.leftCols<3>() * F.transpose()).eval();
    P_.topLeftCorner<3, 3>() += share * G * Q.asDiagonal() * G.transpose();
    way_m_ += std::hypot(forward, left);
  }

  void take(const RangeMeasurement& measured) {
    const auto landmark = static_cast<std::size_t>(measured.landmark);
    if (is_placed_[landmark])
      update(measured);
    else
      waiting_[landmark].measurements.push_back(measured);
  }

  void record(Eigen::Index row) {
    path_.positions_m.row(row) = x_.head<2>().transpose();
    path_.heading_rad(row) = x_(2);
    for (std::size_t n = 0; n < waiting_.size(); ++n)
      if (!is_placed_[n] && way_m_ >= waiting_[n].next_try_m) position(n, row);
  }

  Eigen::Matrix2d position_covariance() const { return P_.topLeftCorner<2, 2>(); }

  SlamEstimate estimate() const {
    SlamEstimate estimate;
    estimate.path = path_;
    estimate.landmarks_m.resize(static_cast<Eigen::Index>(is_placed_.size()), 2);
    const double nan = kNaN;
    for (std::size_t n = 0; n < is_placed_.size(); ++n) {
      const auto row = static_cast<Eigen::Index>(n);
      const Eigen::Index at = 4 + 2 * row;
      estimate.landmarks_m.row(row) =
          is_placed_[n] ? Eigen::RowVector2d(x_.segment<2>(at)) : Eigen::RowVector2d(nan, nan);
      if (options_.covariances == 0) continue;
      estimate.landmark_cov_m2.emplace_back(is_placed_[n]
                                                ? Eigen::Matrix2d(P_.block<2, 2>(at, at))
                                                : Eigen::Matrix2d(Eigen::Matrix2d::Constant(nan)));
    }
    estimate.range_scale = x_(kScale);
    report_unplaced(log_, is_placed_, estimate.statuses);
    if (2 * gated_ > updates_)
      estimate.statuses.push_back(status_of<StatusReason::kFilterLost>(gated_, updates_));
    return estimate;
  }

 private:
  void update(const RangeMeasurement& measured) {
    const Eigen::Index at = 4 + 2 * measured.landmark;
    const Eigen::Vector2d gap = x_.head<2>() - x_.segment<2>(at);
    const double distance = gap.norm();
    ++updates_;
    if (!(distance > kNearestRange_m)) return;
    const Eigen::Vector2d slope = x_(kScale) * gap / distance;
    const Eigen::VectorXd PHt =
        P_.leftCols<2>() * slope - P_.middleCols<2>(at) * slope + P_.col(kScale) * distance;
    const double S = slope.dot(PHt.head<2>() - PHt.segment<2>(at)) + distance * PHt(kScale) +
                     options_.range_sigma_m * options_.range_sigma_m;
    const double error = measured.range_m - x_(kScale) * distance;
    if (error * error > options_.gate * S) {
      ++gated_;
      return;
    }
    x_ += PHt * (error / S);
    P_ -= PHt * PHt.transpose() / S;
  }

  /// The first position of a landmark, from its measurements along the path up to `row`.
  void position(std::size_t landmark, Eigen::Index row) {
    Waiting& waiting = waiting_[landmark];
    waiting.next_try_m = way_m_ + kNextTry * options_.initial_way_m;
    if (waiting.measurements.size() < kMeasurementsToStart) return;
    RangeLog part;
    part.landmarks = {log_.landmarks[landmark]};
    for (const RangeMeasurement& measured : waiting.measurements)
      part.ranges.push_back(
          {.time_s = measured.time_s, .landmark = 0, .range_m = measured.range_m});
    const Trajectory so_far{.time_s = path_.time_s.head(row + 1),
                            .positions_m = path_.positions_m.topRows(row + 1),
                            .heading_rad = {}};
    const Eigen::RowVector2d found = trilaterated(part, so_far, x_(kScale)).row(0);
    const Eigen::Matrix2d information = information_at(found, part, so_far);
    const Eigen::Vector2d eigen =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(information).eigenvalues();
    const double least = 1.0 / (options_.initial_sigma_m * options_.initial_sigma_m);
    if (!found.allFinite() || !(eigen(0) > least)) return;
    const auto at = static_cast<Eigen::Index>(4 + 2 * landmark);
    x_.segment<2>(at) = found.transpose();
    // The variance that the measurements leave, and that of the path at them.
    P_.block<2, 2>(at, at) = information.inverse() + P_.topLeftCorner<2, 2>();
    is_placed_[landmark] = true;
    waiting.measurements.clear();
  }

  Eigen::Matrix2d information_at(const Eigen::RowVector2d& position, const RangeLog& part,
                                 const Trajectory& path) const {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    for (const RangeMeasurement& measured : part.ranges) {
      const auto after = std::lower_bound(path.time_s.begin(), path.time_s.end(), measured.time_s) -
                         path.time_s.begin();
      const Eigen::Vector2d gap =
          (position - path.positions_m.row(std::min<Eigen::Index>(after, path.size() - 1)))
              .transpose();
      if (gap.norm() > kNearestRange_m)
        information += gap * gap.transpose() / gap.squaredNorm() /
                       (options_.range_sigma_m * options_.range_sigma_m);
    }
    return information;
  }

  const RangeLog& log_;
  EkfOptions options_;
  Trajectory path_;
  Eigen::VectorXd x_;
  Eigen::MatrixXd P_;
  std::vector<bool> is_placed_;
  std::vector<Waiting> waiting_;
  double way_m_ = 0.0;
  long long updates_ = 0;
  long long gated_ = 0;
};

}  // namespace

std::string EkfOptions::problem(Eigen::Index n) const {
  if (n > kMostFiltered) return fmt::format("the filter takes at most {} landmarks", kMostFiltered);
  if (std::string problem = odometry.problem(); !problem.empty()) return problem;
  if (!(range_sigma_m > 0.0)) return "the standard deviation of ranges must be positive";
  if (!(gate > 0.0)) return "the gate must be positive";
  if (!(range_scale > 0.0 && scale_sigma >= 0.0)) return "the range scale must be positive";
  if (!(initial_way_m > 0.0 && initial_sigma_m > 0.0))
    return "a first position needs a positive way and standard deviation";
  if (covariances < 0) return "the number of covariances cannot be negative";
  return known ? known_problem(*known, n) : "";
}

SlamEstimate ekf_slam(const RangeLog& log, const EkfOptions& options) {
  const auto landmarks = static_cast<Eigen::Index>(log.landmarks.size());
  if (const std::string problem = options.problem(landmarks); !problem.empty())
    throw InvalidInput(problem);
  check_ranges(log.ranges, landmarks);
  const Trajectory odometry = dead_reckoned(log);
  Filter filter(log, odometry, options);
  const Eigen::Index poses = odometry.size();
  const std::vector<Eigen::Index> rows = spread_rows(poses, options.covariances);
  std::vector<Eigen::Matrix2d> covariances;
  std::size_t next = 0;
  while (next < log.ranges.size() && log.ranges[next].time_s < odometry.time_s(0)) ++next;
  for (Eigen::Index row = 0; row < poses; ++row) {
    double done = 0.0;
    for (; next < log.ranges.size() && log.ranges[next].time_s <= odometry.time_s(row); ++next) {
      if (row > 0) {
        const double span_s = odometry.time_s(row) - odometry.time_s(row - 1);
        const double share = (log.ranges[next].time_s - odometry.time_s(row - 1)) / span_s;
        filter.predict(log.odometry[static_cast<std::size_t>(row - 1)], share - done);
        done = share;
      }
      filter.take(log.ranges[next]);
    }
    if (row > 0) filter.predict(log.odometry[static_cast<std::size_t>(row - 1)], 1.0 - done);
    filter.record(row);
    if (covariances.size() < rows.size() && row == rows[covariances.size()])
      covariances.push_back(filter.position_covariance());
  }
  SlamEstimate estimate = filter.estimate();
  estimate.position_cov_rows = rows;
  estimate.position_cov_m2 = covariances;
  return estimate;
}

}  // namespace mapproof
