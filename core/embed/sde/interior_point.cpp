#include "core/embed/sde/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/linalg/decompositions.hpp"
#include "core/linalg/gram.hpp"
#include "core/linalg/packed_product.hpp"

namespace mapproof::unfolding {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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

constexpr double kOfTheWay = 0.95;  // To the boundary.
constexpr double kGapToPolish = 1e-7;
/// The map has fewer digits than the variance: it stops at so much less gap than requested, where
/// that is cheap.
constexpr double kMoreDigits = 0.01;
constexpr Index kMostPairsForMoreDigits = 2500;
/// Elsewhere enough that the certificate, computed separately, still meets what was requested.
constexpr double kSomeDigits = 0.5;
constexpr Index kMostPolishedRank = 3;
constexpr int kMostPolishingSteps = 5;
constexpr double kPolished = 1e-9;
constexpr Index kPairsToCorrectAgain = 6;  // A point.
constexpr int kMostCorrections = 3;
constexpr int kHalvings = 6;
constexpr int kMostHalvings = 30;       // While no part of a step is feasible: a billionth.
constexpr double kSharp = 0.01;         // Of the boundary; the rest would not shorten the way.
constexpr double kTieBreak = 1e-14;     // Lifts a Schur complement that is singular by rounding.
constexpr double kUsualCentring = 0.3;  // Where the guess has no information.
constexpr double kStuck = 1e-7;         // A step as short as this makes no progress.
constexpr double kFirstLength = 0.5;    // As if a step of that length had come before.
constexpr double kLift = 0.1;           // Of a typical squared distance, into the interior.

bool is_positive(MatrixXd A) { return factor_cholesky(A); }

/// The part of the step D that may be taken from the positive definite A, at most 1: some less than
/// the way to the boundary, which is found by so many halvings (or more, if it is near).
double longest_step(const MatrixXd& A, const MatrixXd& D) {
  if (is_positive(A + D / kOfTheWay)) return 1.0;
  double inside = 0.0;
  double outside = 1.0 / kOfTheWay;
  for (int halvings = 0; halvings < kHalvings || (inside == 0.0 && halvings < kMostHalvings);
       ++halvings) {
    const double middle = 0.5 * (inside + outside);
    (is_positive(A + middle * D) ? inside : outside) = middle;
    if (outside - inside < kSharp * inside) break;
  }
  return kOfTheWay * inside;
}

/// A^-1 of a positive definite A; empty if it is not.
std::optional<MatrixXd> inverse_of_positive(MatrixXd A) {
  if (!factor_cholesky(A)) return std::nullopt;
  MatrixXd inverse = MatrixXd::Identity(A.rows(), A.cols());
  A.triangularView<Eigen::Lower>().solveInPlace(inverse);
  return gram(inverse.transpose());
}

/// A B of a symmetric B.
MatrixXd times_symmetric(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd product = MatrixXd::Zero(A.rows(), B.rows());
  add_product(A, B, 1.0, product);
  return product;
}

double inner(const MatrixXd& A, const MatrixXd& B) { return A.cwiseProduct(B).sum(); }

struct Step {
  MatrixXd X;
  MatrixXd Z;
  VectorXd w;
};

/// A step and the parts of it that stay inside.
struct Move {
  Step step;
  double length_X = 0.0;
  double length_Z = 0.0;

  double shortest() const { return std::min(length_X, length_Z); }
};

class InteriorPoint {
 public:
  InteriorPoint(const Problem& problem, const MatrixXd& gram, const InteriorPointOptions& options)
      : reduced_(problem), options_(options) {
    start(gram);
  }

  /// Gives its memory back; the next step makes it again.
  void forget_schur() { schur_.resize(0, 0); }

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
    const MatrixXd moved =
        target - X_ - times_symmetric(reduced_.times_laplacian(X_, step.w), inverse_Z_);
    step.X = 0.5 * (moved + moved.transpose());
    return step;
  }

  /// The step to the centre of `mu` with the second order of `guess`, as far as it may be taken.
  std::optional<Move> move_to(double mu, const Step& guess) {
    const MatrixXd correction =
        times_symmetric(reduced_.times_laplacian(guess.X, guess.w), inverse_Z_);
    Move move{.step = step_to(mu, &correction)};
    if (!move.step.X.allFinite() || !move.step.w.allFinite()) return std::nullopt;
    move.length_X = longest_step(X_, move.step.X);
    move.length_Z = longest_step(Z_, move.step.Z);
    return move;
  }

  /// The step corrected for its own second order, repeatedly as long as it gets no shorter. That
  /// saves one factor in four, and pays where the factor dominates the cost.
  std::optional<Move> corrected(double mu, const Step& guess) {
    auto move = move_to(mu, guess);
    if (reduced_.pairs() < kPairsToCorrectAgain * reduced_.size()) return move;
    for (int again = 0; move && again < kMostCorrections; ++again) {
      auto next = move_to(mu, move->step);
      if (!next || next->shortest() < move->shortest()) break;
      move = std::move(next);
    }
    return move;
  }

