#include "core/embed/sde/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "core/embed/sde/kkt_newton.hpp"
#include "core/linalg/cholesky.hpp"

namespace mapproof::unfolding {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kOfTheWay = 0.95;  // To the boundary.
constexpr double kGapToPolish = 1e-7;
constexpr Index kMostPolishedRank = 3;
constexpr int kMostPolishingSteps = 5;
constexpr double kPolished = 1e-9;
constexpr double kLift = 0.1;  // Of a typical squared distance, into the interior.

/// The program with the first point at the origin: matrices of the others.
class Reduced {
 public:
  explicit Reduced(const Problem& problem) : problem_(problem), n_(problem.points() - 1) {
    const VectorXd mass = problem.mass.tail(n_);
    C_ = -mass * mass.transpose() / problem.mass.sum();
    C_.diagonal() += mass;
  }

  Index size() const { return n_; }
  Index pairs() const { return problem_.squared.size(); }
  const MatrixXd& C() const { return C_; }
  const VectorXd& squared() const { return problem_.squared; }

  /// b_k' P b_k per pair; P may be unsymmetric.
  VectorXd along_pairs(const MatrixXd& P) const {
    VectorXd result(pairs());
    for (Index k = 0; k < pairs(); ++k) {
      const auto [i, j] = ends(k);
      result(k) = P(j, j);
      if (i >= 0) result(k) += P(i, i) - P(i, j) - P(j, i);
    }
    return result;
  }

  /// sum of w_k b_k b_k'.
  MatrixXd laplacian(const VectorXd& w) const {
    MatrixXd L = MatrixXd::Zero(n_, n_);
    for (Index k = 0; k < pairs(); ++k) {
      const auto [i, j] = ends(k);
      L(j, j) += w(k);
      if (i < 0) continue;
      L(i, i) += w(k);
      L(i, j) -= w(k);
      L(j, i) -= w(k);
    }
    return L;
  }

  /// (b_k' P b_l)(b_k' Q b_l) for k >= l.
  void schur(const MatrixXd& P, const MatrixXd& Q, MatrixXd& S) const {
    S.resize(pairs(), pairs());
    // Both products of a point in one place; the origin's are zero.
    Eigen::Matrix2Xd pq = Eigen::Matrix2Xd::Zero(2, n_ + 1);
    for (Index l = 0; l < pairs(); ++l) {
      const auto [a, b] = ends(l);
      pq.row(0).tail(n_) = P.col(b).transpose();
      pq.row(1).tail(n_) = Q.col(b).transpose();
      if (a >= 0) {
        pq.row(0).tail(n_) -= P.col(a).transpose();
        pq.row(1).tail(n_) -= Q.col(a).transpose();
      }
      for (Index k = l; k < pairs(); ++k) {
        const auto& [i, j] = problem_.pairs[static_cast<std::size_t>(k)];
        S(k, l) = (pq(0, i) - pq(0, j)) * (pq(1, i) - pq(1, j));
      }
    }
  }

 private:
  Pair ends(Index k) const {
    const auto& [i, j] = problem_.pairs[static_cast<std::size_t>(k)];
    return {i - 1, j - 1};
  }

  const Problem& problem_;
  Index n_;
  MatrixXd C_;
};

bool is_positive(const MatrixXd& A) {
  const Eigen::LLT<MatrixXd> factor(A);
  return factor.info() == Eigen::Success;
}

/// The part of the step D that may be taken from the positive definite A, at most 1: some less than
/// the way to the boundary, which is found by halving.
double longest_step(const MatrixXd& A, const MatrixXd& D) {
  if (is_positive(A + D / kOfTheWay)) return 1.0;
  double inside = 0.0;
  double outside = 1.0 / kOfTheWay;
  for (int halvings = 0; halvings < 8 || (inside == 0.0 && halvings < 30); ++halvings) {
    const double middle = 0.5 * (inside + outside);
    (is_positive(A + middle * D) ? inside : outside) = middle;
    if (outside - inside < 0.01 * inside) break;
  }
  return kOfTheWay * inside;
}

MatrixXd inverse_of_positive(const MatrixXd& A) {
  return A.llt().solve(MatrixXd::Identity(A.rows(), A.cols()));
}

double inner(const MatrixXd& A, const MatrixXd& B) { return A.cwiseProduct(B).sum(); }

struct Step {
  MatrixXd X;
  MatrixXd Z;
  VectorXd w;
};

class InteriorPoint {
 public:
  InteriorPoint(const Problem& problem, const MatrixXd& gram, const InteriorPointOptions& options)
      : reduced_(problem), options_(options) {
    start(gram);
  }

  /// Until the gap is at most `relative_gap` and the pairs fit.
  void run(double relative_gap) {
    for (; iterations_ < options_.max_iterations && !is_solved(relative_gap); ++iterations_)
      if (!advance()) break;
  }

  /// Coordinates in every direction where X is at least `floor`.
  Solution solution(double floor) const {
    Solution result;
    result.solver = SdpSolver::kInteriorPoint;
    result.iterations = iterations_;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> axes(X_);
    const Index n = reduced_.size();
    const Index rank = std::max<Index>(1, (axes.eigenvalues().array() > floor).count());
    result.Y.setZero(n + 1, rank);
    result.Y.bottomRows(n) = axes.eigenvectors().rightCols(rank) *
                             axes.eigenvalues().tail(rank).cwiseMax(0.0).cwiseSqrt().asDiagonal();
    result.w = w_;
    return result;
  }

