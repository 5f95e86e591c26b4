#include "core/range_slam/upgraded_path.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/planarity.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"

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
  for (const Piece& piece : pieces)
    if ((below += piece.weight) >= 0.5 * total) return piece.scale;
  return 1.0;
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

}  // namespace mapproof
