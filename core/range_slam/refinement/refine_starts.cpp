#include "core/range_slam/refinement/refine_starts.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include <Eigen/Geometry>

#include "core/align/path_at.hpp"
#include "core/align/rigid.hpp"
#include "core/base/angle.hpp"
#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/range_slam/dead_reckoning.hpp"
#include "core/range_slam/known_landmarks.hpp"
#include "core/range_slam/log_checks.hpp"
#include "core/range_slam/trilateration.hpp"

namespace mapproof {
namespace {

/// Way on either side of a pose over which a rotation is fitted.
constexpr double kAround_m = 10.0;

/// The rotation under which the ways of odometry fit those of the path around each of its poses.
Eigen::VectorXd fitted_headings(const Trajectory& path, const Trajectory& odometry) {
  using Complex = std::complex<double>;
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

/// The poses within the time of the odometry and with a finite position.
Trajectory part_within(const Trajectory& path, const Trajectory& odometry) {
  const double first_s = odometry.time_s(0);
  const double last_s = odometry.time_s(odometry.size() - 1);
  std::vector<Eigen::Index> inside;
  for (Eigen::Index i = 0; i < path.size(); ++i)
    if (path.time_s(i) >= first_s && path.time_s(i) <= last_s &&
        path.positions_m.row(i).allFinite())
      inside.push_back(i);
  if (inside.empty()) throw InvalidInput("no pose of the start is within the time of the odometry");
  Trajectory part{.time_s = path.time_s(inside),
                  .positions_m = path.positions_m(inside, Eigen::all),
                  .heading_rad = {}};
  if (path.heading_rad.size() > 0) part.heading_rad = path.heading_rad(inside);
  return part;
}

/// The rotation from odometry's headings to those of the path, without jumps by full turns.
Eigen::VectorXd turns_to(const Trajectory& path, const Trajectory& odometry) {
  Eigen::VectorXd turns =
      path.heading_rad.size() > 0
          ? Eigen::VectorXd(path.heading_rad -
                            interpolated(odometry.time_s, odometry.heading_rad, path.time_s))
          : fitted_headings(path, odometry);
  for (Eigen::Index i = 1; i < turns.size(); ++i)
    turns(i) = turns(i - 1) + wrapped(turns(i) - turns(i - 1));
  return turns;
}

void check(const Trajectory& path, const Trajectory& odometry) {
  for (const Trajectory* each : {&path, &odometry})
    if (const std::string problem = times_problem(*each); !problem.empty())
      throw InvalidInput(problem);
  if (path.size() < 1) throw InvalidInput("a start needs a pose");
  if (!path.heading_rad.allFinite()) throw InvalidInput("the headings of a start must be finite");
  if (odometry.size() < 1 || odometry.heading_rad.size() != odometry.size())
    throw InvalidInput("a path is carried along odometry with headings");
}

/// Known landmarks nearer to each other than this fix no rotation.
constexpr double kOnePosition_m = 1e-3;

/// How many known landmarks are heard, and whether two of them are at different positions.
struct Ties {
  int heard = 0;
  bool fix_the_frame = false;
};

Ties ties_of(const KnownLandmarks& known, const std::vector<bool>& is_heard) {
  Ties ties;
  std::optional<Eigen::RowVector2d> first;
  for (std::size_t i = 0; i < known.rows.size(); ++i) {
    if (!is_heard[static_cast<std::size_t>(known.rows[i])]) continue;
    const Eigen::RowVector2d position = known.positions_m.row(static_cast<Eigen::Index>(i));
    ++ties.heard;
    if (!first) first = position;
    ties.fix_the_frame = ties.fix_the_frame || (position - *first).norm() > kOnePosition_m;
  }
  return ties;
}

/// The start's landmarks where known ones are give the motion to their frame.
void move_to_known(const KnownLandmarks& known, PlacedStart& placed) {
  std::vector<Eigen::Index> both;
  for (std::size_t i = 0; i < known.rows.size(); ++i)
    if (placed.landmarks_m.row(known.rows[i]).allFinite())
      both.push_back(static_cast<Eigen::Index>(i));
  if (both.size() >= 2) {
    Points from(static_cast<Eigen::Index>(both.size()), 2);
    for (Eigen::Index i = 0; i < from.rows(); ++i)
      from.row(i) = placed.landmarks_m.row(
          known.rows[static_cast<std::size_t>(both[static_cast<std::size_t>(i)])]);
    const Similarity motion =
        fit_similarity(from, known.positions_m(both, Eigen::all), Alignment::kRigid);
    placed.path.positions_m = motion(placed.path.positions_m);
    placed.path.heading_rad.array() += std::atan2(motion.rotation(1, 0), motion.rotation(0, 0));
    placed.landmarks_m = motion(placed.landmarks_m);
  }
  for (std::size_t i = 0; i < known.rows.size(); ++i)
    placed.landmarks_m.row(known.rows[i]) = known.positions_m.row(static_cast<Eigen::Index>(i));
}

}  // namespace

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
  for (const RangeMeasurement& measured : log.ranges) reach = std::max(reach, measured.range_m);
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
  check(path, odometry);
  const Trajectory own = part_within(path, odometry);
  const Eigen::Index n = own.size();
  const Points reckoned = positions_at(odometry, own.time_s);
  const Eigen::VectorXd turns = turns_to(own, odometry);

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

PlacedStart placed_start(const RangeLog& log, const Trajectory& odometry, const SlamEstimate& start,
                         const std::optional<KnownLandmarks>& known) {
  PlacedStart placed{.path = carried_along(start.path, odometry),
                     .landmarks_m = start.landmarks_m,
                     .known = std::nullopt,
                     .statuses = {}};
  if (!placed.landmarks_m.allFinite()) {
    const Points found = trilaterated(log, placed.path, start.range_scale);
    for (Eigen::Index n = 0; n < placed.landmarks_m.rows(); ++n)
      if (!placed.landmarks_m.row(n).allFinite()) placed.landmarks_m.row(n) = found.row(n);
  }
  // Without a measurement a position has no source.
  const std::vector<bool> is_heard =
      heard_between(log, odometry.time_s(0), odometry.time_s(odometry.size() - 1));
  for (Eigen::Index n = 0; n < placed.landmarks_m.rows(); ++n)
    if (!is_heard[static_cast<std::size_t>(n)]) placed.landmarks_m.row(n).setConstant(kNaN);
  if (!known) return placed;
  if (const Ties ties = ties_of(*known, is_heard); ties.fix_the_frame) {
    placed.known = known;
    move_to_known(*known, placed);
  } else {
    placed.statuses.push_back(
        status_of<StatusReason::kFrameNotTied>(ties.heard, known->rows.size()));
  }
  return placed;
}

}  // namespace mapproof
