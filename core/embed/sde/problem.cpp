#include "core/embed/sde/problem.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/not_finite.hpp"
#include "core/graph/disjoint_sets.hpp"
#include "core/linalg/decompositions.hpp"

namespace mapproof::unfolding {
namespace {

constexpr double kSamePosition = 1e-14;

/// Numbers the positions of landmarks, from 0 in the order of their lowest landmark.
std::vector<Eigen::Index> positions(const Eigen::MatrixXd& distances,
                                    const std::vector<Pair>& pairs, double largest) {
  DisjointSets sets(static_cast<std::size_t>(distances.rows()));
  for (const auto& [a, b] : pairs) {
    const double ratio = distances(a, b) / largest;
    if (largest > 0.0 && ratio * ratio > kSamePosition) continue;
    const auto [low, high] = std::minmax(
        {sets.of(static_cast<std::size_t>(a)), sets.of(static_cast<std::size_t>(b))});
    sets.merge(high, low);  // The lowest landmark stands for its set.
  }
  std::vector<Eigen::Index> position(static_cast<std::size_t>(distances.rows()));
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const std::size_t root = sets.of(i);
    position[i] = root == i ? count++ : position[root];
  }
  return position;
}

}  // namespace

std::vector<Pair> kept_pairs(const NeighbourLists& nearest, const Graph& graph) {
  std::vector<Pair> pairs;
  const auto keep = [&](Eigen::Index a, Eigen::Index b) { pairs.emplace_back(std::minmax(a, b)); };
  for (std::size_t i = 0; i < nearest.size(); ++i)
    for (std::size_t a = 0; a < nearest[i].size(); ++a) {
      keep(static_cast<Eigen::Index>(i), nearest[i][a].to);
      for (std::size_t b = 0; b < a; ++b) keep(nearest[i][a].to, nearest[i][b].to);
    }
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (const Edge& edge : graph[i]) keep(static_cast<Eigen::Index>(i), edge.to);
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

Problem neighbourhood_problem(const Eigen::MatrixXd& distances, const NeighbourOptions& options,
                              const Graph& graph) {
  std::vector<Pair> landmarks = kept_pairs(nearest_neighbours(distances, options), graph);
  std::erase_if(landmarks, [&](const Pair& pair) {
    return !std::isfinite(distances(pair.first, pair.second));
  });
  double largest = 0.0;
  for (const auto& [a, b] : landmarks) largest = std::max(largest, distances(a, b));

  Problem problem;
  problem.scale = largest * largest;
  problem.point_of = positions(distances, landmarks, largest);
  problem.mass.setZero(1 + *std::ranges::max_element(problem.point_of));
  for (const Eigen::Index point : problem.point_of) problem.mass(point) += 1.0;

  std::vector<std::tuple<Pair, double>> constraints;
  for (const auto& [a, b] : landmarks) {
    const Pair ends = std::minmax(problem.point_of[static_cast<std::size_t>(a)],
                                  problem.point_of[static_cast<std::size_t>(b)]);
    const double ratio = distances(a, b) / largest;
    if (ends.first != ends.second) constraints.emplace_back(ends, ratio * ratio);
  }
  std::ranges::sort(constraints);
  std::vector<double> squared;
  for (std::size_t first = 0, last = 0; first < constraints.size(); first = last) {
    double sum = 0.0;
    for (; last < constraints.size() &&
           std::get<0>(constraints[last]) == std::get<0>(constraints[first]);
         ++last)
      sum += std::get<1>(constraints[last]);
    problem.pairs.push_back(std::get<0>(constraints[first]));
    squared.push_back(sum / static_cast<double>(last - first));
    problem.inconsistency = std::max(problem.inconsistency, std::get<1>(constraints[last - 1]) -
                                                                std::get<1>(constraints[first]));
  }
  problem.squared = Eigen::Map<Eigen::VectorXd>(squared.data(), std::ssize(squared));
  return problem;
}

Eigen::MatrixXd dual_matrix(const Problem& problem, const Eigen::VectorXd& w) {
  const Eigen::Index n = problem.points();
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t k = 0; k < problem.pairs.size(); ++k) {
    const auto& [i, j] = problem.pairs[k];
    const double weight = w(static_cast<Eigen::Index>(k));
    T(i, j) = T(j, i) = -weight;
    T(i, i) += weight;
    T(j, j) += weight;
  }
  const Eigen::VectorXd root = problem.mass.cwiseSqrt();
  T = root.cwiseInverse().asDiagonal() * T * root.cwiseInverse().asDiagonal();
  T.noalias() += (2.0 / problem.mass.sum()) * root * root.transpose();
  return T;
}

Certificate certify(const Problem& problem, const Solution& solution) {
  const Eigen::MatrixXd& Y = solution.Y;
  Certificate result{.solver = solution.solver};
  result.primal = problem.mass.dot(Y.rowwise().squaredNorm());
  for (std::size_t k = 0; k < problem.pairs.size(); ++k) {
    const auto& [i, j] = problem.pairs[k];
    const double kept = problem.squared(static_cast<Eigen::Index>(k));
    const double off = std::abs((Y.row(i) - Y.row(j)).squaredNorm() - kept);
    result.constraint_residual = std::max(result.constraint_residual, off);
  }
  result.constraint_residual += problem.inconsistency;
  // L(w) >= s J with s > 0 makes w / s feasible.
  const Eigen::MatrixXd T = dual_matrix(problem, solution.w);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(T, Eigen::EigenvaluesOnly);
  const double smallest = eigen.eigenvalues()(0);
  const double bound = solution.w.dot(problem.squared);
  result.dual = smallest > 0.0 ? bound / smallest : kInfinity;
  result.relative_gap = std::isfinite(result.dual)
                            ? std::abs(result.dual - result.primal) / std::abs(result.dual)
                            : result.dual;
  result.primal *= problem.scale;
  result.dual *= problem.scale;
  return result;
}

}  // namespace mapproof::unfolding
