#include "core/embed/sde/low_rank.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/embed/sde/lagrangian.hpp"
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

  ProvedSolution run() {
    for (int round = 0; round < options_.max_rounds && !proved(); ++round) {
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
  bool proved() const {
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
  ProvedSolution best_;
};

}  // namespace

ProvedSolution solve_low_rank(const Problem& problem, const Eigen::MatrixXd& start,
                              const LowRankOptions& options) {
  return Ascent(problem, start, options).run();
}

}  // namespace mapproof::unfolding
