#include "core/embed/landmark_mvu.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/SparseCholesky>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/embed/landmark_isomap.hpp"
#include "core/embed/sde/problem.hpp"
#include "core/linalg/cholesky.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/packed_product.hpp"
#include "core/linalg/sign.hpp"
#include "core/linalg/symmetric_eigen.hpp"

namespace mapproof {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Distances up to this share of the largest are none.
constexpr double kSamePosition = 1e-7;

/// The references that do not coincide with others.
std::vector<Index> distinct_references(const Graph& graph, Index count) {
  const References all = farthest_references(graph, std::min<Index>(count, std::ssize(graph)));
  const double largest = all.lengths.maxCoeff();
  if (!std::isfinite(largest)) throw InvalidInput("landmark MVU needs a graph in one piece");
  std::vector<Index> nodes;
  for (std::size_t k = 0; k < all.nodes.size(); ++k) {
    const auto before = all.lengths.row(all.nodes[k]).head(static_cast<Index>(k));
    if (k == 0 || before.minCoeff() > kSamePosition * largest) nodes.push_back(all.nodes[k]);
  }
  return nodes;
}

/// Q, n x l: y = Q y_l has the least error |(I - W) y| among the y that have the rows y_l of the
/// references [weinberger2005].
MatrixXd reconstruction(const Eigen::SparseMatrix<double>& form,
                        const std::vector<Index>& references) {
  const Index n = form.rows(), l = std::ssize(references);
  std::vector<Index> reference_of(static_cast<std::size_t>(n), -1),
      other_of(static_cast<std::size_t>(n), -1);
  for (Index k = 0; k < l; ++k)
    reference_of[static_cast<std::size_t>(references[static_cast<std::size_t>(k)])] = k;
  std::vector<Index> others;
  for (Index i = 0; i < n; ++i)
    if (reference_of[static_cast<std::size_t>(i)] < 0) {
      other_of[static_cast<std::size_t>(i)] = std::ssize(others);
      others.push_back(i);
    }
  MatrixXd Q = MatrixXd::Zero(n, l);
  for (Index k = 0; k < l; ++k) Q(references[static_cast<std::size_t>(k)], k) = 1.0;
  if (others.empty()) return Q;

  std::vector<Eigen::Triplet<double>> entries;
  MatrixXd right = MatrixXd::Zero(std::ssize(others), l);
  for (Index j = 0; j < n; ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(form, j); entry; ++entry) {
      const Index row = other_of[static_cast<std::size_t>(entry.row())];
      if (row < 0) continue;
      if (const Index column = other_of[static_cast<std::size_t>(j)]; column >= 0)
        entries.emplace_back(row, column, entry.value());
      else
        right(row, reference_of[static_cast<std::size_t>(j)]) -= entry.value();
    }
  Eigen::SparseMatrix<double> among(std::ssize(others), std::ssize(others));
  among.setFromTriplets(entries.begin(), entries.end());
  entries = {};
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(among);
  MatrixXd solved;
  if (factor.info() == Eigen::Success) solved = factor.solve(right);
  if (factor.info() != Eigen::Success || !solved.allFinite()) {
    // Weights that leave a landmark open, but for rounding: the least of what they leave.
    factor.setShift(1e-9 * among.diagonal().maxCoeff());
    factor.factorize(among);
    solved = factor.solve(right);
  }
  for (Index i = 0; i < std::ssize(others); ++i)
    Q.row(others[static_cast<std::size_t>(i)]) = solved.row(i);
  // The weights sum to one, and so do these, but for rounding.
  return Q.array().colwise() / Q.array().rowwise().sum();
}

/// The program over the references without the translation of the map, of which L does not depend:
///
///   max <A, X>  s.t.  c_k' X c_k <= 1,  X psd;     min sum w  s.t.  sum w_k c_k c_k' - A psd,
///                                                                   w >= 0,
///
/// where L = U X U', the columns of U are orthonormal and orthogonal to (1, ..., 1), and c_k is
/// (U'Q_i - U'Q_j) / d_ij for a pair k of landmarks i, j.
struct ReferenceProgram {
  MatrixXd rows;  ///< Q U less its mean: n x r.
  MatrixXd A;     ///< r x r.
  std::vector<unfolding::Pair> pairs;
  VectorXd lengths;  ///< Of each pair, > 0, the largest 1.

