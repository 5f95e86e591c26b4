#include "core/embed/sde/definite.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/not_finite.hpp"
#include "core/linalg/cholesky.hpp"
#include "core/linalg/gram.hpp"

namespace mapproof::unfolding {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSharp = 0.005;  // Of an eigenvalue: the rest would not shorten a step.
constexpr int kStepsToJudge = 5;  // Between two looks at the result.
constexpr int kMostSteps = 60;
constexpr double kNoRest = 1e-12;  // The start's Krylov space is all there is.

/// A symmetric tridiagonal matrix.
struct Tridiagonal {
  std::vector<double> diagonal;
  std::vector<double> beside;  ///< One entry less, or as many: the last one is not part of it.

  /// Whether all eigenvalues are above x: whether the Cholesky factor's squares are positive.
  bool is_above(double x) const {
    double pivot = diagonal[0] - x;
    for (std::size_t i = 1; i < diagonal.size() && pivot > 0.0; ++i)
      pivot = diagonal[i] - x - beside[i - 1] * beside[i - 1] / pivot;
    return pivot > 0.0;
  }

  /// Just below the smallest eigenvalue, which is at most `above`.
  double smallest(double above) const {
    double step = kSharp * std::max(std::abs(above), 1.0);
    double below = above - step;
    while (!is_above(below)) {
      above = below;
      step *= 4.0;
      below -= step;
    }
    while (above - below > 0.1 * kSharp * std::max(std::abs(above), 1.0)) {
      const double middle = 0.5 * (above + below);
      (is_above(middle) ? below : above) = middle;
    }
    return below;
  }
};

}  // namespace

bool Definite::set(MatrixXd A) {
  MatrixXd L = A;
  if (!factor_cholesky(L)) return false;
  matrix_ = std::move(A);
  inverse_factor_ = inverse_of_lower(L);
  transposed_ = inverse_factor_.transpose();
  return true;
}

MatrixXd Definite::inverse() const { return gram(transposed_); }

VectorXd Definite::scaled(const MatrixXd& D, const VectorXd& v) const {
  VectorXd result(v.size());
  VectorXd between(v.size());
  multiply(transposed_, v, result);
  multiply(D, result, between);
  multiply(inverse_factor_, between, result);
  return result;
}

double smallest_eigenvalue(const Definite& A, const MatrixXd& D) {
  const Index n = D.rows();
  VectorXd v(n);
  for (Index i = 0; i < n; ++i) v(i) = 1.0 + std::fmod(0.618 * static_cast<double>(i), 1.0);
  v.normalize();
  VectorXd before = VectorXd::Zero(n);
  Tridiagonal T;
  double beside = 0.0;
  double smallest = kInfinity;
  for (int steps = 1;; ++steps) {
    VectorXd next = A.scaled(D, v);
    const double along = v.dot(next);
    next -= along * v + beside * before;
    beside = next.norm();
    T.diagonal.push_back(along);
    T.beside.push_back(beside);
    if (!(std::abs(along) + beside < kInfinity)) return -kInfinity;
    const bool is_whole = steps == n || beside <= kNoRest * std::abs(along);
    if (is_whole || steps % kStepsToJudge == 0) {
      const double last = smallest;
      smallest = T.smallest(std::min(last, *std::ranges::min_element(T.diagonal)));
      const double fall = last - smallest;
      if (is_whole) return smallest;
      if (fall < kSharp * std::max(std::abs(smallest), 1.0) || steps >= kMostSteps)
        return smallest - fall;
    }
    before = std::move(v);
    v = next / beside;
  }
}

}  // namespace mapproof::unfolding
