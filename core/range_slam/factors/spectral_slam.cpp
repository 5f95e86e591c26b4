#include "core/range_slam/factors/spectral_slam.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "core/base/angle.hpp"
#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/planarity.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"
#include "core/range_slam/known_landmarks.hpp"
#include "core/range_slam/localise.hpp"
#include "core/range_slam/log_checks.hpp"
#include "core/range_slam/refinement/bootstrap.hpp"

namespace mapproof {

namespace {

/// A share of |p|^2/2 that is as little as this beside [1, p] does not determine the scale.
constexpr double kCircular = 1e-6;

constexpr Eigen::Index kRankWithHeading = 7;
constexpr Eigen::Index kLeastLandmarksRank7 = 4;
constexpr Eigen::Index kLeastColumns = 8;

/// Directions from the bottom block: [m, 1] [-cos, -sin, ...]' by regression on the map.
Eigen::VectorXd headings(const Eigen::MatrixXd& bottom, const Points& landmarks_m) {
  Eigen::MatrixX3d A(landmarks_m.rows(), 3);
  A << landmarks_m, Eigen::VectorXd::Ones(landmarks_m.rows());
  const Eigen::MatrixXd states = A.colPivHouseholderQr().solve(bottom);
  Eigen::VectorXd heading_rad(states.cols());
  for (Eigen::Index t = 0; t < states.cols(); ++t)
    heading_rad(t) = std::atan2(-states(1, t), -states(0, t));
  return heading_rad;
}

Eigen::VectorXcd centered_as_complex(const Points& points) {
  Eigen::VectorXcd z(points.rows());
  z.real() = points.col(0);
  z.imag() = points.col(1);
  return z.array() - z.mean();
}

/// Scale of one piece, and its weight in the median.
struct Piece {
  double scale;
  double weight;
};

double weighted_median(std::vector<Piece>& pieces, double total) {
  std::ranges::sort(pieces, {}, &Piece::scale);
  double below = 0.0;
  for (const Piece& piece : pieces) {
    below += piece.weight;
    if (below >= 0.5 * total) return piece.scale;
  }
  return 1.0;
}

/// What a metric upgrade needs.
constexpr Eigen::Index kLeastLandmarks = 4;
constexpr Eigen::Index kLeastSteps = 8;
/// OdometryFit::agreement below which the reflection is arbitrary.
constexpr double kLeastAgreement = 0.02;

/// The poses of a path at some of its rows.
Trajectory part_of(const Trajectory& path, const std::vector<Eigen::Index>& rows) {
  Trajectory part{.time_s = path.time_s(rows),
                  .positions_m = path.positions_m(rows, Eigen::all),
                  .heading_rad = {}};
  if (path.heading_rad.size() > 0) part.heading_rad = path.heading_rad(rows);
  return part;
}

/// Rows of a path a stretch of travel apart.
std::vector<Eigen::Index> rows_apart(const Trajectory& path, double step_m) {
  std::vector<Eigen::Index> rows;
  double travelled = step_m;
  for (Eigen::Index t = 0; t < path.size(); ++t) {
    if (t > 0) travelled += (path.positions_m.row(t) - path.positions_m.row(t - 1)).norm();
    if (travelled < step_m) continue;
    rows.push_back(t);
    travelled = 0.0;
  }
  return rows;
}

/// The direction of motion at some poses, by the map and by odometry.
struct Directions {
  std::vector<Eigen::Index> rows;  ///< Of the path, ascending.
  Eigen::VectorXd map_rad;
  Eigen::VectorXd odometry_rad;
};

/// Headings at all poses: odometry's, turned by what the last direction before differs by.
Eigen::VectorXd carried(const Directions& directions, const Eigen::VectorXd& odometry_rad,
                        bool mirrored) {
  Eigen::VectorXd all(odometry_rad.size());
  Eigen::Index k = 0;
  for (Eigen::Index t = 0; t < all.size(); ++t) {
    while (k + 1 < std::ssize(directions.rows) &&
           directions.rows[static_cast<std::size_t>(k + 1)] <= t)
      ++k;
    const double on_map = (mirrored ? -1.0 : 1.0) * directions.map_rad(k);
    all(t) = wrapped(on_map + odometry_rad(t) - directions.odometry_rad(k));
  }
  return all;
}

/// The map and what goes with it, before positions are read off.
struct Mapped {
  SpectralMap map;
  Directions directions;  ///< Empty without heading.
  Eigen::VectorXd singular_values;
};

Mapped mapped_with_heading(const Eigen::MatrixXd& Y, const Trajectory& odometry,
                           const SpectralSlamOptions& options) {
  const std::vector<Eigen::Index> rows = rows_apart(odometry, options.heading_step_m);
  if (rows.empty()) return {};
  const Points at = odometry.positions_m(rows, Eigen::all);
  const Points legs = at.bottomRows(at.rows() - 1) - at.topRows(at.rows() - 1);
  const HeadingColumns columns =
      heading_columns(Y(Eigen::all, rows), legs.rowwise().norm(), 0.5 * options.heading_step_m);
  HeadingMap found = map_with_heading(columns, options.known);
  Mapped mapped;
  mapped.map = std::move(found.map);
  mapped.singular_values = std::move(found.singular_values);
  mapped.directions.map_rad = std::move(found.heading_rad);
  mapped.directions.odometry_rad.resize(std::ssize(columns.steps));
  for (const Eigen::Index step : columns.steps) {
    mapped.directions.odometry_rad(std::ssize(mapped.directions.rows)) =
        std::atan2(legs(step, 1), legs(step, 0));
    mapped.directions.rows.push_back(rows[static_cast<std::size_t>(step)]);
  }
  return mapped;
}

Mapped mapped_without_heading(SpectralSlam& result, const SpectralSlamOptions& options) {
  const Factorization factors = factorize(result.Y, 4);
  Mapped mapped;
  mapped.singular_values = factors.singular_values;
  if (options.known) {
    mapped.map = map_from_known_landmarks(factors, *options.known);
  } else {
    result.upgrade = metric_upgrade(factors);
    mapped.map = result.upgrade.map;
  }
  return mapped;
}

/// Turns a map that may be mirrored and of a wrong scale into one that odometry agrees with; the
/// ranges are left to refer_to_path().
/// @param window  Poses in a window: long enough to determine the reflection; a quarter determines
/// the scale.
/// @return Whether it was mirrored.
bool settle_by_odometry(SlamEstimate& estimate, const Points& odometry_m, Eigen::Index window) {
  const Points& positions = estimate.path.positions_m;
  const OdometryFit turns =
      fit_to_odometry(positions, odometry_m, std::max<Eigen::Index>(window, 3));
  const double scale =
      fit_to_odometry(positions, odometry_m, std::max<Eigen::Index>(window / 4, 3)).scale;
  const Eigen::RowVector2d factors(1.0 / scale, (turns.mirrored ? -1.0 : 1.0) / scale);
  estimate.path.positions_m *= factors.asDiagonal();
  estimate.landmarks_m *= factors.asDiagonal();
  if (turns.agreement < kLeastAgreement)
    estimate.statuses.push_back(status_of<StatusReason::kMirrorImage>(100.0 * turns.agreement));
  return turns.mirrored;
}

/// Landmarks and scale of the ranges as a path of the odometry's scale determines them. Of those
/// of the upgrade the ratio to the path is the least certain.
void refer_to_path(SpectralSlam& result) {
  SlamEstimate& estimate = result.estimate;
  if (!(planarity(estimate.path.positions_m) > kFlatPlanarity)) return;
  LandmarksOnPath observed = landmarks_on_path(estimate.path.positions_m, result.Y);
  estimate.landmarks_m = std::move(observed.landmarks_m);
  estimate.range_scale *= observed.range_scale;
  result.Y /= observed.range_scale * observed.range_scale;
}

void check(const RangeLog& log, const Trajectory& odometry, const SpectralSlamOptions& options) {
  if (odometry.size() < 2) throw InvalidInput("spectral SLAM needs an odometry path");
  if (!(options.heading_step_m > 0.0)) throw InvalidInput("the heading step must be above 0");
  if (options.with_heading && odometry.heading_rad.size() != odometry.size())
    throw InvalidInput("headings need the odometry's headings");
  if (options.replicates == 1 || options.replicates < 0)
    throw InvalidInput("a bootstrap needs two replicates or more");
  if (log.landmarks.empty()) throw InvalidInput("spectral SLAM needs landmarks");
  if (const std::string problem = windowed_size_problem(std::ssize(log.landmarks), odometry.size());
      !problem.empty())
    throw InvalidInput(problem);
  if (!options.known) return;
  if (const std::string problem = known_problem(*options.known, std::ssize(log.landmarks));
      !problem.empty())
    throw InvalidInput(problem);
}

/// The landmark that is determined at the fewest of the odometry's times, and at how many.
auto worst_landmark(const RangeLog& log, const WindowedRanges& ranges) {
  const auto least = std::ranges::min_element(ranges.observed);
  return std::pair(log.landmarks[static_cast<std::size_t>(least - ranges.observed.begin())],
                   *least);
}

/// Ranges at the odometry's times, those into `result.Y` at which all are determined.
/// @return The poses at these times; none, with a status, if they are too few for a map.
Trajectory take_ranges(SpectralSlam& result, const RangeLog& log, const Trajectory& odometry,
                       const SpectralSlamOptions& options) {
  const std::vector<LandmarkRanges> measurements =
      ranges_by_landmark(log.ranges, std::ssize(log.landmarks), odometry);
  if (options.window) {
    result.window.options = *options.window;
  } else {
    result.window = choose_window(measurements, odometry, odometry.time_s);
  }
  WindowedRanges ranges =
      windowed_ranges(measurements, odometry, odometry.time_s, result.window.options);
  result.Y = std::move(ranges.Y);
  if (result.Y.rows() < kLeastLandmarks || result.Y.cols() < kLeastSteps) {
    const auto [landmark, poses] = worst_landmark(log, ranges);
    result.estimate.statuses.push_back(status_of<StatusReason::kFewPosesWithRanges>(
        {landmark}, result.Y.rows(), result.Y.cols(), odometry.size(), kLeastLandmarks, kLeastSteps,
        poses));
    return {};
  }
  if (result.Y.cols() < odometry.size()) {
    const auto [landmark, poses] = worst_landmark(log, ranges);
    result.estimate.statuses.push_back(status_of<StatusReason::kPosesWithoutWindow>(
        {landmark}, odometry.size() - result.Y.cols(), odometry.size(), poses));
  }
  return part_of(odometry, ranges.columns);
}

/// Statuses, spectrum and condition of a map.
void take_facts(SlamEstimate& estimate, const Mapped& mapped, const SpectralSlamOptions& options) {
  estimate.statuses.insert(estimate.statuses.end(), mapped.map.statuses.begin(),
                           mapped.map.statuses.end());
  estimate.singular_values = mapped.singular_values;
  const Eigen::Index rank = options.with_heading ? 7 : 4;
  if (mapped.singular_values.size() > rank) estimate.noise_level = mapped.singular_values(rank);
  if (mapped.map.condition && std::isfinite(*mapped.map.condition))
    estimate.condition = mapped.map.condition;
}

/// Poses in a window, 1 at least.
Eigen::Index poses_in_window(const Trajectory& path, double length_s) {
  const Eigen::Index last = path.size() - 1;
  const double share = std::min(1.0, length_s / (path.time_s(last) - path.time_s(0)));
  return std::max<Eigen::Index>(1, static_cast<Eigen::Index>(share * double(last)));
}

}  // namespace

LandmarksOnPath landmarks_on_path(const Points& positions_m, const Eigen::MatrixXd& Y) {
  if (Y.cols() != positions_m.rows()) throw InvalidInput("a column of ranges for each position");
  if (!positions_m.allFinite() || !Y.allFinite())
    throw InvalidInput("landmarks on a path need finite ranges and positions");
  if (!(planarity(positions_m) > kFlatPlanarity))
    throw InvalidInput("a path on one line does not determine the landmarks");

  // About the path's centre, where the columns are nearly at right angles.
  const Eigen::RowVector2d center = positions_m.colwise().mean();
  Eigen::MatrixXd A(positions_m.rows(), 3);
  A << Eigen::VectorXd::Ones(positions_m.rows()), positions_m.rowwise() - center;
  const Eigen::VectorXd q = 0.5 * A.rightCols(2).rowwise().squaredNorm();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);