  Index size() const { return A.rows(); }
  Eigen::RowVectorXd constraint(std::size_t k) const {
    return (rows.row(pairs[k].first) - rows.row(pairs[k].second)) / lengths(static_cast<Index>(k));
  }
  /// c_k' X c_k of all pairs for X = F F'.
  VectorXd stretches(const MatrixXd& F) const {
    const MatrixXd points = rows * F;
    VectorXd result(lengths.size());
    for (std::size_t k = 0; k < pairs.size(); ++k)
      result(static_cast<Index>(k)) =
          (points.row(pairs[k].first) - points.row(pairs[k].second)).squaredNorm() /
          std::pow(lengths(static_cast<Index>(k)), 2);
    return result;
  }
};

/// An orthonormal basis of the vectors of l numbers that sum to zero (Helmert's).
MatrixXd basis_of_differences(Index l) {
  MatrixXd U = MatrixXd::Zero(l, l - 1);
  for (Index k = 1; k < l; ++k) {
    const double length = std::sqrt(static_cast<double>(k * (k + 1)));
    U.col(k - 1).head(k).setConstant(1.0 / length);
    U(k, k - 1) = -static_cast<double>(k) / length;
  }
  return U;
}

/// X and w of a program with some of its pairs, strictly feasible.
struct Solved {
  MatrixXd X;
  VectorXd w;
};

/// Solves the program with the constraints C, a row each, by a primal-dual interior point with
/// predictor and corrector steps [helmberg1996]. Every iterate is feasible for both programs.
/// @param C  p x r, of rank r.
class BoundedUnfolding {
 public:
  BoundedUnfolding(const MatrixXd& A, MatrixXd C) : A_(A), C_(std::move(C)) {}

  Solved solve(double relative_gap);

 private:
  struct Step {
    VectorXd w, s;
    MatrixXd X, Z;
  };

  bool begin();
  double gap() const { return s_.dot(w_) + X_.matrix().cwiseProduct(Z_.matrix()).sum(); }
  bool factor();
  Step step(double mu, const Step* before) const;
  VectorXd along(const MatrixXd& P) const { return C_.cwiseProduct(C_ * P).rowwise().sum(); }

