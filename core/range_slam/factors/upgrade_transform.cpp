#include "core/range_slam/factors/upgrade_transform.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/range_slam/factors/quadric.hpp"

namespace mapproof {
namespace {

/// An eigenvalue of a quadric at or below this share of the largest has no sign.
constexpr double kSignless = 1e-10;
/// A root with an imaginary part at or below this share is real.
constexpr double kRealRoot = 1e-6;
/// Another quadric must fit worse than the best by this.
constexpr double kClear = 2.0;

/// A quadric of the cone's signature, one minus and all others plus, scaled for the cone, with the
/// coordinates that make it the cone.
struct Candidate {
  Eigen::MatrixXd Q;
  Eigen::MatrixXd S;
};

/// Q or -Q, whichever has one negative eigenvalue and no other that is not positive; none if
/// neither has.
std::optional<Eigen::MatrixXd> with_cone_signature(const Eigen::MatrixXd& Q) {
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Q, Eigen::EigenvaluesOnly).eigenvalues();
  const double rounding = kSignless * values.cwiseAbs().maxCoeff();
  const Eigen::Index last = values.size() - 1;
  if (values(0) < -rounding && values(1) > rounding) return Q;
  if (values(last) > rounding && values(last - 1) < -rounding) return Eigen::MatrixXd(-Q);
  return std::nullopt;
}

/// The point of s4 + b m, b small, that is on the cone of Q; s4 itself if the line misses it.
Eigen::VectorXd on_cone(const Eigen::MatrixXd& Q, const Eigen::VectorXd& s4,
                        const Eigen::VectorXd& m) {
  const double a = m.dot(Q * m), b = 2.0 * s4.dot(Q * m), c = s4.dot(Q * s4);
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0) return s4;
  return s4 + 2.0 * c / (-b - std::copysign(std::sqrt(discriminant), b)) * m;
}

/// Coordinates S with S' Q S the cone, after Q is scaled so that U s4 is 1 on average.
/// @param w  The plane of scale 1: w' v = 1 for all states.
std::optional<Candidate> upgraded(const Eigen::MatrixXd& quadric, const Eigen::VectorXd& w,
                                  const Eigen::MatrixXd& U) {
  std::optional<Eigen::MatrixXd> Q = with_cone_signature(quadric);
  if (!Q) return std::nullopt;
  Eigen::VectorXd s4 = -Q->inverse() * w;
  const double lambda = (U * s4).mean();
  if (!(lambda > 0.0)) return std::nullopt;
  *Q *= lambda;
  s4 /= lambda;

  // The origin is put at the mean state, which in whitened coordinates lies along w.
  const Eigen::VectorXd m = w / w.squaredNorm();
  s4 = on_cone(*Q, s4, m);
  const double product = m.dot(*Q * s4);
  if (!(product < 0.0)) return std::nullopt;
  s4 /= -product;
  const Eigen::VectorXd s1 = m + 0.5 * m.dot(*Q * m) * s4;

  // The columns between: orthonormal with respect to Q, in the Q-complement of the first and last.
  const Eigen::Index n = w.size();
  Eigen::MatrixXd rows(2, n);
  rows << (*Q * s1).transpose(), (*Q * s4).transpose();
  const Eigen::MatrixXd complement =
      Eigen::JacobiSVD<Eigen::MatrixXd>(rows, Eigen::ComputeFullV).matrixV().rightCols(n - 2);
  const Eigen::MatrixXd between = complement.transpose() * *Q * complement;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> flat(between);
  if (!(flat.eigenvalues()(0) > 0.0)) return std::nullopt;
  Candidate candidate{.Q = *Q, .S = Eigen::MatrixXd(n, n)};
  candidate.S << s1,
      complement * flat.eigenvectors() * flat.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal(),
      s4;
  if (!candidate.S.allFinite()) return std::nullopt;
  return candidate;
}

/// How far the other side's states are from their cone, in units of their size.
double misfit(const Candidate& candidate, const Eigen::MatrixXd& U) {
  const Eigen::MatrixXd C = U * candidate.S;
  const Eigen::Index d = C.cols() - 2;
  const Eigen::ArrayXd lifted = 0.5 * C.middleCols(1, d).rowwise().squaredNorm().array();
  return ((C.col(0).array() - lifted).abs().sum()) / (lifted.sum() + C.col(0).cwiseAbs().sum()) +
         (C.col(d + 1).array() - 1.0).abs().mean();
}

