#include "core/range_slam/known_landmarks.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "core/base/errors.hpp"
#include "core/range_slam/log_checks.hpp"
#include "core/range_slam/squared_ranges.hpp"

namespace mapproof {
namespace {

void check(const Factorization& factors, const KnownLandmarks& known) {
  if (factors.U.cols() < 4 || factors.V.rows() != factors.U.cols() || factors.V.cols() < 4)
    throw InvalidInput("a map needs a factorisation of rank 4 or more");
  if (const std::string problem = known_problem(known, factors.U.rows()); !problem.empty())
    throw InvalidInput(problem);
}

/// Takes X of points moved by -center and divided by `unit` to X of the points.
Eigen::Matrix4d to_metres(const Eigen::RowVector2d& center, double unit) {
  Eigen::Matrix4d change;
  change << 1.0, 0.0, 0.0, 0.0,    //
      -center(0), unit, 0.0, 0.0,  //
      -center(1), 0.0, unit, 0.0,  //
      0.5 * center.squaredNorm(), -unit * center, unit * unit;
  return change;
}

}  // namespace

SpectralMap map_from_known_landmarks(const Factorization& factors, const KnownLandmarks& known) {
  check(factors, known);
  SpectralMap map;
  map.statuses = factors.statuses;
  if (known.rows.size() < 4) {
    map.statuses.push_back(
        {StatusCode::kTooFewObservations,
         fmt::format("{} landmarks are known, 4 are needed.", known.rows.size())});
    return map;
  }

  // In units of their spread about their centre the condition is one of shape alone.
  const Eigen::RowVector2d center = known.positions_m.colwise().mean();
  const Points offsets = known.positions_m.rowwise() - center;
  const double unit = std::sqrt(offsets.squaredNorm() / static_cast<double>(offsets.rows()));
  const Points shape = unit > 0.0 ? Points(offsets / unit) : offsets;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(landmark_states(shape),
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& s = svd.singularValues();
  map.condition = s(3) > 0.0 ? s(0) / s(3) : std::numeric_limits<double>::infinity();
  if (!(*map.condition < kDegenerateCondition)) {
    map.statuses.push_back({StatusCode::kDegenerateGeometry,
                            fmt::format("The known landmarks lie on one line or circle: condition "
                                        "number {:.3g}.",
                                        *map.condition)});
    return map;
  }

  // U = C S^-1 on the known rows, so X = S^-1 V; longer ranges lengthen all of X.
  const Eigen::MatrixXd small_X =
      svd.solve(factors.U(known.rows, Eigen::all)) / (unit * unit) * factors.V;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(small_X.transpose());
  const Eigen::Matrix4d change = to_metres(center, unit);
  const double squared_scale = small_X.row(0).mean();
  if (!(squared_scale > 0.0) || qr.rank() < 4) {
    map.statuses.push_back({StatusCode::kFailed,
                            "The ranges do not tell positions from the known landmarks: their rank "
                            "is lower than that of a path in the plane."});
    return map;
  }
  map.X = change * small_X / squared_scale;
  map.range_scale = std::sqrt(squared_scale);
  // C = U S, by regression of U V on X.
  const Eigen::MatrixXd S = qr.solve(factors.V.transpose()).transpose();
  map.C = factors.U * S * change.inverse();
  return map;
}

}  // namespace mapproof
