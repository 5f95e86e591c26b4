#include "core/pairs/pair_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "core/embed/isomap.hpp"
#include "core/graph/components.hpp"
#include "core/pairs/handedness.hpp"
#include "core/pairs/triangles.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {
namespace {

constexpr int kPairsToPlace = 3;        ///< Two leave a landmark its mirror image.
constexpr double kLeastResidual = 0.1;  ///< In units of what the precisions promise.
/// Weights that differ more than these allow would leave the landmarks in pieces.
constexpr double kLeastWeight = 1e-5;     ///< Of that of a pair that fits.
constexpr double kLeastPrecision = 1e-3;  ///< Of the greatest.

void check(const std::vector<MeasuredPair>& pairs, std::size_t landmarks,
           const PairMapOptions& options) {
  std::set<std::pair<Eigen::Index, Eigen::Index>> known;
  for (const MeasuredPair& pair : pairs) {
    if (pair.first < 0 || pair.first >= pair.second ||
        pair.second >= static_cast<Eigen::Index>(landmarks) ||
        !known.emplace(pair.first, pair.second).second)
      throw InvalidInput("measured pairs must be of two landmarks in order, and each there once");
    if (!(pair.distance_m >= 0.0 && std::isfinite(pair.distance_m)) ||
        !(pair.precision > 0.0 && std::isfinite(pair.precision)))
      throw InvalidInput("measured pairs need finite distances >= 0 and precisions > 0");
  }
  if (options.fewest_looks < 1 || options.reweightings < 0 || !(options.tolerance > 0.0))
    throw InvalidInput("a map of pairs needs fewest_looks >= 1, reweightings >= 0, tolerance > 0");
}

std::vector<int> pairs_of_each(const std::vector<MeasuredPair>& pairs, std::size_t landmarks,
                               int fewest_looks) {
  std::vector<int> count(landmarks, 0);
  for (const MeasuredPair& pair : pairs)
    if (pair.looks >= fewest_looks)
      for (const Eigen::Index i : {pair.first, pair.second}) ++count[static_cast<std::size_t>(i)];
  return count;
}

std::vector<MeasuredPair> trusted(const std::vector<MeasuredPair>& pairs, std::size_t landmarks,
                                  int fewest_looks) {
  const std::vector<int> count = pairs_of_each(pairs, landmarks, fewest_looks);
  const auto is_short = [&](Eigen::Index i) {
    return count[static_cast<std::size_t>(i)] < kPairsToPlace;
  };
  std::vector<MeasuredPair> taken;
  for (const MeasuredPair& pair : pairs)
    if (pair.looks >= fewest_looks || is_short(pair.first) || is_short(pair.second))
      taken.push_back(pair);
  return taken;
}

Graph graph_of(const std::vector<MeasuredPair>& pairs, std::size_t landmarks) {
  Graph graph(landmarks);
  for (const MeasuredPair& pair : pairs) {
    graph[static_cast<std::size_t>(pair.first)].push_back({pair.second, pair.distance_m});
    graph[static_cast<std::size_t>(pair.second)].push_back({pair.first, pair.distance_m});
  }
  for (std::vector<Edge>& edges : graph) std::ranges::sort(edges, {}, &Edge::to);
  return graph;
}

/// Landmarks of the largest component, the first of several, ascending.
std::vector<Eigen::Index> largest_group(const std::vector<int>& component) {
  std::vector<std::vector<Eigen::Index>> groups;
  for (std::size_t i = 0; i < component.size(); ++i) {
    groups.resize(std::max(groups.size(), static_cast<std::size_t>(component[i]) + 1));
    groups[static_cast<std::size_t>(component[i])].push_back(static_cast<Eigen::Index>(i));
  }
  if (groups.empty()) return {};
  return *std::ranges::max_element(groups, {}, [](const auto& group) { return group.size(); });
}

/// What the pairs leave open, by landmark.
std::vector<Status> gaps(const Graph& graph, const std::vector<Eigen::Index>& group,
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
  const auto add = [&](StatusCode code, const std::vector<std::string>& which, const char* what) {
    if (!which.empty()) statuses.push_back({code, fmt::format("{}: {}.", what, listed(which, 11))});
  };
  add(StatusCode::kLandmarkUnseen, alone,
      "Range and bearing were never measured together with another's, so not mapped");
  add(StatusCode::kTooFewObservations, elsewhere,
      fmt::format("In no look with the {} landmarks that are mapped, so not mapped", group.size())
          .c_str());
  add(StatusCode::kUndetermined, loose,
      "Measured against fewer than three others, which leaves more than one place");
  return statuses;
}

/// Distances and weights of the group's pairs, in its own rows.
struct Problem {
  Eigen::MatrixXd distances;
  Eigen::MatrixXd weights;
  std::vector<MeasuredPair> pairs;  ///< Of the group, in its rows.
};

Problem problem_of(const std::vector<MeasuredPair>& pairs, const std::vector<Eigen::Index>& group) {
  const Eigen::Index n = std::ssize(group);
  Problem problem{.distances = Eigen::MatrixXd::Zero(n, n),
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

/// Residuals in units of what the precisions promise.
std::vector<double> residuals(const Problem& problem, const Points& map) {
  std::vector<double> result;
  for (const MeasuredPair& pair : problem.pairs)
    result.push_back(
        std::abs(pair.distance_m - (map.row(pair.first) - map.row(pair.second)).norm()) *
        std::sqrt(pair.precision));
  return result;
}

/// Shares of the weights left by how far each pair is from the map [geman1985].
std::vector<double> shares(const std::vector<double>& residuals, double tolerance) {
  // A normal's standard deviation is 1.4826 times the median of what lies off it.
  const double usual = std::max(kLeastResidual, 1.4826 * median(residuals));
  std::vector<double> result;
  for (const double residual : residuals) {
    const double off = residual / (tolerance * usual);
    result.push_back(std::max(kLeastWeight, 1.0 / std::pow(1.0 + off * off, 2)));
  }
  return result;
}

void weigh(Problem& problem, const std::vector<double>& left) {
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

/// The map of the group's rows; its pairs' precisions become those they had at last.
Embedding solve(Problem& problem, const PairMapOptions& options) {
  const Eigen::Index n = problem.distances.rows();
  std::vector<double> left;
  for (const bool is_against : against_triangles(problem.pairs, n))
    left.push_back(is_against ? kLeastWeight : 1.0);
  weigh(problem, left);
  const Embedding start = isomap(starting_graph(problem.pairs, left, static_cast<std::size_t>(n)));
  if (!options.refined) return start;
  Embedding map = smacof(problem.distances, problem.weights, start.coordinates, options.smacof);
  for (int round = 0; round < options.reweightings; ++round) {
    left = shares(residuals(problem, map.coordinates), options.tolerance);
    weigh(problem, left);
    const int before = map.iterations;
    map = smacof(problem.distances, problem.weights, map.coordinates, options.smacof);
    map.iterations += before;
  }
  for (std::size_t k = 0; k < left.size(); ++k) problem.pairs[k].precision *= left[k];
  return map;
}

}  // namespace

PairMap pair_map(const std::vector<MeasuredPair>& pairs, const std::vector<std::string>& names,
                 const PairMapOptions& options) {
  check(pairs, names.size(), options);
  PairMap result;
  result.embedding.coordinates.setConstant(std::ssize(names), 2,
                                           std::numeric_limits<double>::quiet_NaN());
  const std::vector<MeasuredPair> taken = trusted(pairs, names.size(), options.fewest_looks);
  const Graph graph = graph_of(taken, names.size());
  const std::vector<Eigen::Index> group = largest_group(components(graph));
  if (group.size() < 3) {
    result.embedding.statuses.push_back(
        {StatusCode::kFailed,
         fmt::format("{} measured, which hold no three landmarks together: nothing to map.",
                     counted(std::ssize(pairs), "pair"))});
    return result;
  }
  Problem problem = problem_of(taken, group);
  Embedding map = solve(problem, options);
  result.embedding.coordinates(group, Eigen::all) = map.coordinates;
  result.embedding.iterations = map.iterations;
  result.embedding.stress = map.stress;
  result.embedding.statuses = gaps(graph, group, names);
  for (const Status& status : map.statuses) result.embedding.statuses.push_back(status);
  for (MeasuredPair pair : problem.pairs) {
    pair.first = group[static_cast<std::size_t>(pair.first)];
    pair.second = group[static_cast<std::size_t>(pair.second)];
    result.pairs.push_back(pair);
  }
  return result;
}

PairMap sighted_map(const SightingLog& log, const PairNoise& noise, const PairMapOptions& options) {
  PairMap map = pair_map(measured_pairs(log, noise), log.names, options);
  if (seen_mirrored(log, map.embedding.coordinates)) map.embedding.coordinates.col(0) *= -1.0;
  return map;
}

}  // namespace mapproof
