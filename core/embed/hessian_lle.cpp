#include "core/embed/hessian_lle.hpp"

#include <cmath>
#include <vector>

#include "core/embed/bottom_eigenmap.hpp"
#include "core/embed/local_gram.hpp"
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

}  // namespace

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
    gram_about(squared_distances, i, edges, G);
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

}  // namespace mapproof