  // What of Y and q no [1, p] explains: their ratio is b.
  const Eigen::MatrixXd of_ranges = qr.solve(Y.transpose());
  const Eigen::VectorXd of_q = qr.solve(q);
  const Eigen::VectorXd rest = q - A * of_q;
  LandmarksOnPath result;
  double b = 1.0;
  if (rest.squaredNorm() > kCircular * q.squaredNorm()) {
    const Eigen::VectorXd mean = Y.colwise().mean().transpose();
    b = rest.dot(mean) / rest.squaredNorm();
  }
  if (!(b > 0.0)) b = 1.0;
  result.range_scale = std::sqrt(b);
  const Eigen::MatrixXd coefficients = of_ranges.colwise() - b * of_q;
  result.landmarks_m = (-1.0 / b) * coefficients.bottomRows(2).transpose();
  result.landmarks_m.rowwise() += center;
  return result;
}

HeadingColumns heading_columns(const Eigen::MatrixXd& half_squares, const Eigen::VectorXd& moved_m,
                               double least_m) {
  const Eigen::Index N = half_squares.rows(), T = half_squares.cols();
  if (moved_m.size() + 1 != T) throw InvalidInput("a motion is needed between any two steps");
  if (!half_squares.allFinite() || !moved_m.allFinite())
    throw InvalidInput("ranges and motions must be finite");
  if (!(least_m > 0.0)) throw InvalidInput("the least motion must be above 0");
  HeadingColumns columns;
  for (Eigen::Index t = 0; t + 1 < T; ++t)
    if (std::abs(moved_m(t)) >= least_m) columns.steps.push_back(t);
  columns.Y.resize(2 * N, std::ssize(columns.steps));
  for (Eigen::Index k = 0; k < columns.Y.cols(); ++k) {
    const Eigen::Index t = columns.steps[static_cast<std::size_t>(k)];
    columns.Y.col(k) << half_squares.col(t),
        (half_squares.col(t + 1) - half_squares.col(t)) / moved_m(t);
  }
  return columns;
}

