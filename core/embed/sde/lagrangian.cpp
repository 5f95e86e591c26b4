#include "core/embed/sde/lagrangian.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/linalg/decompositions.hpp"

namespace mapproof::unfolding {

namespace {

constexpr int kRoundsToJudgement = 40;
/// Of a typical squared distance: a column of less spread is dropped.
constexpr double kVanished = 1e-5;

/// Y rotated to its principal axes, ascending, without those that vanish.
Rows without_vanished(const Problem& problem, const Rows& Y) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(Eigen::MatrixXd(Y.transpose() * Y));
  const double least = kVanished * static_cast<double>(problem.points()) * problem.squared.mean();
  const Eigen::Index kept = (axes.eigenvalues().array() > least).count();
  return Y * axes.eigenvectors().rightCols(std::max<Eigen::Index>(kept, 1));
}

/// The solver's state between rounds.
class Ascent {
 public:
  Ascent(const Problem& problem, const Eigen::MatrixXd& start, const LowRankOptions& options)
      : problem_(problem),
        options_(options),
        lagrangian_(problem),
        Y_(start),
        w_(Eigen::VectorXd::Zero(problem.squared.size())) {
    centre(problem_, Y_);
  }

  CertifiedSolution run() {
    for (int round = 0; round < options_.max_rounds && !certified(); ++round) {
      lagrangian_.descend(Y_, w_, round < 3 || round % 5 == 0);
      const bool last = round + 1 == options_.max_rounds;
      if ((round + 1) % kRoundsToJudgement != 0 && !last) continue;
      judge();
      if (!last) adapt_rank();
    }
    if (best_.solution.Y.size() == 0) judge();
    best_.solution.iterations = lagrangian_.products();
    return best_;
  }

 private:
  bool certified() const {
    return best_.solution.Y.size() > 0 && best_.certificate.relative_gap <= options_.relative_gap &&
           best_.certificate.constraint_residual <= options_.constraint_residual;
  }

  double worth(const Certificate& certificate) const {
    return std::max(certificate.relative_gap / options_.relative_gap,
                    certificate.constraint_residual / options_.constraint_residual);
  }

  /// Keeps the state if no better bound was certified so far.
  void judge() {
    Solution candidate{.solver = SdpSolver::kLowRank, .Y = Y_, .w = w_};
    const Certificate certificate = certify(problem_, candidate);
    if (best_.solution.Y.size() > 0 && !(worth(certificate) < worth(best_.certificate))) return;
    best_ = {.solution = std::move(candidate), .certificate = certificate};
  }

  /// Up to three directions in which the dual is infeasible become columns.
  void adapt_rank() {
    const Eigen::MatrixXd T = dual_matrix(problem_, w_);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> slack(T);
    const double fit = residuals(problem_, Y_).cwiseAbs().maxCoeff();
    const double bar = 1.0 - std::max(10.0 * fit, 0.3 * options_.relative_gap);
    const Eigen::Index wanted = (slack.eigenvalues().head(3).array() < bar).count();
    Rows kept = without_vanished(problem_, Y_);
    if (wanted == 0 || kept.cols() + wanted > problem_.points()) {
      Y_ = std::move(kept);
      return;
    }
    const double size = 1e-2 * std::sqrt(Y_.squaredNorm() / static_cast<double>(Y_.cols()));
    Y_.resize(kept.rows(), kept.cols() + wanted);
    Y_ << kept, size * slack.eigenvectors().leftCols(wanted);
    centre(problem_, Y_);
  }

  const Problem& problem_;
  const LowRankOptions& options_;
  AugmentedLagrangian lagrangian_;
  Rows Y_;
  Eigen::VectorXd w_;
  CertifiedSolution best_;
};

constexpr double kPenalty = 10.0;
constexpr int kNewtonSteps = 2;
constexpr int kMostProducts = 60;  // A Newton step.
constexpr double kForcing = 0.1;   // Of the gradient, left over by conjugate gradients.

double dot(const Rows& A, const Rows& B) { return A.cwiseProduct(B).sum(); }

double variance(const Problem& problem, const Rows& Y) {
  const Eigen::RowVectorXd sum = problem.mass.transpose() * Y;
  return problem.mass.dot(Y.rowwise().squaredNorm()) - sum.squaredNorm() / problem.mass.sum();
}

/// -(M - M11'M / sum) Y.
void take_mass(const Problem& problem, const Rows& Y, Rows& out) {
  const Eigen::RowVectorXd mean = problem.mass.transpose() * Y / problem.mass.sum();
  out = problem.mass.asDiagonal() * (Y.rowwise() - mean);
  out = -out;
}

}  // namespace

CertifiedSolution solve_low_rank(const Problem& problem, const Eigen::MatrixXd& start,
                                 const LowRankOptions& options) {
  return Ascent(problem, start, options).run();
}

void centre(const Problem& problem, Rows& Y) {
  const Eigen::RowVectorXd mean = problem.mass.transpose() * Y / problem.mass.sum();
  Y.rowwise() -= mean;
}

Eigen::VectorXd residuals(const Problem& problem, const Rows& Y) {
  Eigen::VectorXd c(problem.squared.size());
  for (Eigen::Index k = 0; k < c.size(); ++k) {
    const auto& [i, j] = problem.pairs[static_cast<std::size_t>(k)];
    c(k) = (Y.row(i) - Y.row(j)).squaredNorm() - problem.squared(k);
  }
  return c;
}

