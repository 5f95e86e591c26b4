#include "core/embed/lle.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "core/base/errors.hpp"
#include "core/embed/bottom_eigenmap.hpp"
#include "core/embed/local_gram.hpp"

namespace mapproof {
namespace {

/// Below this share of the squared trace the local Gram matrix has rank one.
constexpr double kFlat = 1e-12;

/// Weights that sum to one and blend a landmark from its neighbours best.
/// @param G  Inner products of the neighbours about the landmark, trace 1 or 0; overwritten.
void blend(Eigen::MatrixXd& G, double regularization, Eigen::LLT<Eigen::MatrixXd>& factor,
           Eigen::VectorXd& weights) {
  G.diagonal().array() += regularization;
  factor.compute(G);
  weights = factor.solve(Eigen::VectorXd::Ones(G.rows()));
  weights /= weights.sum();
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
  Eigen::MatrixXd G;
  Eigen::LLT<Eigen::MatrixXd> factor;
  Eigen::VectorXd weights;
  std::vector<Eigen::Index> support;
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::vector<Edge>& edges = neighbours[static_cast<std::size_t>(i)];
    gram_about(squared_distances, i, edges, G);
    const double trace = G.trace();
    if (trace > 0.0) G /= trace;
    all_flat = all_flat && (trace == 0.0 || 1.0 - G.squaredNorm() <= kFlat);
    blend(G, options.regularization, factor, weights);

    support.assign(1, i);
    for (const Edge& edge : edges) support.push_back(edge.to);
    Eigen::VectorXd row(1 + weights.size());
    row << 1.0, -weights;
    M.add(support, row);
  }
  Embedding result =
      bottom_eigenmap(M.matrix(), Eigen::VectorXd::Constant(n, 1.0 / std::sqrt(double(n))));
  if (all_flat)
    result.statuses.push_back(
        {StatusCode::kRankDeficient,
         "In every neighbourhood the observations spread in one direction alone."});
  return result;
}

}  // namespace mapproof
