#include "core/range_slam/refine_starts.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/align/path_at.hpp"
#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/range_slam/dead_reckoning.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kMostReadings = 200;  ///< Of a landmark, for the grid.
constexpr int kGridSide = 40;
constexpr double kBend_m =
    3.0;  ///< Errors of this size are drift and count less than by their square.

/// Readings of one landmark and where the path puts the robot at them.
struct Sightings {
  Points positions_m;
  Eigen::VectorXd distance_m;
};

Sightings sightings_of(const RangeLog& log, const Trajectory& path, Eigen::Index landmark,
                       double range_scale) {
  std::vector<double> times;
  std::vector<double> distances;
  for (const RangeReading& reading : log.ranges) {
    if (reading.landmark != landmark || reading.time_s < path.time_s(0) ||
        reading.time_s > path.time_s(path.size() - 1))
      continue;
    times.push_back(reading.time_s);
    distances.push_back(reading.range_m / range_scale);
  }
  const auto count = static_cast<Eigen::Index>(times.size());
  return {.positions_m = positions_at(path, Eigen::Map<Eigen::VectorXd>(times.data(), count)),
          .distance_m = Eigen::Map<Eigen::VectorXd>(distances.data(), count)};
}

Sightings thinned(const Sightings& sightings) {
  const Eigen::Index count = sightings.distance_m.size();
  const Eigen::Index step = (count + kMostReadings - 1) / kMostReadings;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < count; i += step) rows.push_back(i);
  return {.positions_m = sightings.positions_m(rows, Eigen::all),
          .distance_m = sightings.distance_m(rows)};
}

/// Sum of e^2 / (e^2 + bend^2) over the readings.
double misfit(const Sightings& sightings, const Eigen::RowVector2d& place) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < sightings.distance_m.size(); ++i) {
    const double error = (sightings.positions_m.row(i) - place).norm() - sightings.distance_m(i);
    sum += error * error / (error * error + kBend_m * kBend_m);
  }
  return sum;
}

Eigen::RowVector2d best_of_grid(const Sightings& sightings) {
  const double reach = sightings.distance_m.maxCoeff();
  const Eigen::RowVector2d low = sightings.positions_m.colwise().minCoeff().array() - reach;
  const Eigen::RowVector2d high = sightings.positions_m.colwise().maxCoeff().array() + reach;
  Eigen::RowVector2d best = low;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kGridSide; ++i) {
    for (int j = 0; j <= kGridSide; ++j) {
      const Eigen::RowVector2d share(i / double{kGridSide}, j / double{kGridSide});
      const Eigen::RowVector2d place = low + share.cwiseProduct(high - low);
      const double value = misfit(sightings, place);
      if (value < least) {
        least = value;
        best = place;
      }
    }
  }
  return best;
}

/// Damped Gauss-Newton steps on the same misfit by weights, kept only while they lower it.
Eigen::RowVector2d polished(const Sightings& sightings, Eigen::RowVector2d place) {
  double damping = 1e-3;
  double value = misfit(sightings, place);
  for (int round = 0; round < 50; ++round) {
    Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
    Eigen::Vector2d g = Eigen::Vector2d::Zero();
    for (Eigen::Index i = 0; i < sightings.distance_m.size(); ++i) {
      const Eigen::Vector2d gap = (place - sightings.positions_m.row(i)).transpose();
      const double distance = std::max(gap.norm(), 1e-9);
      const double error = distance - sightings.distance_m(i);
      const double root = kBend_m * kBend_m / (error * error + kBend_m * kBend_m);
      const Eigen::Vector2d direction = gap / distance;
      H += root * root * direction * direction.transpose();
      g += root * root * error * direction;
    }
    H.diagonal() *= 1.0 + damping;
    H.diagonal().array() += 1e-12;
    const Eigen::RowVector2d next = place - (H.inverse() * g).transpose();
    const double next_value = next.allFinite() ? misfit(sightings, next) : value;
    if (next_value < value) {
      const bool is_done = value - next_value < 1e-12 * value;
      place = next;
      value = next_value;
      damping *= 0.3;
      if (is_done) break;
    } else if ((damping *= 10.0) > 1e6) {
      break;
    }
  }
  return place;
}

/// The turn under which the ways of odometry fit those of the path around each of its poses.
Eigen::VectorXd fitted_headings(const Trajectory& path, const Trajectory& odometry) {
  using Complex = std::complex<double>;
  constexpr double kAround_m = 10.0;
  const Eigen::Index n = path.size();
  const Points reckoned = positions_at(odometry, path.time_s);
  const auto to_complex = [](const Eigen::RowVector2d& v) { return Complex(v(0), v(1)); };
  Eigen::VectorXd turns(n);
  Eigen::Index first = 0;
  Eigen::Index last = 0;
  double way_first = 0.0;
  double way_last = 0.0;
  const auto step_m = [&](Eigen::Index i) {
    return (reckoned.row(i + 1) - reckoned.row(i)).norm();
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    while (last + 1 < n && way_last < kAround_m) way_last += step_m(last++);
    while (first < i && way_first - step_m(first) > kAround_m) way_first -= step_m(first++);
    Complex sum = 0.0;
    for (Eigen::Index j = first; j < last; ++j)
      sum += std::conj(to_complex(reckoned.row(j + 1) - reckoned.row(j))) *
             to_complex(path.positions_m.row(j + 1) - path.positions_m.row(j));
    turns(i) = std::abs(sum) > 0.0 ? std::arg(sum) : 0.0;
    if (i + 1 < n) {
      way_first += step_m(i);
      way_last -= i < last ? step_m(i) : 0.0;
    }
  }
  return turns;
}

