#include "core/embed/sde/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/vectorised.hpp"
#include "core/linalg/cholesky.hpp"
#include "core/linalg/decompositions.hpp"
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
// Where the last step was almost whole. Of 50 points that saves one step in ten; of 200 or more it
// takes more steps.
constexpr double kFurther = 0.99;
constexpr double kAlmostWhole = 0.9;
constexpr Index kFewPoints = 100;
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
constexpr double kTieBreak = 1e-14;      // Lifts a Schur complement that is singular by rounding;
constexpr double kMostTieBreak = 1e-11;  // up to here, tenfold at a time, if there is no factor.
constexpr double kUsualCentring = 0.3;   // Where the guess has no information.
constexpr double kStuck = 1e-7;          // A step as short as this makes no progress,
constexpr double kLeastFall = 0.995;     // nor one that leaves so much of a gap whose pairs fit.
constexpr double kFirstLength = 0.5;     // As if a step of that length had come before.
constexpr double kLift = 0.1;            // Of a typical squared distance, into the interior.
constexpr double kStartWeight = 2.0;     // Of the least that is feasible.
// Many points need a start further inside: at 500, 23 iterations instead of 39. Up to 300 that
// start takes one or two more.
constexpr Index kManyPoints = 400;
constexpr double kLiftOfMany = 3.0;
constexpr double kStartWeightOfMany = 10.0;
constexpr double kShorter = 0.8;      // A step that left the interior by rounding.
constexpr int kMostShortenings = 30;  // A thousandth.

/// The part of the step D that may be taken from A, at most 1: a part of the way to the boundary.
double longest_step(const Definite& A, const MatrixXd& D, double part) {
  const double smallest = smallest_eigenvalue(A, D);
  return smallest > -part ? 1.0 : part / -smallest;
}

/// A B of a symmetric B.
MatrixXd times_symmetric(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd product = MatrixXd::Zero(A.rows(), B.rows());
  add_product(A, B, 1.0, product);
  return product;
}

constexpr Index kPairsTogether = 256;  // Their differences fit the second cache.

/// Two vectors whose difference is meant.
struct Difference {
  const double* from;
  const double* less;
};

