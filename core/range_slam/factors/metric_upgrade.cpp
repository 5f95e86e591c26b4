#include "core/range_slam/factors/metric_upgrade.hpp"

#include <cmath>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/range_slam/factors/quadric.hpp"
#include "core/range_slam/factors/upgrade_transform.hpp"

namespace mapproof {
namespace {

/// States that determine a quadric of n variables up to a pencil: all coefficients but two.
constexpr Eigen::Index fitted_states(Eigen::Index n) { return n * (n + 1) / 2 - 2; }
/// From this condition number on the last dimension is rounding.
constexpr double kFlat = 1e12;

/// States scaled to w' v = 1, in orthonormal coordinates of that plane, and the quadric there.
QuadricCloud in_plane(const Eigen::MatrixXd& V, const Eigen::VectorXd& w,
                      const Eigen::MatrixXd& Q) {
  const Eigen::Index n = w.size();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(w);
  const Eigen::MatrixXd basis = leading_columns(qr.householderQ(), n);
  Eigen::MatrixXd chart(n, n);  // [p; 1] to v
  chart << basis.rightCols(n - 1), w / w.squaredNorm();
  QuadricCloud cloud;
  const Eigen::RowVectorXd scale = (w.transpose() * V).cwiseInverse();
  cloud.points = (basis.rightCols(n - 1).transpose() * V * scale.asDiagonal()).transpose();
  cloud.Q = chart.transpose() * Q * chart;
  return cloud;
}

/// (p, |p|^2/2) of states, and the paraboloid.
QuadricCloud on_paraboloid(const Eigen::MatrixXd& X) {
  const Eigen::Index d = X.rows() - 2;
  QuadricCloud cloud;
  cloud.points.resize(X.cols(), d + 1);
  cloud.points << -X.middleRows(1, d).transpose(), X.row(d + 1).transpose();
  cloud.Q = Eigen::MatrixXd::Identity(d + 2, d + 2);
  cloud.Q.bottomRightCorner(2, 2) << 0.0, -1.0, -1.0, 0.0;
  return cloud;
}

/// U V = (V' U')', whose landmarks and poses have been exchanged, and so have the signs of their
/// positions.
Factorization with_sides_changed(const Factorization& factors) {
  Factorization changed = factors;
  changed.U = factors.V.transpose();
  changed.V = factors.U.transpose();
  return changed;
}

/// [r^2/2, -p, 1] from [1, -p, r^2/2] and back, the coordinates of p in reverse.
MetricUpgrade with_sides_changed_back(MetricUpgrade upgrade) {
  if (upgrade.map.empty()) return upgrade;
  const Eigen::MatrixXd C = upgrade.map.X.colwise().reverse().transpose();
  upgrade.map.X = upgrade.map.C.rowwise().reverse().transpose();
  upgrade.map.C = C;
  const Eigen::MatrixXd inverse = upgrade.S.inverse();
  upgrade.S = inverse.transpose().rowwise().reverse();
  return upgrade;
}

}  // namespace

MetricUpgrade metric_upgrade(const Factorization& factors, UpgradeSide side) {
  const Eigen::Index n = factors.U.cols();
  if (n < 4 || n > 5 || factors.V.rows() != n)
    throw InvalidInput("a metric upgrade needs a factorisation of rank 4 or 5");
  if (side == UpgradeSide::kLandmarks)
    return with_sides_changed_back(metric_upgrade(with_sides_changed(factors)));

  MetricUpgrade result;
  SpectralMap& map = result.map;
  map.statuses = factors.statuses;
  const Eigen::Index T = factors.V.cols();
  if (T < fitted_states(n) || factors.U.rows() < n) {
    map.statuses.push_back(
        status_of<StatusReason::kFewStates>(T, factors.U.rows(), fitted_states(n), n));
    return result;
  }

  // Whitened, or the fit is ill-conditioned.
  const Eigen::MatrixXd moments = factors.V * factors.V.transpose() / static_cast<double>(T);
  const Eigen::LLT<Eigen::MatrixXd> llt(moments);
  const Eigen::MatrixXd L = llt.matrixL();
  const Eigen::MatrixXd V = L.triangularView<Eigen::Lower>().solve(factors.V);
  if (factors.condition > kFlat || llt.info() != Eigen::Success || !V.allFinite()) {
    map.statuses.push_back(status_of<StatusReason::kStatesFlat>(n, factors.condition));
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
  map.X = state_cone(n - 2) * transform.S.transpose() * transform.Q * V;  // S^-1 V
  result.before = in_plane(V, V.rowwise().mean(), transform.Q);
  result.after = on_paraboloid(map.X);
  return result;
}

}  // namespace mapproof