  /// The eigenvalue that those of X and of Z approach, the product of which vanishes.
  double dividing_eigenvalue() const {
    return std::sqrt(product_ / static_cast<double>(reduced_.size()));
  }

 private:
  /// The data's own inner products, lifted into the interior, and equal weights that are feasible.
  void start(const MatrixXd& gram) {
    const Index n = reduced_.size();
    const VectorXd first = gram.col(0).tail(n);
    X_ = gram.bottomRightCorner(n, n);
    X_ -= first.replicate(1, n) + first.transpose().replicate(n, 1);
    X_.array() += gram(0, 0);
    X_.diagonal().array() += kLift * X_.diagonal().mean();

    const MatrixXd ones = reduced_.laplacian(VectorXd::Ones(reduced_.pairs()));
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> ratio(reduced_.C(), ones,
                                                                   Eigen::EigenvaluesOnly);
    w_.setConstant(reduced_.pairs(), 2.0 * ratio.eigenvalues()(n - 1));
    set_slack();
  }

  void set_slack() { Z_ = reduced_.laplacian(w_) - reduced_.C(); }

  bool is_solved(double relative_gap) {
    product_ = inner(X_, Z_);
    const VectorXd rest = reduced_.along_pairs(X_) - reduced_.squared();
    return product_ <= relative_gap * std::abs(w_.dot(reduced_.squared())) &&
           rest.cwiseAbs().maxCoeff() <= options_.constraint_residual;
  }

  /// The step to the centre of `mu`, less a correction of second order times Z^-1.
  Step step_to(double mu, const MatrixXd* correction) {
    MatrixXd target = mu * inverse_Z_;
    if (correction) target -= *correction;
    Step step;
    step.w = solve_cholesky(schur_, reduced_.along_pairs(target) - reduced_.squared());
    step.Z = reduced_.laplacian(step.w);
    const MatrixXd moved = target - X_ - X_ * step.Z * inverse_Z_;
    step.X = 0.5 * (moved + moved.transpose());
    return step;
  }

  bool advance() {
    inverse_Z_ = inverse_of_positive(Z_);
    reduced_.schur(X_, inverse_Z_, schur_);
    schur_.diagonal() *= 1.0 + 1e-14;
    if (!factor_cholesky(schur_)) return false;

    const double mu = product_ / static_cast<double>(reduced_.size());
    const Step guess = step_to(0.0, nullptr);
    const double ahead_X = longest_step(X_, guess.X);
    const double ahead_Z = longest_step(Z_, guess.Z);
    const double left = inner(X_ + ahead_X * guess.X, Z_ + ahead_Z * guess.Z) / product_;
    const double shortest = std::min(ahead_X, ahead_Z);
    const double power = std::max(1.0, 3.0 * shortest * shortest);
    const double sigma = std::min(1.0, left > 0.0 ? std::pow(left, power) : 0.3);

    const MatrixXd correction = guess.X * guess.Z * inverse_Z_;
    const Step step = step_to(sigma * mu, &correction);
    if (!step.X.allFinite() || !step.w.allFinite()) return false;
    const double length_X = longest_step(X_, step.X);
    const double length_Z = longest_step(Z_, step.Z);
    X_ += length_X * step.X;
    w_ += length_Z * step.w;
    set_slack();
    return std::max(length_X, length_Z) > 1e-7 && is_positive(Z_);
  }

  Reduced reduced_;
  InteriorPointOptions options_;
  MatrixXd X_;
  MatrixXd Z_;
  VectorXd w_;
  MatrixXd inverse_Z_;
  MatrixXd schur_;
  double product_ = 0.0;
  int iterations_ = 0;
};

/// Newton steps from where the interior point has shown the rank; empty if they do not converge.
/// For flat answers alone: those of flat data, whose feasible set has no interior, are the ones
/// that lack digits, and elsewhere the steps take more time than they bring.
std::optional<Solution> polished(const Problem& problem, Solution solution) {
  if (solution.Y.cols() > kMostPolishedRank) return std::nullopt;
  Rows Y = solution.Y;
  centre(problem, Y);
  double before = kkt_residuals(problem, Y, solution.w).sum();
  for (int steps = 0; steps < kMostPolishingSteps && before > kPolished; ++steps) {
    const auto step = kkt_newton_step(problem, Y, solution.w, 1.0);
    if (!step) return std::nullopt;
    Y += step->Y;
    solution.w += step->w;
    ++solution.iterations;
    const double after = kkt_residuals(problem, Y, solution.w).sum();
    if (!(after < 0.5 * before)) return std::nullopt;
    before = after;
  }
  if (before > kPolished) return std::nullopt;
  solution.Y = Y;
  return solution;
}

}  // namespace

ProvedSolution solve_by_interior_point(const Problem& problem, const MatrixXd& gram,
                                       const InteriorPointOptions& options) {
  InteriorPoint method(problem, gram, options);
  method.run(kGapToPolish);
  const auto candidate = polished(problem, method.solution(method.dividing_eigenvalue()));
  if (candidate) {
    const Certificate proof = certify(problem, *candidate);
    if (proof.relative_gap <= options.relative_gap &&
        proof.constraint_residual <= options.constraint_residual)
      return {.solution = *candidate, .certificate = proof};
  }
  method.run(options.relative_gap);
  Solution solution = method.solution(0.0);
  Rows Y = solution.Y;
  centre(problem, Y);
  solution.Y = Y;
  const Certificate proof = certify(problem, solution);
  return {.solution = std::move(solution), .certificate = proof};
}

}  // namespace mapproof::unfolding
