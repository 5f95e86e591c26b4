#include "core/embed/lle.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/embed/bottom_eigenmap.hpp"
#include "core/linalg/centering.hpp"
#include "core/linalg/decompositions.hpp"

namespace mapproof {
namespace {

/// A second eigenvalue up to this share of the first is rounding: no tangent plane.
constexpr double kFlatNeighbourhood = 1e-12;
/// A column is dependent on those before it if this share of it is left.
constexpr double kDependent = 1e-8;

/// The directions that x^2, xy, y^2 add to 1, x, y, orthonormal; zero where they add none.
Eigen::MatrixX3d hessian_directions(const Eigen::MatrixX2d& tangent) {
  const Eigen::Index k = tangent.rows();
  Eigen::Matrix<double, Eigen::Dynamic, 6> Y(k, 6);
  Y.col(0).setConstant(1.0 / std::sqrt(static_cast<double>(k)));
  Y.middleCols<2>(1) = tangent;  // orthonormal, and orthogonal to the constant
  Y.col(3) = tangent.col(0).cwiseAbs2();
  Y.col(4) = tangent.col(0).cwiseProduct(tangent.col(1));
  Y.col(5) = tangent.col(1).cwiseAbs2();
  for (Eigen::Index c = 3; c < 6; ++c) {
    const double before = Y.col(c).norm();
    for (int pass = 0; pass < 2; ++pass)  // twice is enough
      Y.col(c) -= (Y.leftCols(c) * (Y.leftCols(c).transpose() * Y.col(c))).eval();
    const double left = Y.col(c).norm();
    if (left > kDependent * before)
      Y.col(c) /= left;
    else
      Y.col(c).setZero();
  }
  return Y.rightCols<3>();
}

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

SquaredDistance entries_of(const Eigen::MatrixXd& squared_distances) {
  return [&](Eigen::Index i, Eigen::Index j) { return squared_distances(i, j); };
}

}  // namespace

void check_neighbourhoods(const Eigen::MatrixXd& squared_distances,
                          const NeighbourLists& neighbours, int fewest) {
  const Eigen::Index n = squared_distances.rows();
  if (n < 3 || squared_distances.cols() != n || std::ssize(neighbours) != n)
    throw InvalidInput("need a square matrix of at least 3 landmarks, and neighbours of each");
  if (!squared_distances.allFinite()) throw InvalidInput("need finite distances");
  for (const std::vector<Edge>& edges : neighbours) {
    if (std::ssize(edges) < fewest)
      throw InvalidInput(fmt::format("need {} neighbours of each landmark", fewest));
    for (const Edge& edge : edges)
      if (edge.to < 0 || edge.to >= n) throw InvalidInput("a neighbour is not a landmark");
  }
}

void gram_about(const SquaredDistance& squared, Eigen::Index i, const std::vector<Edge>& edges,
                Eigen::MatrixXd& gram) {
  const Eigen::Index k = std::ssize(edges);
  gram.resize(k, k);
  for (Eigen::Index a = 0; a < k; ++a)
    gram(a, a) = squared(edges[static_cast<std::size_t>(a)].to, i);
  for (Eigen::Index b = 0; b < k; ++b) {
    const Eigen::Index to = edges[static_cast<std::size_t>(b)].to;
    for (Eigen::Index a = b + 1; a < k; ++a) {
      const double between = squared(edges[static_cast<std::size_t>(a)].to, to);
      gram(a, b) = gram(b, a) = std::isfinite(between)
                                    ? 0.5 * (gram(a, a) + gram(b, b) - between)
                                    : -std::sqrt(gram(a, a) * gram(b, b));
    }
  }
}

void QuadraticForms::add(const std::vector<Eigen::Index>& support,
                         const Eigen::MatrixXd& coefficients) {
  for (Eigen::Index b = 0; b < coefficients.rows(); ++b)
    for (Eigen::Index a = 0; a < coefficients.rows(); ++a)
      entries_.emplace_back(support[static_cast<std::size_t>(a)],
                            support[static_cast<std::size_t>(b)],
                            coefficients.row(a).dot(coefficients.row(b)));
}

Eigen::SparseMatrix<double> QuadraticForms::matrix() const {
  Eigen::SparseMatrix<double> matrix(n_, n_);
  matrix.setFromTriplets(entries_.begin(), entries_.end());
  return matrix;
}

Embedding hessian_lle(const Eigen::MatrixXd& squared_distances, const NeighbourLists& neighbours) {
  check_neighbourhoods(squared_distances, neighbours, kFewestHessianNeighbours);
  const Eigen::Index n = squared_distances.rows();
  QuadraticForms H(n);
  Eigen::Index flat = 0;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  Eigen::MatrixXd G;
  std::vector<Eigen::Index> support;
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::vector<Edge>& edges = neighbours[static_cast<std::size_t>(i)];
    gram_about(entries_of(squared_distances), i, edges, G);
    solver.compute(centered(G));
    const Eigen::Index k = G.rows();
    if (solver.eigenvalues()(k - 2) <= kFlatNeighbourhood * solver.eigenvalues()(k - 1)) ++flat;
    support.clear();
    for (const Edge& edge : edges) support.push_back(edge.to);
    H.add(support, hessian_directions(solver.eigenvectors().rightCols<2>()));
  }
  Embedding result =
      bottom_eigenmap(H.matrix(), Eigen::VectorXd::Constant(n, 1.0 / std::sqrt(double(n))));
  if (flat > 0) result.statuses.push_back(status_of<StatusReason::kNoTangentPlane>(flat, n));
  return result;
}

BlendForm blend_form(const SquaredDistance& squared, const NeighbourLists& neighbours,
                     const LleOptions& options) {
  if (!(options.regularization > 0.0)) throw InvalidInput("LLE needs a regularization above 0");
  // M = (I - W)'(I - W), a landmark's row of I - W at a time.
  BlendForm result;
  QuadraticForms M(std::ssize(neighbours));
  Eigen::MatrixXd G;
  Eigen::LLT<Eigen::MatrixXd> factor;
  Eigen::VectorXd weights;
  std::vector<Eigen::Index> support;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    gram_about(squared, static_cast<Eigen::Index>(i), neighbours[i], G);
    const double trace = G.trace();
    if (trace > 0.0) G /= trace;
    result.are_all_flat =
        result.are_all_flat && (trace == 0.0 || 1.0 - G.squaredNorm() <= kFlatGram);
    if (!blend(G, options.regularization, factor, weights)) ++result.not_euclidean;

    support.assign(1, static_cast<Eigen::Index>(i));
    for (const Edge& edge : neighbours[i]) support.push_back(edge.to);
    Eigen::VectorXd row(1 + weights.size());
    row << 1.0, -weights;
    M.add(support, row);
  }
  result.matrix = M.matrix();
  return result;
}

Embedding lle(const Eigen::MatrixXd& squared_distances, const NeighbourLists& neighbours,
              const LleOptions& options) {
  check_neighbourhoods(squared_distances, neighbours, 1);
  const Eigen::Index n = squared_distances.rows();
  const BlendForm form = blend_form(entries_of(squared_distances), neighbours, options);
  Embedding result =
      bottom_eigenmap(form.matrix, Eigen::VectorXd::Constant(n, 1.0 / std::sqrt(double(n))));
  if (form.are_all_flat)
    result.statuses.push_back(status_of<StatusReason::kNeighbourhoodsFlat>());
  if (form.not_euclidean > 0)
    result.statuses.push_back(
        status_of<StatusReason::kNeighbourhoodsNotEuclidean>(form.not_euclidean, n));
  return result;
}

}  // namespace mapproof