  const MatrixXd& A_;
  MatrixXd C_;
  Definite X_, Z_;
  VectorXd w_, s_;
  MatrixXd inverse_;  ///< Of Z.
  MatrixXd schur_;    ///< Its Cholesky factor.
};

bool BoundedUnfolding::begin() {
  const Index p = C_.rows(), r = C_.cols();
  // w = t (1, ..., 1) with t twice what makes t C'C - A positive semidefinite.
  Definite scatter;
  if (!scatter.set(C_.transpose() * C_)) return false;
  const double largest = -smallest_eigenvalue(scatter, -A_);
  w_ = VectorXd::Constant(p, 2.0 * std::max(largest, 1e-300));
  const double longest = C_.rowwise().squaredNorm().maxCoeff();
  s_ = VectorXd::Ones(p) - C_.rowwise().squaredNorm() / (2.0 * longest);
  return X_.set(MatrixXd::Identity(r, r) / (2.0 * longest)) &&
         Z_.set(w_(0) * scatter.matrix() - A_);
}

/// (c_k'X c_l)(c_k'Z^-1 c_l), and s / w on the diagonal. By the factors of X and Z: their products
/// are positive semidefinite whatever their rounding.
bool BoundedUnfolding::factor() {
  MatrixXd x_factor = X_.matrix(), z_factor = Z_.matrix();
  if (!factor_cholesky(x_factor) || !factor_cholesky(z_factor)) return false;
  x_factor.triangularView<Eigen::StrictlyUpper>().setZero();
  z_factor = inverse_of_lower(z_factor);
  inverse_ = z_factor.transpose() * z_factor;
  const Index p = C_.rows();
  schur_.setZero(p, p);
  MatrixXd other = schur_;
  add_gram(C_ * x_factor, 1.0, schur_);
  add_gram(C_ * z_factor.transpose(), 1.0, other);
  schur_.array() *= other.array();
  schur_.diagonal().array() += s_.array() / w_.array();
  return factor_cholesky(schur_);
}

/// The Newton step to X Z = mu, s w = mu. @param before  Whose products of second order count; null:
/// none.
BoundedUnfolding::Step BoundedUnfolding::step(double mu, const Step* before) const {
  VectorXd right = mu * (along(inverse_).array() + w_.array().inverse()) - 1.0;
  MatrixXd second;
  VectorXd second_s = VectorXd::Zero(w_.size());
  if (before != nullptr) {
    second = before->X * before->Z * inverse_;
    second = (0.5 * (second + second.transpose())).eval();
    second_s = before->s.cwiseProduct(before->w).cwiseQuotient(w_);
    right -= along(second) + second_s;
  }
  Step result;
  result.w = solve_cholesky(schur_, right);
  result.Z = C_.transpose() * result.w.asDiagonal() * C_;
  const MatrixXd product = X_.matrix() * result.Z * inverse_;
  result.X = mu * inverse_ - X_.matrix() - 0.5 * (product + product.transpose());
  if (before != nullptr) result.X -= second;
  result.s = -along(result.X);
  return result;
}

/// How far v + t d stays above zero, up to 1.
double positive_step(const VectorXd& v, const VectorXd& d) {
  const double fall = -(d.array() / v.array()).minCoeff();
  return fall > 0.0 ? std::min(1.0, 1.0 / fall) : 1.0;
}

double definite_step(const Definite& V, const MatrixXd& D) {
  const double fall = -smallest_eigenvalue(V, D);
  return fall > 0.0 ? std::min(1.0, 1.0 / fall) : 1.0;
}

Solved BoundedUnfolding::solve(double relative_gap) {
  constexpr int kMostSteps = 60;
  constexpr double kToBoundary = 0.95;
  if (!begin()) return {};
  const auto count = static_cast<double>(C_.rows() + C_.cols());
  for (int k = 0; k < kMostSteps && gap() > relative_gap * w_.sum(); ++k) {
    if (!factor()) break;
    const double mu = gap() / count;
    const Step affine = step(0.0, nullptr);
    const double primal = std::min(positive_step(s_, affine.s), definite_step(X_, affine.X));
    const double dual = std::min(positive_step(w_, affine.w), definite_step(Z_, affine.Z));
    const double left =
        (s_ + primal * affine.s).dot(w_ + dual * affine.w) +
        (X_.matrix() + primal * affine.X).cwiseProduct(Z_.matrix() + dual * affine.Z).sum();
    const double sigma = std::pow(std::clamp(left / gap(), 0.0, 1.0), 3.0);
    const Step both = step(sigma * mu, &affine);
    const double a =
        kToBoundary * std::min(positive_step(s_, both.s), definite_step(X_, both.X));
    const double b =
        kToBoundary * std::min(positive_step(w_, both.w), definite_step(Z_, both.Z));
    const VectorXd w = w_ + b * both.w;
    const MatrixXd X = X_.matrix() + a * both.X;
    const VectorXd s = VectorXd::Ones(w.size()) - along(X);
    if (!(s.minCoeff() > 0.0) || !X_.set(X) ||
        !Z_.set(C_.transpose() * w.asDiagonal() * C_ - A_))
      break;
    w_ = w;
    s_ = s;
  }
  return {X_.matrix(), w_};
}

/// Rows of C that span its columns, the longest of what is left of them first; none if they do not.
std::vector<std::size_t> spanning_rows(const ReferenceProgram& program) {
  MatrixXd C(program.size(), std::ssize(program.pairs));
  for (std::size_t k = 0; k < program.pairs.size(); ++k)
    C.col(static_cast<Index>(k)) = program.constraint(k);
  VectorXd left = C.colwise().squaredNorm();
  std::vector<std::size_t> chosen;
  MatrixXd basis(program.size(), program.size());
  for (Index r = 0; r < program.size(); ++r) {
    Index longest = 0;
    if (!(left.maxCoeff(&longest) > 0.0)) return {};
    VectorXd direction = C.col(longest);
    for (int pass = 0; pass < 2; ++pass)
      direction -= basis.leftCols(r) * (basis.leftCols(r).transpose() * direction);
    basis.col(r) = direction.normalized();
    chosen.push_back(static_cast<std::size_t>(longest));
    left -= (basis.col(r).transpose() * C).cwiseAbs2().transpose();
    left(longest) = 0.0;
  }
  return chosen;
}

/// A solution for all pairs.
struct Unfolded {
  MatrixXd points;  ///< n x r, centred.
  double primal = 0.0, dual = 0.0;
  int programs = 0;
};

/// Solves program after program, each with the pairs that the one before left too far apart; those
/// that do not press are left out again [weinberger2005]. The last one, shrunk until no
/// pair is too far apart, is feasible; the weights of each bound all.
Unfolded unfold(const ReferenceProgram& program, double relative_gap) {
  constexpr int kMostPrograms = 60;
  // What the pairs that are not yet in leave open is found as well by a rough solution.
  constexpr double kRoughest = 1e-3, kOfOuterGap = 1e-2;
  std::vector<std::size_t> active = spanning_rows(program);
  const std::size_t spanning = active.size();
  Unfolded best;
  best.dual = kInfinity;
  double inner = kRoughest, outer = kInfinity;
  for (int round = 0; round < kMostPrograms && spanning > 0; ++round) {
    MatrixXd C(std::ssize(active), program.size());
    for (std::size_t k = 0; k < active.size(); ++k)
      C.row(static_cast<Index>(k)) = program.constraint(active[k]);
    const Solved solved = BoundedUnfolding(program.A, C).solve(inner);
    if (solved.w.size() == 0) break;
    ++best.programs;
    best.dual = std::min(best.dual, solved.w.sum());
    const EigenPairs axes = largest_eigenpairs(solved.X, program.size());
    const MatrixXd F = axes.vectors * axes.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
    const VectorXd stretches = program.stretches(F);
    const double most = stretches.maxCoeff();
    if (const double primal = program.A.cwiseProduct(solved.X).sum() / most;
        primal > best.primal) {
      best.primal = primal;
      best.points = program.rows * (F / std::sqrt(most));
    }
    const double before = outer;
    outer = (best.dual - best.primal) / best.dual;
    if (outer <= relative_gap) break;
    inner = std::clamp(kOfOuterGap * outer, kOfOuterGap * relative_gap, kRoughest);

    // Those that press, and the worst of the others.
    std::vector<std::size_t> kept;
    const double pressing = 1e-6 * solved.w.maxCoeff();
    for (std::size_t k = 0; k < active.size(); ++k)
      if (k < spanning || solved.w(static_cast<Index>(k)) > pressing) kept.push_back(active[k]);
    std::vector<std::size_t> worst;
    for (std::size_t k = 0; k < program.pairs.size(); ++k)
      if (stretches(static_cast<Index>(k)) > 1.0 + kOfOuterGap * relative_gap) worst.push_back(k);
    if (worst.empty() && outer > 0.999 * before) break;  // As near as rounding lets it come.
    const std::size_t added =
        std::min(worst.size(), std::max<std::size_t>(2 * spanning, kept.size() / 2));
    std::ranges::partial_sort(worst, worst.begin() + static_cast<std::ptrdiff_t>(added),
                              std::greater(), [&](std::size_t k) {
                                return stretches(static_cast<Index>(k));
                              });
    for (std::size_t k = 0; k < added; ++k)
      if (std::ranges::find(kept, worst[k]) == kept.end()) kept.push_back(worst[k]);
    active = std::move(kept);
  }
  return best;
}

/// The distances of some pairs, of histories whose distances are no array.
class PairDistances {
 public:
  /// @param pairs  Ascending, the first of a pair the lower.
  PairDistances(const HistoryDistances& histories, std::vector<unfolding::Pair> pairs)
      : pairs_(std::move(pairs)), lengths_(pairs_.size(), histories.distances.others) {
    begins_.assign(static_cast<std::size_t>(histories.landmarks) + 1, 0);
    for (const unfolding::Pair& pair : pairs_) ++begins_[static_cast<std::size_t>(pair.first) + 1];
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    histories.distances.visit([&](Index i, std::span<const Edge> others) {
      for (const Edge& edge : others)
        if (const std::optional<std::size_t> k = find(i, edge.to)) lengths_[*k] = edge.length;
    });
  }

