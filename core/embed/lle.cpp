#include "core/embed/lle.hpp"

#include <cmath>
#include <vector>

#include "core/base/errors.hpp"
#include "core/embed/bottom_eigenmap.hpp"
#include "core/embed/local_gram.hpp"
#include "core/linalg/decompositions.hpp"

namespace mapproof {
namespace {

/// Below this share of the squared trace the local Gram matrix has rank one.
constexpr double kFlatGram = 1e-12;

/// The nearest matrix that inner products of points can be, with trace 1: negative eigenvalues cut.
Eigen::MatrixXd without_negative_part(const Eigen::MatrixXd& G) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(G);
  const Eigen::VectorXd values = solver.eigenvalues().cwiseMax(0.0);
  const Eigen::MatrixXd& vectors = solver.eigenvectors();
  const double trace = values.sum();
  if (trace <= 0.0) return Eigen::MatrixXd::Zero(G.rows(), G.cols());
  return vectors * (values / trace).asDiagonal() * vectors.transpose();
}

/// Weights that sum to one and blend a landmark from its neighbours best.
/// @param G  Inner products of the neighbours about the landmark, trace 1 or 0; overwritten.
/// @return False if no points have such inner products; their nearest are taken.
bool blend(Eigen::MatrixXd& G, double regularization, Eigen::LLT<Eigen::MatrixXd>& factor,
           Eigen::VectorXd& weights) {
  G.diagonal().array() += regularization;
  factor.compute(G);
  const bool euclidean = factor.info() == Eigen::Success;
  if (!euclidean) {
    G.diagonal().array() -= regularization;
    G = without_negative_part(G);
    G.diagonal().array() += regularization;
    factor.compute(G);
  }
  weights = factor.solve(Eigen::VectorXd(Eigen::VectorXd::Ones(G.rows())));
  weights /= weights.sum();
  return euclidean;
}

}  // namespace

Embedding lle(const Eigen::MatrixXd& squared_distances, const NeighbourLists& neighbours,
              const LleOptions& options) {
  check_neighbourhoods(squared_distances, neighbours, 1);
  if (!(options.regularization > 0.0)) throw InvalidInput("LLE needs a regularization above 0");

  // M = (I - W)'(I - W), a landmark's row of I - W at a time.
  const Eigen::Index n = squared_distances.rows();
  QuadraticForms M(n);
  bool all_flat = true;
  int not_euclidean = 0;
  Eigen::MatrixXd G;
  Eigen::LLT<Eigen::MatrixXd> factor;
  Eigen::VectorXd weights;
  std::vector<Eigen::Index> support;
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::vector<Edge>& edges = neighbours[static_cast<std::size_t>(i)];
    gram_about(squared_distances, i, edges, G);
    const double trace = G.trace();
    if (trace > 0.0) G /= trace;
    all_flat = all_flat && (trace == 0.0 || 1.0 - G.squaredNorm() <= kFlatGram);
    if (!blend(G, options.regularization, factor, weights)) ++not_euclidean;

    support.assign(1, i);
    for (const Edge& edge : edges) support.push_back(edge.to);
    Eigen::VectorXd row(1 + weights.size());
    row << 1.0, -weights;
    M.add(support, row);
  }
  Embedding result =
      bottom_eigenmap(M.matrix(), Eigen::VectorXd::Constant(n, 1.0 / std::sqrt(double(n))));
  if (all_flat) result.statuses.push_back(status_of<StatusReason::kNeighbourhoodsFlat>());
  if (not_euclidean > 0)
    result.statuses.push_back(
        status_of<StatusReason::kNeighbourhoodsNotEuclidean>(not_euclidean, n));
  return result;
}

}  // namespace mapproof
