#include "core/embed/sde/low_rank.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

#include "core/embed/sde/kkt_newton.hpp"
#include "core/embed/sde/lagrangian.hpp"

namespace mapproof::unfolding {
namespace {

constexpr double kFitForNewton = 2e-3;  // Residual from which direct steps are tried.
constexpr int kDirectSteps = 12;
constexpr double kSolved = 1e-9;
constexpr double kWayOff = 0.1;
constexpr double kVanished =
    1e-5;  // Of a typical squared distance: a column of less spread is dropped.

/// Y turned to its principal axes, ascending, without those that vanish.
Rows without_vanished(const Problem& problem, const Rows& Y) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(Y.transpose() * Y);
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

  ProvedSolution run() {
    const bool direct = problem_.squared.size() <= kMostDirectPairs;
    const int most = direct ? options_.max_rounds : options_.max_rounds_of_many_pairs;
    for (int round = 0; round < most && !proved(); ++round) {
      lagrangian_.descend(Y_, w_, round < 3 || round % 5 == 0);
      const double fit = residuals(problem_, Y_).cwiseAbs().maxCoeff();
      if (direct) {
        if (fit > fit_for_newton_) continue;
        take_direct_steps();
        judge();
        adapt_rank();
      } else if (round % 40 == 39) {
        judge();
        adapt_rank();
      }
    }
    if (best_.solution.Y.size() == 0) judge();
    best_.solution.iterations = lagrangian_.products();
    return best_;
  }

 private:
  bool proved() const {
    return best_.solution.Y.size() > 0 && best_.certificate.relative_gap <= options_.relative_gap &&
           best_.certificate.constraint_residual <= options_.constraint_residual;
  }

  /// Newton steps as long as they help. Far from the solution their quadratic terms win: such a
  /// step is kept for its better w, and the Lagrangian mends Y before the next try.
  void take_direct_steps() {
    Y_ = without_vanished(problem_, Y_);
    KktResiduals now = kkt_residuals(problem_, Y_, w_);
    for (int step = 0; step < kDirectSteps && now.sum() > kSolved; ++step) {
      const auto change = kkt_newton_step(problem_, Y_, w_, damping_);
      if (!change) break;
      const KktResiduals after = kkt_residuals(problem_, Y_ + change->Y, w_ + change->w);
      if (after.pairs > kWayOff) break;
      Y_ = without_vanished(problem_, Y_ + change->Y);
      w_ += change->w;
      if (after.pairs > 2.0 * now.pairs && after.pairs > 1e-8) break;
      now = after;
    }
    fit_for_newton_ *= 0.7;
  }

  double worth(const Certificate& certificate) const {
    return std::max(certificate.relative_gap / options_.relative_gap,
                    certificate.constraint_residual / options_.constraint_residual);
  }

  /// Keeps the state if nothing better was proved so far.
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
  double damping_ = 1.0;
  double fit_for_newton_ = kFitForNewton;
  ProvedSolution best_;
};

}  // namespace

ProvedSolution solve_low_rank(const Problem& problem, const Eigen::MatrixXd& start,
                              const LowRankOptions& options) {
  return Ascent(problem, start, options).run();
}

}  // namespace mapproof::unfolding
