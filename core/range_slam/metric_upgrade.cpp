#include "core/range_slam/metric_upgrade.hpp"

#include <cmath>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include "core/base/errors.hpp"
#include "core/range_slam/quadric.hpp"
#include "core/range_slam/upgrade_transform.hpp"

namespace mapproof {
namespace {

/// Least numbers of states: eight settle the quadric, four span the space.
constexpr Eigen::Index kFitted = 8;
constexpr Eigen::Index kOther = 4;
/// From this condition number on the fourth dimension is rounding.
constexpr double kFlat = 1e12;

/// States scaled to w' v = 1, in orthonormal coordinates of that plane, and the quadric there.
QuadricCloud in_plane(const Eigen::MatrixXd& V, const Eigen::Vector4d& w,
                      const Eigen::Matrix4d& Q) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(w);
  const Eigen::Matrix4d basis = qr.householderQ();
  Eigen::Matrix4d chart;  // [p; 1] to v
  chart << basis.rightCols<3>(), w / w.squaredNorm();
  QuadricCloud cloud;
  const Eigen::RowVectorXd scale = (w.transpose() * V).cwiseInverse();
  cloud.points = (basis.rightCols<3>().transpose() * V * scale.asDiagonal()).transpose();
  cloud.Q = chart.transpose() * Q * chart;
  return cloud;
}

/// (x, y, (x^2 + y^2)/2) of states, and the paraboloid.
QuadricCloud on_paraboloid(const Eigen::MatrixXd& X) {
  QuadricCloud cloud;
  cloud.points.resize(X.cols(), 3);
  cloud.points << -X.middleRows(1, 2).transpose(), X.row(3).transpose();
  cloud.Q << 1.0, 0.0, 0.0, 0.0,  //
      0.0, 1.0, 0.0, 0.0,         //
      0.0, 0.0, 0.0, -1.0,        //
      0.0, 0.0, -1.0, 0.0;
  return cloud;
}

/// U V = (V' U')', whose landmarks and poses have changed places and the signs of their positions.
Factorization with_sides_changed(const Factorization& factors) {
  Factorization changed = factors;
  changed.U = factors.V.transpose();
  changed.V = factors.U.transpose();
  return changed;
}

/// [r^2/2, -x, -y, 1] from [1, -x, -y, r^2/2] and back.
MetricUpgrade with_sides_changed_back(MetricUpgrade upgrade) {
  if (upgrade.map.empty()) return upgrade;
  const Eigen::MatrixXd C = upgrade.map.X.colwise().reverse().transpose();
  upgrade.map.X = upgrade.map.C.rowwise().reverse().transpose();
  upgrade.map.C = C;
  const Eigen::Matrix4d inverse = upgrade.S.inverse();
  upgrade.S = inverse.transpose().rowwise().reverse();
  return upgrade;
}

}  // namespace

MetricUpgrade metric_upgrade(const Factorization& factors, UpgradeSide side) {
  if (factors.U.cols() != 4 || factors.V.rows() != 4)
    throw InvalidInput("a metric upgrade needs a factorisation of rank 4");
  if (side == UpgradeSide::kLandmarks)
    return with_sides_changed_back(metric_upgrade(with_sides_changed(factors)));

  MetricUpgrade result;
  SpectralMap& map = result.map;
  map.statuses = factors.statuses;
  const Eigen::Index T = factors.V.cols();
  if (T < kFitted || factors.U.rows() < kOther) {
    map.statuses.push_back({StatusCode::kTooFewObservations,
                            fmt::format("{} states against {} on the other side; {} against {} "
                                        "are needed.",
                                        T, factors.U.rows(), kFitted, kOther)});
    return result;
  }

  // Whitened, or the fit is ill-conditioned.
  const Eigen::LLT<Eigen::Matrix4d> llt(factors.V * factors.V.transpose() / static_cast<double>(T));
  const Eigen::Matrix4d L = llt.matrixL();
  const Eigen::MatrixXd V = L.triangularView<Eigen::Lower>().solve(factors.V);
  if (factors.condition > kFlat || llt.info() != Eigen::Success || !V.allFinite()) {
    map.statuses.push_back({StatusCode::kDegenerateGeometry,
                            fmt::format("The states do not span four dimensions: condition number "
                                        "{:.3g}.",
                                        factors.condition)});
    return result;
  }
  const Eigen::MatrixXd U = factors.U * L;
  const UpgradeTransform transform =
      upgrade_transform(U, V.rowwise().mean(), triangle_of(quadratic_monomials(V)));
  map.condition = transform.condition;
  map.statuses.insert(map.statuses.end(), transform.statuses.begin(), transform.statuses.end());
  result.monomial_values = transform.monomial_values;
  if (transform.S.isZero()) return result;

  result.S = L * transform.S;
  map.C = U * transform.S;
  map.X = state_cone() * transform.S.transpose() * transform.Q * V;  // S^-1 V
  result.before = in_plane(V, V.rowwise().mean(), transform.Q);
  result.after = on_paraboloid(map.X);
  return result;
}

}  // namespace mapproof
