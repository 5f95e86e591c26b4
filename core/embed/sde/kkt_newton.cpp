#include "core/embed/sde/kkt_newton.hpp"

#include <algorithm>

#include "core/linalg/cholesky.hpp"
#include "core/linalg/decompositions.hpp"

namespace mapproof::unfolding {
namespace {

constexpr double kLeastShift = 1e-6;

/// L(w) - M, the eigenvalue of the constant vector lifted.
Eigen::MatrixXd slack_matrix(const Problem& problem, const Eigen::VectorXd& w) {
  Eigen::MatrixXd S = -Eigen::MatrixXd(problem.mass.asDiagonal());
  S.noalias() += (3.0 / problem.mass.sum()) * problem.mass * problem.mass.transpose();
  for (Eigen::Index k = 0; k < w.size(); ++k) {
    const auto& [i, j] = problem.pairs[static_cast<std::size_t>(k)];
    S(i, j) -= w(k);
    S(j, i) -= w(k);
    S(i, i) += w(k);
    S(j, j) += w(k);
  }
  return S;
}

/// 2 (b_k' G b_l) (b_k' P b_l) over pairs k and l, where b_k = e_i - e_j: the lower triangle.
Eigen::MatrixXd pairs_matrix(const Problem& problem, const Eigen::MatrixXd& G,
                             const Eigen::MatrixXd& P) {
  const Eigen::Index m = problem.squared.size();
  Eigen::MatrixXd T(m, m);
  Eigen::VectorXd g(G.rows());
  Eigen::VectorXd p(G.rows());
  for (Eigen::Index l = 0; l < m; ++l) {
    const auto& [a, b] = problem.pairs[static_cast<std::size_t>(l)];
    g.noalias() = 2.0 * (G.col(a) - G.col(b));
    p.noalias() = P.col(a) - P.col(b);
    for (Eigen::Index k = l; k < m; ++k) {
      const auto& [i, j] = problem.pairs[static_cast<std::size_t>(k)];
      T(k, l) = (g(i) - g(j)) * (p(i) - p(j));
    }
  }
  return T;
}

}  // namespace

KktResiduals kkt_residuals(const Problem& problem, const Rows& Y, const Eigen::VectorXd& w) {
  return {.pairs = residuals(problem, Y).norm(), .gradient = slack_times(problem, w, Y).norm()};
}

std::optional<KktStep> kkt_newton_step(const Problem& problem, const Rows& Y,
                                       const Eigen::VectorXd& w) {
  const Rows gradient = slack_times(problem, w, Y);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> slack(slack_matrix(problem, w));
  if (slack.info() != Eigen::Success) return std::nullopt;
  const double lowest = slack.eigenvalues()(0);
  const double shift = std::max({kLeastShift, -2.0 * lowest, 2.0 * gradient.norm() / Y.norm()});
  const Eigen::MatrixXd& Q = slack.eigenvectors();
  const Eigen::MatrixXd G =
      Q * (slack.eigenvalues().array() + shift).inverse().matrix().asDiagonal() * Q.transpose();

  Eigen::MatrixXd T = pairs_matrix(problem, G, Y * Y.transpose());
  // Distances that follow from others leave w undetermined: take a small change.
  T.diagonal().array() += 1e-12 * T.diagonal().mean();
  const Rows pulled = G * gradient;
  Eigen::VectorXd right = residuals(problem, Y);
  for (Eigen::Index k = 0; k < right.size(); ++k) {
    const auto& [i, j] = problem.pairs[static_cast<std::size_t>(k)];
    right(k) -= 2.0 * (Y.row(i) - Y.row(j)).dot(pulled.row(i) - pulled.row(j));
  }
  if (!factor_cholesky(T)) return std::nullopt;
  const Eigen::VectorXd change = solve_cholesky(T, right);

  Rows force = -gradient;
  for (Eigen::Index k = 0; k < change.size(); ++k) {
    const auto& [i, j] = problem.pairs[static_cast<std::size_t>(k)];
    const Eigen::RowVectorXd along = change(k) * (Y.row(i) - Y.row(j));
    force.row(i) -= along;
    force.row(j) += along;
  }
  KktStep step{.Y = G * force, .w = change};
  if (!step.Y.allFinite() || !step.w.allFinite()) return std::nullopt;
  centre(problem, step.Y);
  return step;
}

}  // namespace mapproof::unfolding
