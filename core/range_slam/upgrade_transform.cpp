#include "core/range_slam/upgrade_transform.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "core/base/errors.hpp"
#include "core/range_slam/quadric.hpp"

namespace mapproof {
namespace {

/// An eigenvalue of a quadric at or below this share of the largest has no sign.
constexpr double kSignless = 1e-10;
/// A root with an imaginary part at or below this share is real.
constexpr double kRealRoot = 1e-6;
/// Another quadric must fit worse than the best by this.
constexpr double kClear = 2.0;

/// A quadric of signature (+++-), scaled for the cone, with the coordinates that make it the cone.
struct Candidate {
  Eigen::Matrix4d Q;
  Eigen::Matrix4d S;
};

/// Q or -Q, whichever has three positive eigenvalues; none if neither has.
std::optional<Eigen::Matrix4d> with_cone_signature(const Eigen::Matrix4d& Q) {
  const Eigen::Vector4d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(Q, Eigen::EigenvaluesOnly).eigenvalues();
  const double rounding = kSignless * values.cwiseAbs().maxCoeff();
  if (values(0) < -rounding && values(1) > rounding) return Q;
  if (values(3) > rounding && values(2) < -rounding) return Eigen::Matrix4d(-Q);
  return std::nullopt;
}

/// The point of s4 + b m, b small, that is on the cone of Q; s4 itself if the line misses it.
Eigen::Vector4d on_cone(const Eigen::Matrix4d& Q, const Eigen::Vector4d& s4,
                        const Eigen::Vector4d& m) {
  const double a = m.dot(Q * m), b = 2.0 * s4.dot(Q * m), c = s4.dot(Q * s4);
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0) return s4;
  return s4 + 2.0 * c / (-b - std::copysign(std::sqrt(discriminant), b)) * m;
}

/// Coordinates S with S' Q S the cone, after Q is scaled so that U s4 is 1 on average.
/// @param w  The plane of scale 1: w' v = 1 for all states.
std::optional<Candidate> upgraded(const Eigen::Matrix4d& quadric, const Eigen::Vector4d& w,
                                  const Eigen::MatrixXd& U) {
  std::optional<Eigen::Matrix4d> Q = with_cone_signature(quadric);
  if (!Q) return std::nullopt;
  Eigen::Vector4d s4 = -Q->inverse() * w;
  const double lambda = (U * s4).mean();
  if (!(lambda > 0.0)) return std::nullopt;
  *Q *= lambda;
  s4 /= lambda;

  // The origin is put at the mean state, which in whitened coordinates lies along w.
  const Eigen::Vector4d m = w / w.squaredNorm();
  s4 = on_cone(*Q, s4, m);
  const double product = m.dot(*Q * s4);
  if (!(product < 0.0)) return std::nullopt;
  s4 /= -product;
  const Eigen::Vector4d s1 = m + 0.5 * m.dot(*Q * m) * s4;

  // s2 and s3: orthonormal with respect to Q, in the Q-complement of s1 and s4.
  Eigen::Matrix<double, 2, 4> rows;
  rows << (*Q * s1).transpose(), (*Q * s4).transpose();
  const Eigen::Matrix<double, 4, 2> complement =
      Eigen::JacobiSVD<Eigen::Matrix<double, 2, 4>>(rows, Eigen::ComputeFullV)
          .matrixV()
          .rightCols<2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> plane(complement.transpose() * *Q *
                                                             complement);
  if (!(plane.eigenvalues()(0) > 0.0)) return std::nullopt;
  Candidate candidate{.Q = *Q, .S = Eigen::Matrix4d::Zero()};
  candidate.S << s1,
      complement * plane.eigenvectors() *
          plane.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal(),
      s4;
  if (!candidate.S.allFinite()) return std::nullopt;
  return candidate;
}

/// How far the other side's states are from their cone, in units of their size.
double misfit(const Candidate& candidate, const Eigen::MatrixXd& U) {
  const Eigen::MatrixXd C = U * candidate.S;
  const Eigen::ArrayXd lifted = 0.5 * C.middleCols(1, 2).rowwise().squaredNorm().array();
  return ((C.col(0).array() - lifted).abs().sum()) / (lifted.sum() + C.col(0).cwiseAbs().sum()) +
         (C.col(3).array() - 1.0).abs().mean();
}

/// Real (a, b) at which the dual of a A + b B vanishes on w: w' adj(a A + b B) w = 0, a cubic.
std::vector<Eigen::Vector2d> pencil_roots(const Eigen::Matrix4d& A, const Eigen::Matrix4d& B,
                                          const Eigen::Vector4d& w) {
  // w' adj(Q) w is minus the determinant of Q bordered by w.
  const auto form = [&](double a, double b) {
    Eigen::Matrix<double, 5, 5> bordered;
    bordered << a * A + b * B, w, w.transpose(), 0.0;
    return -bordered.determinant();
  };
  // a^3 f0 + a^2 b f1 + a b^2 f2 + b^3 f3, from four values.
  const double f0 = form(1.0, 0.0), f3 = form(0.0, 1.0);
  const double sum = form(1.0, 1.0) - f0 - f3, difference = form(1.0, -1.0) - f0 + f3;
  const double f1 = 0.5 * (sum - difference), f2 = 0.5 * (sum + difference);

  const bool in_b = std::abs(f3) >= std::abs(f0);
  const std::array<double, 4> c = in_b ? std::array{f0, f1, f2, f3} : std::array{f3, f2, f1, f0};
  if (c[3] == 0.0) return {{1.0, 0.0}, {0.0, 1.0}};
  Eigen::Matrix3d companion;
  companion << 0.0, 0.0, -c[0] / c[3],  //
      1.0, 0.0, -c[1] / c[3],           //
      0.0, 1.0, -c[2] / c[3];
  std::vector<Eigen::Vector2d> roots;
  for (const std::complex<double>& x : Eigen::EigenSolver<Eigen::Matrix3d>(companion).eigenvalues())
    if (std::abs(x.imag()) <= kRealRoot * (1.0 + std::abs(x)))
      roots.push_back(in_b ? Eigen::Vector2d(1.0, x.real()) : Eigen::Vector2d(x.real(), 1.0));
  return roots;
}

/// The best quadric of the pencil that the last two right singular vectors span.
std::optional<Candidate> best_of_pencil(const Eigen::MatrixXd& V, const Eigen::Vector4d& w,
                                        const Eigen::MatrixXd& U) {
  const Eigen::Matrix4d A = quadric_of(V.col(8)), B = quadric_of(V.col(9));
  std::optional<Candidate> best;
  double least = std::numeric_limits<double>::infinity();
  // The dual vanishes on the plane of scale 1, which settles all but a path along a conic, and on
  // every state of the other side, which settles that too.
  for (const Eigen::Vector4d& zero : {w, Eigen::Vector4d(U.row(0).transpose())})
    for (const Eigen::Vector2d& root : pencil_roots(A, B, zero)) {
      const Eigen::Vector2d share = root.normalized();
      const auto candidate = upgraded(share(0) * A + share(1) * B, w, U);
      if (!candidate || !(misfit(*candidate, U) < least)) continue;
      least = misfit(*candidate, U);
      best = candidate;
    }
  return best;
}

/// The quadric of the last right singular vector, or where a pencil of the last two fits the best
/// of it.
/// @param rounding  Singular values at or below it are 0.
std::optional<Candidate> best_quadric(const Eigen::JacobiSVD<Eigen::MatrixXd>& svd, double rounding,
                                      const Eigen::Vector4d& w, const Eigen::MatrixXd& U) {
  const Eigen::VectorXd& s = svd.singularValues();
  if (s(7) <= rounding) return std::nullopt;
  if (s(8) <= rounding) return best_of_pencil(svd.matrixV(), w, U);
  return upgraded(quadric_of(svd.matrixV().col(9)), w, U);
}

void check(const Eigen::MatrixXd& U, const Eigen::Vector4d& mean,
           const Eigen::MatrixXd& monomials) {
  if (U.rows() < 1 || U.cols() != 4 || monomials.cols() != 10)
    throw InvalidInput("an upgrade needs 4 states of the other side, and 10 monomials");
  if (!U.allFinite() || !mean.allFinite() || !monomials.allFinite())
    throw InvalidInput("an upgrade needs finite states");
}

}  // namespace

