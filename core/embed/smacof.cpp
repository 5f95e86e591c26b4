#include "core/embed/smacof.hpp"

#include <cmath>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include "core/base/errors.hpp"
#include "core/linalg/planarity.hpp"

namespace mapproof {
namespace {

/// One majorisation problem: Z <- V^+ B(Z) Z lowers its stress, or keeps it.
class Majorization {
 public:
  Majorization(const Eigen::MatrixXd& distances, const Eigen::MatrixXd& weights)
      : distances_(distances), weights_(weights) {
    const Eigen::Index n = distances.rows();
    if (!weighted()) {
      scale_ = distances.squaredNorm() / 2.0;
      return;
    }
    scale_ = weights.cwiseProduct(distances.cwiseAbs2()).sum() / 2.0;
    // V is the weights' Laplacian; adding 11'/n makes it regular and changes no centred solution.
    Eigen::MatrixXd V = -weights;
    V.diagonal() = weights.rowwise().sum() - weights.diagonal();
    V.array() += 1.0 / static_cast<double>(n);
    inverse_.compute(V);
    if (inverse_.info() != Eigen::Success || inverse_.rcond() < 1e-14)
      throw InvalidInput("SMACOF's weights leave the landmarks in pieces");
  }

  /// The transform of Z; sets `stress` to that of Z before it.
  Points step(const Points& Z, double& stress) const {
    const Eigen::Index n = Z.rows();
    Points BZ = Points::Zero(n, 2);
    stress = 0.0;
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index i = j + 1; i < n; ++i) {
        const double weight = weighted() ? weights_(i, j) : 1.0;
        if (weight == 0.0) continue;
        const double dx = Z(i, 0) - Z(j, 0);
        const double dy = Z(i, 1) - Z(j, 1);
        const double distance = std::sqrt(dx * dx + dy * dy);
        const double residual = distances_(i, j) - distance;
        stress += weight * residual * residual;
        if (distance == 0.0) continue;
        const double ratio = weight * distances_(i, j) / distance;
        BZ(i, 0) += ratio * dx;
        BZ(i, 1) += ratio * dy;
        BZ(j, 0) -= ratio * dx;
        BZ(j, 1) -= ratio * dy;
      }
    if (weighted()) return inverse_.solve(BZ);
    return BZ / static_cast<double>(n);
  }

  double scale() const { return scale_; }

 private:
  bool weighted() const { return weights_.size() > 0; }

  const Eigen::MatrixXd& distances_;
  const Eigen::MatrixXd& weights_;
  Eigen::LDLT<Eigen::MatrixXd> inverse_;
  double scale_ = 0.0;
};

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
  const Majorization problem(distances, weights);
  Embedding result;
  result.coordinates = start;
  double before = 0.0;
  Points next = problem.step(start, before);
  bool settled = before <= 1e-28 * problem.scale();
  while (!settled && result.iterations < options.max_iterations) {
    ++result.iterations;
    double stress = 0.0;
    result.coordinates.swap(next);
    next = problem.step(result.coordinates, stress);
    settled =
        before - stress <= options.relative_fall * before || stress <= 1e-28 * problem.scale();
    before = stress;
  }
  result.stress = problem.scale() > 0.0 ? before / problem.scale() : 0.0;
  if (!settled)
    result.statuses.push_back(
        {StatusCode::kNotConverged,
         fmt::format("The stress still fell after {} iterations.", options.max_iterations)});
  if (planarity(result.coordinates) <= kFlatPlanarity)
    result.statuses.push_back({StatusCode::kRankDeficient,
                               "The map is flat: its landmarks lie on one line or in one place."});
  return result;
}

}  // namespace mapproof