/// Real (a, b) at which the dual of a A + b B vanishes on w: w' adj(a A + b B) w = 0, a form of
/// degree n - 1.
std::vector<Eigen::Vector2d> pencil_roots(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                                          const Eigen::VectorXd& w) {
  // w' adj(Q) w is minus the determinant of Q bordered by w.
  const Eigen::Index n = w.size();
  const auto form = [&](double a, double b) {
    Eigen::MatrixXd bordered(n + 1, n + 1);
    bordered << a * A + b * B, w, w.transpose(), 0.0;
    return -bordered.determinant();
  };
  // Coefficients c_k of a^(n-1-k) b^k, from n values around the half circle.
  Eigen::MatrixXd powers(n, n);
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double angle = std::numbers::pi * double(i) / double(n);
    const double a = std::cos(angle), b = std::sin(angle);
    for (Eigen::Index k = 0; k < n; ++k)
      powers(i, k) = std::pow(a, double(n - 1 - k)) * std::pow(b, double(k));
    values(i) = form(a, b);
  }
  Eigen::VectorXd c = powers.partialPivLu().solve(values);

  const bool in_b = std::abs(c(n - 1)) >= std::abs(c(0));
  if (!in_b) c.reverseInPlace();
  if (c(n - 1) == 0.0) return {{1.0, 0.0}, {0.0, 1.0}};
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n - 1, n - 1);
  companion.diagonal(-1).setOnes();
  companion.col(n - 2) = -c.head(n - 1) / c(n - 1);
  std::vector<Eigen::Vector2d> roots;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(companion, false);
  for (const std::complex<double>& x : solver.eigenvalues())
    if (std::abs(x.imag()) <= kRealRoot * (1.0 + std::abs(x)))
      roots.push_back(in_b ? Eigen::Vector2d(1.0, x.real()) : Eigen::Vector2d(x.real(), 1.0));
  return roots;
}

/// The best quadric of the pencil that the last two right singular vectors span.
std::optional<Candidate> best_of_pencil(const Eigen::MatrixXd& V, const Eigen::VectorXd& w,
                                        const Eigen::MatrixXd& U) {
  const Eigen::Index last = V.cols() - 1;
  const Eigen::MatrixXd A = quadric_of(V.col(last - 1)), B = quadric_of(V.col(last));
  std::optional<Candidate> best;
  double least = kInfinity;
  // The dual vanishes on the plane of scale 1, which determines all but a path along a conic, and
  // on every state of the other side, which determines that too.
  for (const Eigen::VectorXd& zero : {w, Eigen::VectorXd(U.row(0).transpose())})
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
                                      const Eigen::VectorXd& w, const Eigen::MatrixXd& U) {
  const Eigen::VectorXd& s = svd.singularValues();
  const Eigen::Index last = s.size() - 1;
  if (s(last - 2) <= rounding) return std::nullopt;
  if (s(last - 1) <= rounding) return best_of_pencil(svd.matrixV(), w, U);
  return upgraded(quadric_of(svd.matrixV().col(last)), w, U);
}

void check(const Eigen::MatrixXd& U, const Eigen::VectorXd& mean,
           const Eigen::MatrixXd& monomials) {
  const Eigen::Index n = mean.size();
  if (n < 4 || U.rows() < 1 || U.cols() != n || monomials.cols() != n * (n + 1) / 2)
    throw InvalidInput("an upgrade needs states of one size on both sides, and their monomials");
  if (!U.allFinite() || !mean.allFinite() || !monomials.allFinite())
    throw InvalidInput("an upgrade needs finite states");
}

}  // namespace

UpgradeTransform upgrade_transform(const Eigen::MatrixXd& U, const Eigen::VectorXd& mean,
                                   const Eigen::MatrixXd& monomials, double rounding) {
  check(U, mean, monomials);
  UpgradeTransform result;
  const Eigen::Index n = mean.size(), terms = monomials.cols();
  result.S = result.Q = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(std::max(monomials.rows(), terms), terms);
  rows.topRows(monomials.rows()) = monomials;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
  const Eigen::VectorXd& s = result.monomial_values = svd.singularValues();

  const bool is_pencil = s(terms - 2) <= rounding * s(0);
  const double vital = s(is_pencil ? terms - 3 : terms - 2);
  result.condition = vital > 0.0 ? s(0) / vital : kInfinity;
  const std::optional<Candidate> found = best_quadric(svd, rounding * s(0), mean, U);
  if (!found) {
    result.statuses.push_back(
        status_of<StatusReason::kNoQuadric>(n == 4 ? 2 : 3, result.condition));
    return result;
  }
  result.S = found->S;
  result.Q = found->Q;
  if (!is_pencil && s(terms - 2) < kClear * s(terms - 1))
    result.statuses.push_back(
        status_of<StatusReason::kOtherQuadric>(s(terms - 2) / s(terms - 1), result.condition));
  return result;
}

}  // namespace mapproof
