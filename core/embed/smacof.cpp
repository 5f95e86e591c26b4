#include "core/embed/smacof.hpp"

#include <cmath>
#include <vector>

#include <Eigen/SparseCholesky>

#include "core/base/errors.hpp"
#include "core/base/vectorised.hpp"
#include "core/linalg/planarity.hpp"

namespace mapproof {
namespace {

struct WeightedPair {
  Eigen::Index i;
  Eigen::Index j;
  double delta;  ///< The distance to be kept.
  double weight;
};

/// Adds one pair's term to B(Z) Z, and returns its term of the stress.
double add_pair(const Points& Z, const WeightedPair& pair, Points& BZ) {
  const auto& [i, j, delta, weight] = pair;
  const double dx = Z(i, 0) - Z(j, 0);
  const double dy = Z(i, 1) - Z(j, 1);
  const double distance = std::sqrt(dx * dx + dy * dy);
  const double residual = delta - distance;
  if (distance > 0.0) {
    const double ratio = weight * delta / distance;
    BZ(i, 0) += ratio * dx;
    BZ(i, 1) += ratio * dy;
    BZ(j, 0) -= ratio * dx;
    BZ(j, 1) -= ratio * dy;
  }
  return weight * residual * residual;
}

/// The terms of the pairs of one landmark with others, one value per pair.
struct PairBuffers {
  explicit PairBuffers(Eigen::Index n) : x(n), y(n), stress(n) {}

  Eigen::ArrayXd x;
  Eigen::ArrayXd y;
  Eigen::ArrayXd stress;
};

/// The partners of one landmark: `count` values each.
struct Partners {
  const double* x;
  const double* y;
  const double* delta;  ///< The distances to be kept.
  Eigen::Index count;
};

/// Without a sum, so that the compiler may vectorise it, with the same bits whatever the width of
/// the processor's vectors.
/// @param at  The landmark's position.
MAPPROOF_VECTORISED void pair_terms(const Eigen::RowVector2d& at, const Partners& partners,
                                    PairBuffers& out) {
  const double at_x = at.x();
  const double at_y = at.y();
  const auto [x, y, delta, count] = partners;
  double* __restrict out_x = out.x.data();
  double* __restrict out_y = out.y.data();
  double* __restrict out_stress = out.stress.data();
  for (Eigen::Index i = 0; i < count; ++i) {
    const double dx = at_x - x[i];
    const double dy = at_y - y[i];
    const double distance = std::sqrt(dx * dx + dy * dy);
    const double residual = delta[i] - distance;
    const double ratio = delta[i] / (distance > 0.0 ? distance : 1.0);  // dx = dy = 0 else
    out_x[i] = ratio * dx;
    out_y[i] = ratio * dy;
    out_stress[i] = residual * residual;
  }
}

/// One majorisation problem: Z <- V^+ B(Z) Z reduces its stress, or keeps it.
class EqualWeights {
 public:
  explicit EqualWeights(const Eigen::MatrixXd& distances)
      : distances_(distances), scale_(distances.squaredNorm() / 2.0) {}

  double scale() const { return scale_; }

  /// The transform of Z; sets `stress` to that of Z before it.
  Points step(const Points& Z, double& stress) const {
    const Eigen::Index n = Z.rows();
    Points BZ = Points::Zero(n, 2);
    PairBuffers pairs(n);
    stress = 0.0;
    for (Eigen::Index j = 0; j < n - 1; ++j) {
      const Eigen::Index count = n - 1 - j;
      pair_terms(Z.row(j),
                 {.x = Z.col(0).data() + j + 1,
                  .y = Z.col(1).data() + j + 1,
                  .delta = distances_.col(j).data() + j + 1,
                  .count = count},
                 pairs);
      stress += pairs.stress.head(count).sum();
      BZ(j, 0) += pairs.x.head(count).sum();
      BZ(j, 1) += pairs.y.head(count).sum();
      BZ.col(0).tail(count) -= pairs.x.head(count).matrix();
      BZ.col(1).tail(count) -= pairs.y.head(count).matrix();
    }
    return BZ / static_cast<double>(n);
  }

