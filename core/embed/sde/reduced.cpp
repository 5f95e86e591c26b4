#include "core/embed/sde/reduced.hpp"

namespace mapproof::unfolding {

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
  VectorXd along(P.rows());
  for (Index k = 0; k < pairs(); ++k) {
    const auto [i, j] = ends(k);
    along = w(k) * P.col(j);
    if (i >= 0) {
      along -= w(k) * P.col(i);
      product.col(i) -= along;
    }
    product.col(j) += along;
  }
  return product;
}

void Reduced::schur(const MatrixXd& P, const MatrixXd& Q, MatrixXd& S) const {
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

}  // namespace mapproof::unfolding
