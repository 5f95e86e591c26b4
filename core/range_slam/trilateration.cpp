#include "core/range_slam/trilateration.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/range_slam/factors/windowed_ranges.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kLeastMeasurements = 3;
constexpr Eigen::Index kMostMeasurements = 200;  ///< Of a landmark, for the grid.
constexpr int kGridSide = 40;
/// Errors of this size are drift and count less than by their square.
constexpr double kBend_m = 3.0;

constexpr int kMostRounds = 50;
constexpr double kDamping = 1e-3;  ///< At first, as a share of the curvature.
constexpr double kMostDamping = 1e6;
constexpr double kConverged = 1e-12;       ///< A fall of the misfit by less, as a share of it.
constexpr double kLeastCurvature = 1e-12;  ///< Keeps the step finite along a straight path.
constexpr double kLeastDistance_m = 1e-9;  ///< Nearer a landmark has no direction.

/// At most kMostMeasurements of them.
LandmarkRanges thinned(const LandmarkRanges& measurements) {
  const Eigen::Index step = (measurements.size() + kMostMeasurements - 1) / kMostMeasurements;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < measurements.size(); i += step) rows.push_back(i);
  return measurements.at(rows);
}

/// Sum of e^2 / (e^2 + bend^2) over the measurements.
double misfit(const LandmarkRanges& measurements, const Eigen::RowVector2d& position) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < measurements.range_m.size(); ++i) {
    const double error =
        (measurements.positions_m.row(i) - position).norm() - measurements.range_m(i);
    sum += error * error / (error * error + kBend_m * kBend_m);
  }
  return sum;
}

Eigen::RowVector2d best_of_grid(const LandmarkRanges& measurements) {
  const double reach = measurements.range_m.maxCoeff();
  const Eigen::RowVector2d low = measurements.positions_m.colwise().minCoeff().array() - reach;
  const Eigen::RowVector2d high = measurements.positions_m.colwise().maxCoeff().array() + reach;
  Eigen::RowVector2d best = low;
  double least = kInfinity;
  for (int i = 0; i <= kGridSide; ++i) {
    for (int j = 0; j <= kGridSide; ++j) {
      const Eigen::RowVector2d share(i / double{kGridSide}, j / double{kGridSide});
      const Eigen::RowVector2d position = low + share.cwiseProduct(high - low);
      const double value = misfit(measurements, position);
      if (value < least) {
        least = value;
        best = position;
      }
    }
  }
  return best;
}

/// Damped Gauss-Newton steps on the same misfit by weights, kept while they reduce it.
Eigen::RowVector2d polished(const LandmarkRanges& measurements, Eigen::RowVector2d position) {
  double damping = kDamping;
  double value = misfit(measurements, position);
  for (int round = 0; round < kMostRounds; ++round) {
    Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
    Eigen::Vector2d g = Eigen::Vector2d::Zero();
    for (Eigen::Index i = 0; i < measurements.range_m.size(); ++i) {
      const Eigen::Vector2d gap = (position - measurements.positions_m.row(i)).transpose();
      const double distance = std::max(gap.norm(), kLeastDistance_m);
      const double error = distance - measurements.range_m(i);
      const double root = kBend_m * kBend_m / (error * error + kBend_m * kBend_m);
      const Eigen::Vector2d direction = gap / distance;
      H += root * root * direction * direction.transpose();
      g += root * root * error * direction;
    }
    H.diagonal() *= 1.0 + damping;
    H.diagonal().array() += kLeastCurvature;
    const Eigen::RowVector2d next = position - (H.inverse() * g).transpose();
    const double next_value = next.allFinite() ? misfit(measurements, next) : value;
    if (next_value < value) {
      const bool is_done = value - next_value < kConverged * value;
      position = next;
      value = next_value;
      damping *= 0.3;
      if (is_done) break;
    } else {
      damping *= 10.0;
      if (damping > kMostDamping) break;
    }
  }
  return position;
}

}  // namespace

Points trilaterated(const RangeLog& log, const Trajectory& path, double range_scale) {
  if (!(range_scale > 0.0) || !std::isfinite(range_scale))
    throw InvalidInput("a range scale must be positive");
  const Eigen::Index landmarks = std::ssize(log.landmarks);
  std::vector<LandmarkRanges> all = ranges_by_landmark(log.ranges, landmarks, path);
  Points positions = Points::Constant(landmarks, 2, kNaN);
  for (Eigen::Index n = 0; n < landmarks; ++n) {
    LandmarkRanges& measurements = all[static_cast<std::size_t>(n)];
    if (measurements.size() < kLeastMeasurements) continue;
    measurements.range_m /= range_scale;
    const LandmarkRanges few = thinned(measurements);
    positions.row(n) = polished(measurements, polished(few, best_of_grid(few)));
  }
  return positions;
}

}  // namespace mapproof