  bool advance() {
    const auto inverse = inverse_of_positive(Z_);
    if (!inverse) return false;
    inverse_Z_ = *inverse;
    reduced_.schur(X_, inverse_Z_, schur_);
    schur_.diagonal() *= 1.0 + kTieBreak;
    if (!factor_cholesky(schur_)) return false;

    const double mu = product_ / static_cast<double>(reduced_.size());
    const Step guess = step_to(0.0, nullptr);
    const double ahead_X = longest_step(X_, guess.X);
    const double ahead_Z = longest_step(Z_, guess.Z);
    const double left = inner(X_ + ahead_X * guess.X, Z_ + ahead_Z * guess.Z) / product_;
    // Where the last step was cut short the iterates are off the centre: then centre more.
    const double power = std::max(1.0, 3.0 * last_length_ * last_length_);  // Mehrotra's 3 at most.
    const double sigma = std::min(1.0, left > 0.0 ? std::pow(left, power) : kUsualCentring);

    const auto move = corrected(sigma * mu, guess);
    if (!move) return false;
    last_length_ = move->shortest();
    X_ += move->length_X * move->step.X;
    w_ += move->length_Z * move->step.w;
    set_slack();
    return std::max(move->length_X, move->length_Z) > kStuck;
  }

  Reduced reduced_;
  InteriorPointOptions options_;
  MatrixXd X_;
  MatrixXd Z_;
  VectorXd w_;
  MatrixXd inverse_Z_;
  MatrixXd schur_;
  double product_ = 0.0;
  double last_length_ = kFirstLength;
  int iterations_ = 0;
};

/// Newton steps from the rank that the interior point has found; empty if they do not converge. For
/// flat solutions alone: those of flat data, whose feasible set has no interior, lack digits;
/// elsewhere the steps cost more time than they save.
std::optional<Solution> polished(const Problem& problem, Solution solution) {
  if (solution.Y.cols() > kMostPolishedRank) return std::nullopt;
  Rows Y = solution.Y;
  centre(problem, Y);
  double before = kkt_residuals(problem, Y, solution.w).sum();
  for (int steps = 0; steps < kMostPolishingSteps && before > kPolished; ++steps) {
    const auto step = kkt_newton_step(problem, Y, solution.w);
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

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Reduced::Reduced(const Problem& problem) : problem_(problem), n_(problem.points() - 1) {
  const VectorXd mass = problem.mass.tail(n_);
  C_ = -mass * mass.transpose() / problem.mass.sum();
  C_.diagonal() += mass;
}

VectorXd Reduced::along_pairs(const MatrixXd& P) const {
  VectorXd result(pairs());
  for (Index k = 0; k < pairs(); ++k) {
    const auto [i, j] = ends(k);
    result(k) = P(j, j);
    if (i >= 0) result(k) += P(i, i) - P(i, j) - P(j, i);
  }
  return result;
}

MatrixXd Reduced::laplacian(const VectorXd& w) const {
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

MatrixXd Reduced::times_laplacian(const MatrixXd& P, const VectorXd& w) const {
  MatrixXd product = MatrixXd::Zero(P.rows(), n_);
  for (Index k = 0; k < pairs(); ++k) {
    const auto [i, j] = ends(k);
    if (i < 0) {
      product.col(j) += w(k) * P.col(j);
      continue;
    }
    product.col(i) -= w(k) * P.col(j) - w(k) * P.col(i);
    product.col(j) += w(k) * P.col(j) - w(k) * P.col(i);
  }
  return product;
}

void Reduced::schur(const MatrixXd& P, const MatrixXd& Q, MatrixXd& S) const {
  S.resize(pairs(), pairs());
  // Both products of a point next to each other; the origin's are zero.
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

CertifiedSolution solve_by_interior_point(const Problem& problem, const MatrixXd& gram,
                                          const InteriorPointOptions& requested) {
  const double part = problem.squared.size() <= kMostPairsForMoreDigits ? kMoreDigits : kSomeDigits;
  InteriorPointOptions options = requested;
  options.relative_gap *= part;
  options.constraint_residual *= part;
  InteriorPoint method(problem, gram, options);
  method.run(kGapToPolish);
  method.forget_schur();  // Refining makes a matrix of that size.
  const auto candidate = polished(problem, method.solution(method.dividing_eigenvalue()));
  if (candidate) {
    const Certificate certificate = certify(problem, *candidate);
    if (certificate.relative_gap <= options.relative_gap &&
        certificate.constraint_residual <= options.constraint_residual)
      return {.solution = *candidate, .certificate = certificate};
  }
  method.run(options.relative_gap);
  Solution solution = method.solution(0.0);
  Rows Y = solution.Y;
  centre(problem, Y);
  solution.Y = Y;
  const Certificate certificate = certify(problem, solution);
  return {.solution = std::move(solution), .certificate = certificate};
}

}  // namespace mapproof::unfolding