 private:
  const Eigen::MatrixXd& distances_;
  double scale_;
};

/// The same over the pairs that have a weight.
class SomeWeights {
 public:
  SomeWeights(const Eigen::MatrixXd& distances, const Eigen::MatrixXd& weights) {
    const Eigen::Index n = distances.rows();
    // V is the weights' Laplacian. Its solutions are defined up to translation: the last landmark
    // is the origin, which leaves a regular matrix of the others, as sparse as the weights.
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd degree = Eigen::VectorXd::Zero(n);
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index i = j + 1; i < n; ++i) {
        const double weight = weights(i, j);
        if (weight == 0.0) continue;
        pairs_.push_back({i, j, distances(i, j), weight});
        scale_ += weight * distances(i, j) * distances(i, j);
        degree(i) += weight;
        degree(j) += weight;
        if (i < n - 1) entries.emplace_back(i, j, -weight);
      }
    for (Eigen::Index i = 0; i < n - 1; ++i) entries.emplace_back(i, i, degree(i));
    Eigen::SparseMatrix<double> V(n - 1, n - 1);
    V.setFromTriplets(entries.begin(), entries.end());
    factor_.compute(V);
    const Eigen::VectorXd pivots = factor_.vectorD();
    if (factor_.info() != Eigen::Success || !(pivots.minCoeff() > 1e-12 * degree.maxCoeff()))
      throw InvalidInput("SMACOF's weights do not connect all landmarks");
  }

  double scale() const { return scale_; }

  Points step(const Points& Z, double& stress) const {
    const Eigen::Index n = Z.rows();
    Points BZ = Points::Zero(n, 2);
    stress = 0.0;
    for (const WeightedPair& pair : pairs_) stress += add_pair(Z, pair, BZ);
    Points next = Points::Zero(n, 2);
    next.topRows(n - 1) = factor_.solve(BZ.topRows(n - 1));
    return next.rowwise() - next.colwise().mean();
  }

 private:
  std::vector<WeightedPair> pairs_;
  double scale_ = 0.0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

/// Minimizes the stress from the start until it falls no more.
template <typename Problem>
Embedding minimized(const Problem& problem, const Points& start, const SmacofOptions& options) {
  Embedding result;
  result.coordinates = start;
  double before = 0.0;
  Points next = problem.step(start, before);
  bool converged = before <= 1e-28 * problem.scale();
  while (!converged && result.iterations < options.max_iterations) {
    ++result.iterations;
    double stress = 0.0;
    result.coordinates.swap(next);
    next = problem.step(result.coordinates, stress);
    converged =
        before - stress <= options.relative_fall * before || stress <= 1e-28 * problem.scale();
    before = stress;
  }
  result.stress = problem.scale() > 0.0 ? before / problem.scale() : 0.0;
  if (!converged)
    result.statuses.push_back(status_of<StatusReason::kStressFalling>(options.max_iterations));
  return result;
}

void check(const Eigen::MatrixXd& distances, const Eigen::MatrixXd& weights, const Points& start,
           const SmacofOptions& options) {
  const Eigen::Index n = distances.rows();
  if (distances.cols() != n || start.rows() != n ||
      (weights.size() > 0 && (weights.rows() != n || weights.cols() != n)))
    throw InvalidInput("SMACOF needs distances, weights and a start of one size");
  if (!distances.allFinite() || !start.allFinite())
    throw InvalidInput("SMACOF needs finite distances and a finite start");
  if (!weights.allFinite() || (weights.array() < 0.0).any())
    throw InvalidInput("SMACOF needs finite weights of 0 or more");
  if (options.max_iterations < 1) throw InvalidInput("SMACOF needs one iteration or more");
  if (!(options.relative_fall >= 0.0)) throw InvalidInput("SMACOF needs a relative fall >= 0");
}

}  // namespace

Embedding smacof(const Eigen::MatrixXd& distances, const Eigen::MatrixXd& weights,
                 const Points& start, const SmacofOptions& options) {
  check(distances, weights, start, options);
  Embedding result = weights.size() == 0
                         ? minimized(EqualWeights(distances), start, options)
                         : minimized(SomeWeights(distances, weights), start, options);
  if (planarity(result.coordinates) <= kFlatPlanarity)
    result.statuses.push_back(status_of<StatusReason::kFlatMap>());
  return result;
}

}  // namespace mapproof
