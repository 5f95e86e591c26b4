#include "core/mixed/mixed_distances.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/linalg/centering.hpp"

namespace mapproof {
namespace {

/// The squared distances from some steps of a history.
Eigen::MatrixXd squared_from(const ObservationHistory& history, Eigen::Index first,
                             Eigen::Index count) {
  ObservationHistory part{.sensor = history.sensor, .names = history.names, .values = {}};
  part.values = history.values.middleCols(first, count);
  Eigen::MatrixXd D = proximities(part, count).squared_distances;
  for (const Eigen::Index row : unseen_landmarks(part, count)) {
    D.row(row).setConstant(kInfinity);
    D.col(row).setConstant(kInfinity);
  }
  return D;
}

/// Over the pairs that both have; 0 if either does not vary.
double correlation(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  double n = 0, a = 0, b = 0, aa = 0, ab = 0, bb = 0;
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Eigen::Index i = j + 1; i < A.rows(); ++i) {
      if (!std::isfinite(A(i, j)) || !std::isfinite(B(i, j))) continue;
      n += 1.0, a += A(i, j), b += B(i, j);
      aa += A(i, j) * A(i, j), ab += A(i, j) * B(i, j), bb += B(i, j) * B(i, j);
    }
  const double va = aa - a * a / n, vb = bb - b * b / n;
  if (!(va > 1e-14 * aa && vb > 1e-14 * bb)) return 0.0;
  return (ab - a * b / n) / std::sqrt(va * vb);
}

double mean_of_pairs(const Eigen::MatrixXd& squared) {
  double sum = 0.0, count = 0.0;
  for (Eigen::Index j = 0; j < squared.cols(); ++j)
    for (Eigen::Index i = j + 1; i < squared.rows(); ++i)
      if (std::isfinite(squared(i, j))) {
        sum += squared(i, j);
        count += 1.0;
      }
  return sum > 0.0 ? sum / count : 1.0;
}

}  // namespace

double reliability(const ObservationHistory& history, Eigen::Index steps) {
  require_steps(history, steps);
  if (steps < 4) return 0.0;
  const Eigen::Index half = steps / 2;
  const double r = correlation(squared_from(history, 0, half), squared_from(history, half, half));
  return r > 0.0 ? std::min(2.0 * r / (1.0 + r), 1.0 - 1e-9) : 0.0;
}

Proximities mixed_proximities(const std::vector<Eigen::MatrixXd>& squared,
                              const std::vector<double>& weights) {
  if (squared.empty() || squared.size() != weights.size())
    throw InvalidInput("mixed distances need sensors, and one weight per sensor");
  const Eigen::Index M = squared.front().rows();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(M, M);
  Eigen::MatrixXd total = Eigen::MatrixXd::Zero(M, M);
  for (std::size_t s = 0; s < squared.size(); ++s) {
    if (squared[s].rows() != M || squared[s].cols() != M)
      throw InvalidInput("mixed distances need the same landmarks of all sensors");
    if (!(weights[s] >= 0.0) || !std::isfinite(weights[s]))
      throw InvalidInput("mixed distances need weights of 0 or more");
    const Eigen::ArrayXXd known = squared[s].array().isFinite().cast<double>() * weights[s];
    sum.array() +=
        (known > 0.0).select(known * squared[s].array() / mean_of_pairs(squared[s]), 0.0);
    total.array() += known;
  }
  if (!(total.maxCoeff() > 0.0)) throw InvalidInput("mixed distances need a weight above 0");
  Proximities result;
  result.squared_distances = (total.array() > 0.0).select(sum.array() / total.array(), kInfinity);
  result.squared_distances.diagonal().setZero();
  result.inner_products = Eigen::MatrixXd::Zero(M, M);
  if (result.squared_distances.allFinite())
    result.inner_products = double_centered(result.squared_distances);
  return result;
}

std::vector<double> weights_of(const std::vector<double>& reliabilities) {
  std::vector<double> weights;
  double sum = 0.0;
  for (const double r : reliabilities) {
    weights.push_back(r / (1.0 - r));
    sum += weights.back();
  }
  for (double& weight : weights)
    weight = sum > 0.0 ? weight / sum : 1.0 / static_cast<double>(weights.size());
  return weights;
}

}  // namespace mapproof