HeadingMap map_with_heading(const HeadingColumns& columns,
                            const std::optional<KnownLandmarks>& known) {
  const Eigen::Index N = columns.Y.rows() / 2, K = columns.Y.cols();
  HeadingMap result;
  if (N < kLeastLandmarksRank7 || K < kLeastColumns) {
    result.map.statuses.push_back(
        status_of<StatusReason::kFewStepsWithMotion>(N, K, kLeastLandmarksRank7, kLeastColumns));
    return result;
  }
  const Factorization factors = factorize(columns.Y, kRankWithHeading);
  const Factorization top = factorize(factors.U.topRows(N) * factors.V, 4);
  result.singular_values = factors.singular_values;
  result.map = known ? map_from_known_landmarks(top, *known) : metric_upgrade(top).map;
  result.map.statuses.insert(result.map.statuses.begin(), factors.statuses.begin(),
                             factors.statuses.end());
  if (!result.map.empty())
    result.heading_rad = headings(factors.U.bottomRows(N) * factors.V, landmarks_of(result.map.C));
  return result;
}

OdometryFit fit_to_odometry(const Points& positions_m, const Points& odometry_m,
                            Eigen::Index piece) {
  const Eigen::Index T = positions_m.rows();
  if (odometry_m.rows() != T || piece < 2)
    throw InvalidInput("odometry is compared pose by pose, in pieces of two or more");
  if (!positions_m.allFinite() || !odometry_m.allFinite())
    throw InvalidInput("paths must be finite to be compared");

  // As complex numbers a rotation with a scale is a factor a: |a| is the regression of the map on
  // odometry, which is the cleaner of the two over a short piece.
  std::vector<Piece> straight, mirrored;
  double upright = 0.0, turned = 0.0, total = 0.0;
  for (Eigen::Index first = 0; first < T; first += std::max<Eigen::Index>(piece / 2, 1)) {
    const Eigen::Index count = std::min(piece, T - first);
    if (count < 2) break;
    const Eigen::VectorXcd map = centered_as_complex(positions_m.middleRows(first, count));
    const Eigen::VectorXcd odometry = centered_as_complex(odometry_m.middleRows(first, count));
    const double moved = odometry.squaredNorm();
    if (!(moved > 0.0)) continue;
    const double as_is = std::abs(odometry.dot(map));
    const double as_mirror = std::abs((odometry.array() * map.array()).sum());
    straight.push_back({as_is / moved, moved});
    mirrored.push_back({as_mirror / moved, moved});
    upright += as_is * as_is / moved;
    turned += as_mirror * as_mirror / moved;
    total += moved;
  }
  OdometryFit fit;
  if (!(total > 0.0) || !(upright + turned > 0.0)) return fit;
  fit.mirrored = turned > upright;
  const double scale = weighted_median(fit.mirrored ? mirrored : straight, total);
  if (scale > 0.0) fit.scale = scale;
  fit.agreement = std::abs(upright - turned) / std::max(upright, turned);
  return fit;
}