MAPPROOF_VECTORISED_WIDE void multiply_differences(const Difference& p, const Difference& q,
                                                   double* out, Index count) {
  const double* const p_from = p.from;
  const double* const p_less = p.less;
  const double* const q_from = q.from;
  const double* const q_less = q.less;
  for (Index k = 0; k < count; ++k) out[k] = (p_from[k] - p_less[k]) * (q_from[k] - q_less[k]);
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
    if (!is_inside_) return;
    for (; iterations_ < options_.max_iterations && !is_solved(relative_gap); ++iterations_)
      if (!advance()) break;
  }

  /// Coordinates in every direction where X is at least `floor`.
  Solution solution(double floor) const {
    Solution result;
    result.solver = SdpSolver::kInteriorPoint;
    result.iterations = iterations_;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> axes(X_.matrix());
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
    MatrixXd X = gram.bottomRightCorner(n, n);
    X -= first.replicate(1, n) + first.transpose().replicate(n, 1);
    X.array() += gram(0, 0);
    const double typical = X.diagonal().mean();
    const bool are_many = n > kManyPoints;
    const double first_lift = are_many ? kLiftOfMany : kLift;
    X.diagonal().array() += first_lift * typical;
    // Distances that no points have may leave eigenvalues further below zero.
    for (double lift = first_lift; !X_.set(X) && std::isfinite(lift); lift *= 2.0)
      X.diagonal().array() += lift * typical;

    Definite ones;
    is_inside_ = ones.set(reduced_.laplacian(VectorXd::Ones(reduced_.pairs())));
    if (!is_inside_) return;
    w_.setConstant(reduced_.pairs(), -(are_many ? kStartWeightOfMany : kStartWeight) *
                                         smallest_eigenvalue(ones, -reduced_.C()));
    is_inside_ = X_.is_set() && Z_.set(slack());
  }

  MatrixXd slack() const { return reduced_.laplacian(w_) - reduced_.C(); }

  bool pairs_fit() const {
    const VectorXd rest = reduced_.along_pairs(X_.matrix()) - reduced_.squared();
    return rest.cwiseAbs().maxCoeff() <= options_.constraint_residual;
  }

  bool is_solved(double relative_gap) {
    product_ = inner(X_.matrix(), Z_.matrix());
    return product_ <= relative_gap * std::abs(w_.dot(reduced_.squared())) && pairs_fit();
  }

  /// The factor of the matrix of the pairs.
  bool factor_pairs() {
    for (double lift = kTieBreak; lift <= kMostTieBreak; lift *= 10.0) {
      reduced_.schur(X_.matrix(), inverse_Z_, schur_);
      schur_.diagonal() *= 1.0 + lift;
      if (factor_cholesky(schur_)) return true;
    }
    return false;
  }

  /// The step to the centre of `mu`, less a correction of second order times Z^-1.
  Step step_to(double mu, const MatrixXd* correction) {
    MatrixXd target = mu * inverse_Z_;
    if (correction) target -= *correction;
    Step step;
    step.w = solve_cholesky(schur_, reduced_.along_pairs(target) - reduced_.squared());
    step.Z = reduced_.laplacian(step.w);
    const MatrixXd moved =
        target - X_.matrix() - times_symmetric(times_symmetric(X_.matrix(), step.Z), inverse_Z_);
    step.X = 0.5 * (moved + moved.transpose());
    return step;
  }

  /// The step to the centre of `mu` with the second order of `guess`, as far as it may be taken.
  std::optional<Move> move_to(double mu, const Step& guess) {
    const MatrixXd correction = times_symmetric(times_symmetric(guess.X, guess.Z), inverse_Z_);
    Move move{.step = step_to(mu, &correction)};
    if (!move.step.X.allFinite() || !move.step.w.allFinite()) return std::nullopt;
    move.length_X = longest_step(X_, move.step.X, part());
    move.length_Z = longest_step(Z_, move.step.Z, part());
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

  /// How much of the way to the boundary a step may go: nearly all of it where the iterates follow
  /// the centre.
  double part() const {
    const bool goes_further = reduced_.size() <= kFewPoints && last_length_ > kAlmostWhole;
    return goes_further ? kFurther : kOfTheWay;
  }

  bool advance() {
    inverse_Z_ = Z_.inverse();
    if (!factor_pairs()) return false;

    const double mu = product_ / static_cast<double>(reduced_.size());
    const Step guess = step_to(0.0, nullptr);
    const double ahead_X = longest_step(X_, guess.X, part());
    const double ahead_Z = longest_step(Z_, guess.Z, part());
    const double left =
        inner(X_.matrix() + ahead_X * guess.X, Z_.matrix() + ahead_Z * guess.Z) / product_;
    // Where the last step was cut short the iterates are off the centre: then centre more.
    const double power = std::max(1.0, 3.0 * last_length_ * last_length_);  // Mehrotra's 3 at most.
    const double sigma = std::min(1.0, left > 0.0 ? std::pow(left, power) : kUsualCentring);

    auto move = corrected(sigma * mu, guess);
    if (!move || !take(*move)) return false;
    last_length_ = move->shortest();
    if (std::max(move->length_X, move->length_Z) <= kStuck) return false;
    return inner(X_.matrix(), Z_.matrix()) <= kLeastFall * product_ || !pairs_fit();
  }

  /// False if rounding keeps all of a step from being taken. Shortens the steps that are not
  /// inside.
  bool take(Move& move) {
    int shortenings = 0;
    while (!X_.set(X_.matrix() + move.length_X * move.step.X)) {
      if (++shortenings > kMostShortenings) return false;
      move.length_X *= kShorter;
    }
    const VectorXd w = w_;
    for (w_ += move.length_Z * move.step.w; !Z_.set(slack());
         w_ = w + move.length_Z * move.step.w) {
      if (++shortenings > kMostShortenings) return false;
      move.length_Z *= kShorter;
    }
    return true;
  }

  Reduced reduced_;
  InteriorPointOptions options_;
  Definite X_;
  Definite Z_;
  bool is_inside_ = false;
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

/// Rows of the symmetric P, as differences of the ends of some pairs: one column for each point, 0
/// for the origin.
void Reduced::differences(const MatrixXd& P, Index first, Index count, MatrixXd& out) const {
  if (out.rows() < count || out.cols() != n_ + 1) out.resize(count, n_ + 1);
  out.col(0).setZero();
  for (Index i = 0; i < n_; ++i) {
    const double* const column = P.col(i).data();
    double* const to = out.col(i + 1).data();
    for (Index k = 0; k < count; ++k) {
      const auto [a, b] = ends(first + k);
      to[k] = column[b] - (a < 0 ? 0.0 : column[a]);
    }
  }
}

void Reduced::schur(const MatrixXd& P, const MatrixXd& Q, MatrixXd& S) {
  S.resize(pairs(), pairs());
  for (Index first = 0; first < pairs(); first += kPairsTogether) {
    const Index count = std::min(kPairsTogether, pairs() - first);
    differences(P, first, count, p_);
    differences(Q, first, count, q_);
    for (Index l = 0; l < first + count; ++l) {
      const auto& [i, j] = problem_.pairs[static_cast<std::size_t>(l)];
      const Index above = std::max<Index>(0, l - first);
      multiply_differences({p_.col(i).data() + above, p_.col(j).data() + above},
                           {q_.col(i).data() + above, q_.col(j).data() + above},
                           S.col(l).data() + first + above, count - above);
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
  method.run(std::max(kGapToPolish, options.relative_gap));
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