UpgradeTransform upgrade_transform(const Eigen::MatrixXd& U, const Eigen::Vector4d& mean,
                                   const Eigen::MatrixXd& monomials, double rounding) {
  check(U, mean, monomials);
  UpgradeTransform result;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(std::max<Eigen::Index>(monomials.rows(), 10), 10);
  rows.topRows(monomials.rows()) = monomials;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
  const Eigen::VectorXd& s = result.monomial_values = svd.singularValues();

  const bool is_pencil = s(8) <= rounding * s(0);
  const double vital = s(is_pencil ? 7 : 8);
  result.condition = vital > 0.0 ? s(0) / vital : std::numeric_limits<double>::infinity();
  const std::optional<Candidate> found = best_quadric(svd, rounding * s(0), mean, U);
  if (!found) {
    result.statuses.push_back(
        {StatusCode::kDegenerateGeometry,
         fmt::format("No quadric of a path in the plane fits the states: condition number {:.3g}.",
                     result.condition)});
    return result;
  }
  result.S = found->S;
  result.Q = found->Q;
  if (!is_pencil && s(8) < kClear * s(9))
    result.statuses.push_back(
        {StatusCode::kUndetermined,
         fmt::format("Another quadric fits the states nearly as well as the one taken: {:.3g} "
                     "times its misfit, condition number {:.3g}.",
                     s(8) / s(9), result.condition)});
  return result;
}

}  // namespace mapproof