Eigen::VectorXd interpolated(const Eigen::VectorXd& times, const Eigen::VectorXd& values,
                             const Eigen::VectorXd& at) {
  const Trajectory line{.time_s = times,
                        .positions_m = (Points(times.size(), 2) << values, values).finished(),
                        .heading_rad = {}};
  return positions_at(line, at).col(0);
}

}  // namespace

Points trilaterated(const RangeLog& log, const Trajectory& path, double range_scale) {
  if (!(range_scale > 0.0)) throw InvalidInput("a range scale must be positive");
  const auto landmarks = static_cast<Eigen::Index>(log.landmarks.size());
  Points places = Points::Constant(landmarks, 2, std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index n = 0; n < landmarks; ++n) {
    const Sightings sightings = sightings_of(log, path, n, range_scale);
    if (sightings.distance_m.size() < 3) continue;
    const Sightings few = thinned(sightings);
    places.row(n) = polished(sightings, polished(few, best_of_grid(few)));
  }
  return places;
}

SlamEstimate dead_reckoning_start(const RangeLog& log) {
  SlamEstimate start;
  start.path = dead_reckoned(log);
  start.landmarks_m = trilaterated(log, start.path);
  return start;
}

SlamEstimate random_start(const RangeLog& log, std::uint64_t seed) {
  SlamEstimate start;
  start.path = dead_reckoned(log);
  double reach = 0.0;
  for (const RangeReading& reading : log.ranges) reach = std::max(reach, reading.range_m);
  const Eigen::RowVector2d low = start.path.positions_m.colwise().minCoeff().array() - reach;
  const Eigen::RowVector2d high = start.path.positions_m.colwise().maxCoeff().array() + reach;
  Random random(seed);
  start.landmarks_m.resize(static_cast<Eigen::Index>(log.landmarks.size()), 2);
  for (Eigen::Index n = 0; n < start.landmarks_m.rows(); ++n)
    for (const Eigen::Index axis : {0, 1})
      start.landmarks_m(n, axis) = random.uniform(low(axis), high(axis));
  return start;
}

Trajectory carried_along(const Trajectory& path, const Trajectory& odometry) {
  if (path.size() < 1) throw InvalidInput("a start needs a pose");
  const double first_s = odometry.time_s(0);
  const double last_s = odometry.time_s(odometry.size() - 1);
  std::vector<Eigen::Index> inside;
  for (Eigen::Index i = 0; i < path.size(); ++i)
    if (path.time_s(i) >= first_s && path.time_s(i) <= last_s &&
        path.positions_m.row(i).allFinite())
      inside.push_back(i);
  if (inside.empty()) throw InvalidInput("no pose of the start is within the time of the odometry");
  const bool has_heading = path.heading_rad.size() == path.size();
  const Trajectory own{.time_s = path.time_s(inside),
                       .positions_m = path.positions_m(inside, Eigen::all),
                       .heading_rad = {}};
  const Eigen::Index n = own.size();
  const Points reckoned = positions_at(odometry, own.time_s);
  // What turns odometry's headings to those of the path, without jumps by full turns.
  Eigen::VectorXd turns =
      has_heading ? Eigen::VectorXd(path.heading_rad(inside) -
                                    interpolated(odometry.time_s, odometry.heading_rad, own.time_s))
                  : fitted_headings(own, odometry);
  for (Eigen::Index i = 1; i < n; ++i)
    turns(i) = turns(i - 1) + std::remainder(turns(i) - turns(i - 1), 2.0 * std::numbers::pi);

  Trajectory carried = odometry;
  for (Eigen::Index row = 0; row < odometry.size(); ++row) {
    const double time_s = odometry.time_s(row);
    const Eigen::Index after =
        std::lower_bound(own.time_s.begin(), own.time_s.end(), time_s) - own.time_s.begin();
    const Eigen::Index second = std::min(after, n - 1);
    const Eigen::Index first = std::max<Eigen::Index>(std::min(after, n) - 1, 0);
    const double span_s = own.time_s(second) - own.time_s(first);
    const double share = span_s > 0.0 ? (time_s - own.time_s(first)) / span_s : 0.0;
    const auto reached = [&](Eigen::Index i) -> Eigen::Vector2d {
      const Eigen::Vector2d way = (odometry.positions_m.row(row) - reckoned.row(i)).transpose();
      return own.positions_m.row(i).transpose() + Eigen::Rotation2Dd(turns(i)) * way;
    };
    carried.positions_m.row(row) =
        ((1.0 - share) * reached(first) + share * reached(second)).transpose();
    carried.heading_rad(row) =
        odometry.heading_rad(row) + (1.0 - share) * turns(first) + share * turns(second);
  }
  return carried;
}

}  // namespace mapproof