  double operator()(Index i, Index j) const {
    const auto k = find(std::min(i, j), std::max(i, j));
    return k ? lengths_[*k] : kInfinity;
  }

 private:
  std::optional<std::size_t> find(Index i, Index j) const {
    const auto key = static_cast<std::size_t>(i);
    const auto first = pairs_.begin() + static_cast<std::ptrdiff_t>(begins_[key]);
    const auto last = pairs_.begin() + static_cast<std::ptrdiff_t>(begins_[key + 1]);
    const auto found = std::ranges::lower_bound(first, last, j, {}, &unfolding::Pair::second);
    if (found == last || found->second != j) return std::nullopt;
    return static_cast<std::size_t>(found - pairs_.begin());
  }

  std::vector<unfolding::Pair> pairs_;
  std::vector<double> lengths_;
  std::vector<std::size_t> begins_;  ///< Of the pairs of each first landmark.
};

}  // namespace

PairDistance neighbourhood_distances(const HistoryDistances& histories, const Graph& graph) {
  return [found = std::make_shared<PairDistances>(
              histories, unfolding::kept_pairs(graph, graph))](Index i, Index j) {
    return (*found)(i, j);
  };
}

Embedding landmark_mvu(const Graph& graph, const NeighbourLists& nearest,
                       const PairDistance& distance,
                       const LandmarkMvuOptions& options) {
  const Index n = std::ssize(graph);
  if (n < 3 || std::ssize(nearest) != n)
    throw InvalidInput("landmark MVU needs 3 landmarks or more");
  if (options.references < 3)
    throw InvalidInput("landmark MVU needs 3 reference landmarks or more");
  if (!(options.relative_gap > 0.0 && options.relative_gap < 1.0))
    throw InvalidInput("landmark MVU needs a gap between 0 and 1");

  ReferenceProgram program;
  std::vector<double> lengths;
  for (const unfolding::Pair& pair : unfolding::kept_pairs(nearest, graph)) {
    const double length = distance(pair.first, pair.second);
    if (!std::isfinite(length)) continue;
    program.pairs.push_back(pair);
    lengths.push_back(length);
  }
  const double scale = *std::ranges::max_element(lengths);
  Embedding result;
  result.coordinates.setZero(n, 2);
  const std::vector<Index> references = distinct_references(graph, options.references);
  if (!(scale > 0.0) || references.size() < 2) {
    result.spectrum.setZero(1);
    result.statuses.push_back(status_of<StatusReason::kUnfoldedFlat>(0));
    return result;
  }
  // Landmarks at one position are blended alike.
  for (std::size_t k = 0, to = 0; k <= lengths.size(); ++k) {
    if (k == lengths.size()) {
      lengths.resize(to);
      program.pairs.resize(to);
      break;
    }
    if (lengths[k] <= kSamePosition * scale) continue;
    lengths[to] = lengths[k] / scale;
    program.pairs[to++] = program.pairs[k];
  }
  program.lengths = Eigen::Map<const VectorXd>(lengths.data(), std::ssize(lengths));

  const BlendForm form = blend_form(
      [&](Index i, Index j) { return std::pow(i == j ? 0.0 : distance(i, j), 2); }, graph,
      options.weights);
  const auto l = static_cast<Index>(references.size());
  program.rows = reconstruction(form.matrix, references) * basis_of_differences(l);
  program.rows.rowwise() -= program.rows.colwise().mean().eval();
  program.A = program.rows.transpose() * program.rows;

  const Unfolded unfolded = unfold(program, options.relative_gap);
  const double square = scale * scale;
  result.iterations = unfolded.programs;
  const double gap = std::isfinite(unfolded.dual)
                         ? std::abs(unfolded.dual - unfolded.primal) / unfolded.dual
                         : kInfinity;
  result.certificate = Certificate{.solver = SdpSolver::kInteriorPoint,
                                   .primal = square * unfolded.primal,
                                   .dual = square * unfolded.dual,
                                   .relative_gap = gap,
                                   .constraint_residual = 0.0};
  Index spread = 0;
  result.spectrum.setZero(1);
  if (const MatrixXd& points = unfolded.points; points.size() > 0) {
    // Y Y' has the eigenvalues of the smaller Y' Y.
    const EigenPairs axes =
        largest_eigenpairs(points.transpose() * points, std::min<Index>(points.cols(), 10));
    result.spectrum = square * axes.values.cwiseMax(0.0);
    for (; spread < std::min<Index>(axes.values.size(), 2) &&
           axes.values(spread) > options.relative_gap * axes.values(0);
         ++spread)
      result.coordinates.col(spread) = scale * points * axes.vectors.col(spread);
    fix_signs(result.coordinates);
  }
  if (spread < 2) result.statuses.push_back(status_of<StatusReason::kUnfoldedFlat>(spread));
  if (!std::isfinite(unfolded.dual))
    result.statuses.push_back(status_of<StatusReason::kNoBound>(0.0));
  else if (gap > options.relative_gap)
    result.statuses.push_back(status_of<StatusReason::kLooseBound>(100.0 * gap, 0.0));
  return result;
}

}  // namespace mapproof
