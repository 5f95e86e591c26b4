#include "core/pairs/pair_map.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/graph/components.hpp"
#include "core/pairs/orientation.hpp"
#include "core/pairs/pair_graph.hpp"
#include "core/pairs/pair_solution.hpp"

namespace mapproof {
namespace {

constexpr double kLeastPrecision = 1e-3;  ///< Of the greatest.

void check(const std::vector<MeasuredPair>& pairs, std::size_t landmarks,
           const PairMapOptions& options) {
  std::set<std::pair<Eigen::Index, Eigen::Index>> known;
  for (const MeasuredPair& pair : pairs) {
    if (pair.first < 0 || pair.first >= pair.second ||
        pair.second >= static_cast<Eigen::Index>(landmarks) ||
        !known.emplace(pair.first, pair.second).second)
      throw InvalidInput(
          "measured pairs must name two landmarks in ascending order, each pair once");
    if (!(pair.distance_m >= 0.0 && std::isfinite(pair.distance_m)) ||
        !(pair.precision > 0.0 && std::isfinite(pair.precision)))
      throw InvalidInput("measured pairs need finite distances >= 0 and precisions > 0");
  }
  if (options.start && options.start->rows() != static_cast<Eigen::Index>(landmarks))
    throw InvalidInput("the initial map needs one row per landmark");
  if (options.fewest_scans < 1 || options.reweightings < 0 || !(options.tolerance > 0.0))
    throw InvalidInput("a map of pairs needs fewest_scans >= 1, reweightings >= 0, tolerance > 0");
}

std::vector<MeasuredPair> trusted(const std::vector<MeasuredPair>& pairs, std::size_t landmarks,
                                  int fewest_scans) {
  const std::vector<bool> is_taken = are_trusted(pairs, landmarks, fewest_scans);
  std::vector<MeasuredPair> taken;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (is_taken[k]) taken.push_back(pairs[k]);
  return taken;
}

/// What the pairs do not determine, by landmark.
std::vector<Status> separate_groups(const Graph& graph, const std::vector<Eigen::Index>& group,
                                    const std::vector<std::string>& names) {
  std::vector<std::string> alone;
  std::vector<std::string> elsewhere;
  std::vector<std::string> loose;
  const auto enough = std::min<std::ptrdiff_t>(kPairsToPlace, std::ssize(group) - 1);
  for (std::size_t i = 0; i < graph.size(); ++i) {
    const bool is_mapped = std::ranges::binary_search(group, static_cast<Eigen::Index>(i));
    if (graph[i].empty())
      alone.push_back(names[i]);
    else if (!is_mapped)
      elsewhere.push_back(names[i]);
    else if (std::ssize(graph[i]) < enough)
      loose.push_back(names[i]);
  }
  std::vector<Status> statuses;
  const auto add = [&](Status status) {
    if (!status.names.empty()) statuses.push_back(std::move(status));
  };
  add(status_of<StatusReason::kNeverMeasuredTogether>(std::move(alone)));
  add(status_of<StatusReason::kNotWithTheMapped>(std::move(elsewhere), group.size()));
  add(status_of<StatusReason::kFewPairs>(std::move(loose)));
  return statuses;
}

PairProblem problem_of(const std::vector<MeasuredPair>& pairs,
                       const std::vector<Eigen::Index>& group) {
  const Eigen::Index n = std::ssize(group);
  PairProblem problem{.distances = Eigen::MatrixXd::Zero(n, n),
                      .weights = Eigen::MatrixXd::Zero(n, n),
                      .pairs = {}};
  const auto row = [&](Eigen::Index landmark) {
    return std::ranges::lower_bound(group, landmark) - group.begin();
  };
  double greatest = 0.0;
  for (MeasuredPair pair : pairs) {
    if (!std::ranges::binary_search(group, pair.first)) continue;
    pair.first = row(pair.first);
    pair.second = row(pair.second);
    greatest = std::max(greatest, pair.precision);
    problem.pairs.push_back(pair);
  }
  for (MeasuredPair& pair : problem.pairs) {
    pair.precision = std::max(pair.precision, kLeastPrecision * greatest);
    problem.distances(pair.first, pair.second) = problem.distances(pair.second, pair.first) =
        pair.distance_m;
  }
  return problem;
}

/// The orientations of triples of the group alone, in its rows.
std::vector<SeenOrientation> turns_of(const std::vector<SeenOrientation>& turns,
                                      const std::vector<Eigen::Index>& group) {
  std::vector<SeenOrientation> result;
  for (SeenOrientation one : turns) {
    const auto is_in = [&](int& landmark) {
      const auto row = std::ranges::lower_bound(group, landmark);
      const bool found = row != group.end() && *row == landmark;
      landmark = static_cast<int>(row - group.begin());
      return found;
    };
    if (is_in(one.first) && is_in(one.second) && is_in(one.third)) result.push_back(one);
  }
  return result;
}

/// The map of the group's rows; its pairs' precisions become the final ones.
/// @param start  Of the group; empty: none.
Embedding solve(PairProblem& problem, const Points& start,
                const std::vector<SeenOrientation>& turns, const PairMapOptions& options) {
  if (!options.refined) return path_map(problem, shares_by_triangles(problem));
  PairSolution best = start.rows() > 0 && start.allFinite()
                          ? minimized(problem, start,
                                      without_gross(problem, start, shares_by_triangles(problem),
                                                    options.tolerance),
                                      Width::kNarrow, options)
                          : searched(problem, turns, options);
  for (std::size_t k = 0; k < best.left.size(); ++k) problem.pairs[k].precision *= best.left[k];
  return best.map;
}

}  // namespace

PairMap pair_map(const std::vector<MeasuredPair>& pairs, const std::vector<std::string>& names,
                 const PairMapOptions& options, const std::vector<SeenOrientation>& turns) {
  check(pairs, names.size(), options);
  PairMap result;
  result.embedding.coordinates.setConstant(std::ssize(names), 2, kNaN);
  const std::vector<MeasuredPair> taken = trusted(pairs, names.size(), options.fewest_scans);
  const Graph graph = graph_of(taken, names.size());
  const std::vector<Eigen::Index> group = largest_component(graph);
  if (group.size() < 3) {
    result.embedding.statuses.push_back(status_of<StatusReason::kTooFewPairs>(pairs.size()));
    return result;
  }
  PairProblem problem = problem_of(taken, group);
  const Points start = options.start ? Points((*options.start)(group, Eigen::all)) : Points();
  Embedding map = solve(problem, start, turns_of(turns, group), options);
  result.embedding.coordinates(group, Eigen::all) = map.coordinates;
  result.embedding.iterations = map.iterations;
  result.embedding.stress = map.stress;
  result.embedding.statuses = separate_groups(graph, group, names);
  for (const Status& status : map.statuses) result.embedding.statuses.push_back(status);
  for (MeasuredPair pair : problem.pairs) {
    pair.first = group[static_cast<std::size_t>(pair.first)];
    pair.second = group[static_cast<std::size_t>(pair.second)];
    result.pairs.push_back(pair);
  }
  return result;
}

PairMap pair_map_of(const DetectionLog& log, const PairNoise& noise,
                    const PairMapOptions& options) {
  PairMap map = pair_map(measured_pairs(log, noise), log.names, options, seen_turns(log));
  if (seen_mirrored(log, map.embedding.coordinates)) map.embedding.coordinates.col(0) *= -1.0;
  return map;
}

}  // namespace mapproof