Rows slack_times(const Problem& problem, const Eigen::VectorXd& w, const Rows& Y) {
  Rows out;
  take_mass(problem, Y, out);
  Eigen::RowVectorXd along(Y.cols());
  for (Eigen::Index k = 0; k < w.size(); ++k) {
    const auto& [i, j] = problem.pairs[static_cast<std::size_t>(k)];
    along.noalias() = w(k) * (Y.row(i) - Y.row(j));
    out.row(i) += along;
    out.row(j) -= along;
  }
  return out;
}

AugmentedLagrangian::AugmentedLagrangian(const Problem& problem)
    : problem_(problem),
      penalty_(kPenalty * problem.squared.cwiseMax(1e-3 * problem.squared.mean()).cwiseInverse()) {}

double AugmentedLagrangian::value(const Rows& Y, const Eigen::VectorXd& w,
                                  Eigen::VectorXd& c) const {
  c = residuals(problem_, Y);
  return w.dot(c) + 0.5 * (penalty_.array() * c.array().square()).sum() - variance(problem_, Y);
}

Eigen::VectorXd AugmentedLagrangian::multipliers(const Eigen::VectorXd& w,
                                                 const Eigen::VectorXd& c) const {
  return w + penalty_.cwiseProduct(c);
}

void AugmentedLagrangian::hessian_times(const Rows& Y, const Eigen::VectorXd& x, const Rows& V,
                                        Rows& out) {
  ++products_;
  take_mass(problem_, V, out);
  Eigen::RowVectorXd pull(Y.cols());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const auto& [i, j] = problem_.pairs[static_cast<std::size_t>(k)];
    const auto y = Y.row(i) - Y.row(j);
    const auto v = V.row(i) - V.row(j);
    const double stretch = 2.0 * penalty_(k) * y.dot(v);
    pull.noalias() = x(k) * v + stretch * y;
    out.row(i) += pull;
    out.row(j) -= pull;
  }
  out *= 2.0;
}

void AugmentedLagrangian::make_blocks(const Rows& Y, const Eigen::VectorXd& x) {
  const Eigen::Index rank = Y.cols();
  blocks_.assign(static_cast<std::size_t>(Y.rows()), Eigen::MatrixXd::Zero(rank, rank));
  Eigen::VectorXd degree = -problem_.mass;
  Eigen::MatrixXd outer(rank, rank);
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const auto& [i, j] = problem_.pairs[static_cast<std::size_t>(k)];
    const Eigen::VectorXd y = Y.row(i) - Y.row(j);
    outer.noalias() = (4.0 * penalty_(k)) * y * y.transpose();
    blocks_[static_cast<std::size_t>(i)] += outer;
    blocks_[static_cast<std::size_t>(j)] += outer;
    degree(i) += x(k);
    degree(j) += x(k);
  }
  for (Eigen::Index i = 0; i < Y.rows(); ++i) {
    Eigen::MatrixXd& block = blocks_[static_cast<std::size_t>(i)];
    block.diagonal().array() += std::max(2.0 * degree(i), 0.5);
    block = block.llt().solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(rank, rank)));
  }
}

Rows AugmentedLagrangian::preconditioned(const Rows& R) const {
  Rows Z(R.rows(), R.cols());
  for (Eigen::Index i = 0; i < R.rows(); ++i)
    Z.row(i).transpose().noalias() = blocks_[static_cast<std::size_t>(i)] * R.row(i).transpose();
  return Z;
}

Rows AugmentedLagrangian::newton_direction(const Rows& Y, const Eigen::VectorXd& x,
                                           const Rows& gradient) {
  const double target = kForcing * gradient.norm();
  Rows direction = Rows::Zero(Y.rows(), Y.cols());
  Rows rest = -gradient;
  Rows step = preconditioned(rest);
  Rows product;
  double size = dot(rest, step);
  for (int count = 0; count < kMostProducts; ++count) {
    hessian_times(Y, x, step, product);
    const double curvature = dot(step, product);
    if (!(curvature > 1e-14 * step.squaredNorm())) {
      if (count == 0) direction = step;
      break;
    }
    const double length = size / curvature;
    direction += length * step;
    rest -= length * product;
    if (rest.norm() <= target) break;
    const Rows scaled = preconditioned(rest);
    const double next = dot(rest, scaled);
    step = scaled + (next / size) * step;
    size = next;
  }
  return direction;
}

void AugmentedLagrangian::descend(Rows& Y, Eigen::VectorXd& w, bool refresh) {
  Eigen::VectorXd c;
  double f = value(Y, w, c);
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Eigen::VectorXd x = multipliers(w, c);
    const Rows gradient = 2.0 * slack_times(problem_, x, Y);
    if (gradient.norm() <= c.cwiseAbs().maxCoeff()) break;
    if (blocks_.empty() || blocks_.front().rows() != Y.cols() || (refresh && step == 0))
      make_blocks(Y, x);
    const Rows direction = newton_direction(Y, x, gradient);
    const double slope = dot(gradient, direction);
    double length = 1.0;
    for (int halvings = 0; halvings < 30; ++halvings, length /= 2.0) {
      Rows next = Y + length * direction;
      Eigen::VectorXd next_c;
      const double next_f = value(next, w, next_c);
      if (next_f > f + 1e-4 * length * slope + 1e-13 * std::abs(f)) continue;
      centre(problem_, next);
      Y = std::move(next);
      c = std::move(next_c);
      f = next_f;
      break;
    }
  }
  w = multipliers(w, c);
}

}  // namespace mapproof::unfolding
