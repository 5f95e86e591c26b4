#include "core/pairs/pair_solution.hpp"

#include <algorithm>
#include <cmath>

#include "core/embed/isomap.hpp"
#include "core/graph/components.hpp"
#include "core/pairs/pair_graph.hpp"
#include "core/pairs/triangles.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {
namespace {

constexpr double kLeastResidual = 0.1;  ///< In units of what the precisions promise.
/// Weights that differ more than this allows would leave the landmarks in pieces.
constexpr double kLeastWeight = 1e-5;  ///< Of that of a pair that fits.
/// Of the pairs that starts after the first are made of.
constexpr int kFewestScansOfStarts[] = {7, 14, 28, 56, 112};

/// Shares of the weights left by how far each pair is from the map [geman1985].
std::vector<double> shares(const std::vector<double>& residuals, double tolerance) {
  const double usual = usual_residual(residuals);
  std::vector<double> result;
  for (const double residual : residuals) {
    const double off = residual / (tolerance * usual);
    result.push_back(std::max(kLeastWeight, 1.0 / std::pow(1.0 + off * off, 2)));
  }
  return result;
}

void weigh(PairProblem& problem, const std::vector<double>& left) {
  for (std::size_t k = 0; k < left.size(); ++k) {
    const MeasuredPair& pair = problem.pairs[k];
    problem.weights(pair.first, pair.second) = problem.weights(pair.second, pair.first) =
        pair.precision * left[k];
  }
}

/// The graph without pairs that triangles speak against, if it is in one piece without them.
Graph starting_graph(const std::vector<MeasuredPair>& pairs, const std::vector<double>& left,
                     std::size_t landmarks) {
  std::vector<MeasuredPair> good;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (left[k] == 1.0) good.push_back(pairs[k]);
  Graph graph = graph_of(good, landmarks);
  return std::ranges::max(components(graph)) == 0 ? graph : graph_of(pairs, landmarks);
}

double width_in(Width width, int round) {
  if (width == Width::kNarrow) return 1.0;
  constexpr double kWidest = 8.0;
  constexpr double kNarrowest = 0.7;
  return std::max(kNarrowest, kWidest * std::pow(0.5, 0.5 * round));
}

}  // namespace

std::vector<double> residuals(const PairProblem& problem, const Points& map) {
  std::vector<double> result;
  for (const MeasuredPair& pair : problem.pairs)
    result.push_back(
        std::abs(pair.distance_m - (map.row(pair.first) - map.row(pair.second)).norm()) *
        std::sqrt(pair.precision));
  return result;
}

double usual_residual(const std::vector<double>& residuals) {
  // A normal's standard deviation is 1.4826 times the median of what lies off it.
  return std::max(kLeastResidual, 1.4826 * median(residuals));
}

PairSolution lowered(PairProblem& problem, const Points& start, std::vector<double> left,
                     Width width, const PairMapOptions& options) {
  weigh(problem, left);
  Embedding map = smacof(problem.distances, problem.weights, start, options.smacof);
  for (int round = 0; round < options.reweightings; ++round) {
    left = shares(residuals(problem, map.coordinates), width_in(width, round) * options.tolerance);
    weigh(problem, left);
    const int before = map.iterations;
    map = smacof(problem.distances, problem.weights, map.coordinates, options.smacof);
    map.iterations += before;
  }
  std::vector<double> off = residuals(problem, map.coordinates);
  return {std::move(map), std::move(left), std::move(off), width};
}

PairSolution lowered_widely(PairProblem& problem, const Points& start,
                            const PairMapOptions& options) {
  std::vector<double> left =
      shares(residuals(problem, start), width_in(Width::kWide, 0) * options.tolerance);
  return lowered(problem, start, std::move(left), Width::kWide, options);
}

PairSolution polished(PairProblem& problem, const PairSolution& rough,
                      const PairMapOptions& options) {
  constexpr int kRounds = 2;
  PairSolution fine = rough;
  for (int round = 0; round < kRounds; ++round) {
    weigh(problem, fine.left);
    const int before = fine.map.iterations;
    fine.map = smacof(problem.distances, problem.weights, fine.map.coordinates, options.smacof);
    fine.map.iterations += before;
    fine.residuals = residuals(problem, fine.map.coordinates);
    if (round + 1 < kRounds)
      fine.left =
          shares(fine.residuals, width_in(rough.width, options.reweightings) * options.tolerance);
  }
  return fine;
}

std::vector<double> shares_by_triangles(const PairProblem& problem) {
  std::vector<double> left;
  for (const bool is_against : against_triangles(problem.pairs, problem.distances.rows()))
    left.push_back(is_against ? kLeastWeight : 1.0);
  return left;
}

std::vector<std::vector<double>> first_shares(const PairProblem& problem) {
  const auto n = static_cast<std::size_t>(problem.distances.rows());
  std::vector<std::vector<double>> starts = {shares_by_triangles(problem)};
  for (const int fewest : kFewestScansOfStarts) {
    const std::vector<bool> is_taken = are_trusted(problem.pairs, n, fewest);
    std::vector<double> left = starts.front();
    std::vector<MeasuredPair> pairs;
    for (std::size_t k = 0; k < left.size(); ++k) {
      if (!is_taken[k]) left[k] = kLeastWeight;
      if (is_taken[k]) pairs.push_back(problem.pairs[k]);
    }
    if (std::ranges::max(components(graph_of(pairs, n))) > 0) break;
    if (left != starts.back()) starts.push_back(std::move(left));
  }
  return starts;
}

std::vector<double> without_gross(const PairProblem& problem, const Points& map,
                                  std::vector<double> left, double tolerance) {
  const std::vector<double> off = residuals(problem, map);
  const double gross = kGross * tolerance * usual_residual(off);
  for (std::size_t k = 0; k < left.size(); ++k)
    if (off[k] > gross) left[k] = kLeastWeight;
  return left;
}

Embedding path_map(const PairProblem& problem, const std::vector<double>& left) {
  const auto n = static_cast<std::size_t>(problem.distances.rows());
  return isomap(starting_graph(problem.pairs, left, n));
}

}  // namespace mapproof