SpectralSlam spectral_slam(const RangeLog& log, const Trajectory& odometry,
                           const SpectralSlamOptions& options) {
  check(log, odometry, options);
  SpectralSlam result;
  SlamEstimate& estimate = result.estimate;
  estimate.landmarks_m = Points::Constant(std::ssize(log.landmarks), 2, kNaN);
  estimate.path.positions_m.resize(0, 2);
  const Trajectory observed = take_ranges(result, log, odometry, options);
  if (observed.size() == 0) return result;

  const Mapped mapped = options.with_heading ? mapped_with_heading(result.Y, observed, options)
                                             : mapped_without_heading(result, options);
  take_facts(estimate, mapped, options);
  if (mapped.map.empty()) return result;
  const Points landmarks_m = landmarks_of(mapped.map.C);
  if (!(planarity(landmarks_m) > kFlatPlanarity)) {
    estimate.statuses.push_back(status_of<StatusReason::kMappedOnALine>());
    return result;
  }

  estimate.range_scale = result.window.options.range_scale * mapped.map.range_scale;
  result.Y /= mapped.map.range_scale * mapped.map.range_scale;
  estimate.landmarks_m = landmarks_m;
  estimate.path.positions_m = localise(landmarks_m, result.Y);
  estimate.path.time_s = observed.time_s;
  const Eigen::Index window = poses_in_window(observed, result.window.options.length_s);
  const bool mirrored =
      !options.known && settle_by_odometry(estimate, observed.positions_m, window);
  if (!mapped.directions.rows.empty())
    estimate.path.heading_rad = carried(mapped.directions, observed.heading_rad, mirrored);
  if (!options.known) refer_to_path(result);
  if (auto status = landmarks_on_a_line(estimate.landmarks_m))
    estimate.statuses.push_back(*std::move(status));
  if (options.replicates > 0)
    estimate.landmark_cov_m2 =
        bootstrap_landmarks(
            result.Y, estimate.landmarks_m, options.known,
            {.replicates = options.replicates, .block = window, .seed = options.seed})
            .covariances_m2;
  return result;
}

}  // namespace mapproof
