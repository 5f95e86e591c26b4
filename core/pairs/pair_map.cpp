#include "core/pairs/pair_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
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
/// Of the pairs that starts after the first are made of.
constexpr int kFewestLooksOfStarts[] = {7, 14, 28, 56, 112};
constexpr int kMostFolds = 5;           ///< Taken back, one after the other,
constexpr std::size_t kTriedTurns = 3;  ///< by so many triples each.
constexpr double kGross = 4.0;
constexpr double kAsGood = 1.15;
constexpr double kAgreed = 0.02;
constexpr int kFirmLooks = 28;
constexpr int kMostSay = 100;  ///< Looks that count for a pair when maps are compared.

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
  if (options.start && options.start->rows() != static_cast<Eigen::Index>(landmarks))
    throw InvalidInput("a map to begin with needs a row for each landmark");
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

/// Of each pair: it was seen in so many looks, or one of its landmarks has too few that were.
std::vector<bool> are_trusted(const std::vector<MeasuredPair>& pairs, std::size_t landmarks,
                              int fewest_looks) {
  const std::vector<int> count = pairs_of_each(pairs, landmarks, fewest_looks);
  const auto is_short = [&](Eigen::Index i) {
    return count[static_cast<std::size_t>(i)] < kPairsToPlace;
  };
  std::vector<bool> result;
  for (const MeasuredPair& pair : pairs)
    result.push_back(pair.looks >= fewest_looks || is_short(pair.first) || is_short(pair.second));
  return result;
}

std::vector<MeasuredPair> trusted(const std::vector<MeasuredPair>& pairs, std::size_t landmarks,
                                  int fewest_looks) {
  const std::vector<bool> is_taken = are_trusted(pairs, landmarks, fewest_looks);
  std::vector<MeasuredPair> taken;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (is_taken[k]) taken.push_back(pairs[k]);
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

/// The turns of landmarks of the group alone, in its rows.
std::vector<SeenTurn> turns_of(const std::vector<SeenTurn>& turns,
                               const std::vector<Eigen::Index>& group) {
  std::vector<SeenTurn> result;
  for (SeenTurn one : turns) {
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

/// Residuals in units of what the precisions promise.
std::vector<double> residuals(const Problem& problem, const Points& map) {
  std::vector<double> result;
  for (const MeasuredPair& pair : problem.pairs)
    result.push_back(
        std::abs(pair.distance_m - (map.row(pair.first) - map.row(pair.second)).norm()) *
        std::sqrt(pair.precision));
  return result;
}

/// A normal's standard deviation is 1.4826 times the median of what lies off it.
double usual_residual(const std::vector<double>& residuals) {
  return std::max(kLeastResidual, 1.4826 * median(residuals));
}

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

/// Shares of the weights to begin with, a set for each of several starts. The first leaves out what
/// triangles speak against; the others, one by one, also what was seen in ever more looks: pairs
/// that none but wrong ids made agree with one another, and can only be told by being few.
std::vector<std::vector<double>> first_shares(const Problem& problem) {
  const auto n = static_cast<std::size_t>(problem.distances.rows());
  std::vector<std::vector<double>> starts(1);
  for (const bool is_against : against_triangles(problem.pairs, problem.distances.rows()))
    starts.front().push_back(is_against ? kLeastWeight : 1.0);
  for (const int fewest : kFewestLooksOfStarts) {
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

/// A map from one start, and what is left of its pairs' weights.
struct Solution {
  Embedding map;
  std::vector<double> left;
  std::vector<double> residuals;  ///< In units of what the precisions promise.
};

/// How wide the weights begin to follow the residuals, in tolerances.
enum class Width {
  kNarrow,  ///< One tolerance throughout: what is off is soon left out.
  kWide,    ///< From several down to less than one: what is right but off draws the map
            ///< [blake1987].
};

double width_in(Width width, int round) {
  if (width == Width::kNarrow) return 1.0;
  constexpr double kWidest = 8.0;
  constexpr double kNarrowest = 0.7;
  return std::max(kNarrowest, kWidest * std::pow(0.5, 0.5 * round));
}

/// Least stress from a start, with weights that follow the residuals.
/// @param left  Shares of the weights to begin with.
Solution lowered(Problem& problem, const Points& start, std::vector<double> left, Width width,
                 const PairMapOptions& options) {
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
  return {std::move(map), std::move(left), std::move(off)};
}

/// Compares maps by how many looks they disagree with, by what those measured and by the way round
/// that they show landmarks: a pair that lies off costs at most as much as its looks [geman1985].
class Judge {
 public:
  /// @param width  Residual of which a pair costs half of the most.
  Judge(const std::vector<MeasuredPair>& pairs, const std::vector<SeenTurn>& turns, double width)
      : pairs_(pairs), turns_(turns), width_(width) {}

  /// Whether hardly any look disagrees.
  bool is_agreed(const Solution& one) const {
    double most = 0.0;
    for (const MeasuredPair& pair : pairs_) most += std::min(pair.looks, kMostSay);
    return cost(one) <= kAgreed * most;
  }

  double cost(const Solution& one) const {
    double sum = looks_turned_otherwise(turns_, one.map.coordinates, kMostSay);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const double off = one.residuals[k] / width_;
      sum += std::min(pairs_[k].looks, kMostSay) * off * off / (1.0 + off * off);
    }
    return sum;
  }

 private:
  const std::vector<MeasuredPair>& pairs_;
  const std::vector<SeenTurn>& turns_;
  double width_;
};

/// One landmark and what hangs on it once two others are gone, by pairs of many looks; it alone if
/// that is all the rest.
std::vector<Eigen::Index> hanging_on(const Problem& problem, Eigen::Index one, Eigen::Index a,
                                     Eigen::Index b) {
  std::vector<MeasuredPair> firm;
  for (const MeasuredPair& pair : problem.pairs) {
    const auto is_gone = [&](Eigen::Index i) { return i == a || i == b; };
    if (pair.looks >= kFirmLooks && !is_gone(pair.first) && !is_gone(pair.second))
      firm.push_back(pair);
  }
  const auto n = static_cast<std::size_t>(problem.distances.rows());
  const std::vector<int> piece = components(graph_of(firm, n));
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < n; ++i)
    if (piece[i] == piece[static_cast<std::size_t>(one)])
      rows.push_back(static_cast<Eigen::Index>(i));
  if (rows.size() + 2 >= n) return {one};
  return rows;
}

/// The map with some landmarks folded over the line through two others.
Points folded(Points map, const std::vector<Eigen::Index>& rows, Eigen::Index a, Eigen::Index b) {
  const Eigen::RowVector2d along = (map.row(b) - map.row(a)).normalized();
  for (const Eigen::Index row : rows) {
    const Eigen::RowVector2d from = map.row(row) - map.row(a);
    map.row(row) = map.row(a) + 2.0 * from.dot(along) * along - from;
  }
  return map;
}

/// Takes back folds: distances alone leave landmarks on the wrong side of a line.
class Unfolding {
 public:
  Unfolding(Problem& problem, const std::vector<SeenTurn>& turns, const Judge& judge,
            const PairMapOptions& options)
      : problem_(problem), turns_(turns), judge_(judge), options_(options) {}

  /// The map with folds taken back, singly or two together, as long as that helps.
  Solution of(Solution best) {
    for (int round = 0; round < kMostFolds; ++round) {
      std::vector<Solution> others = folded_anew(best);
      const auto cost = [&](const Solution& one) { return judge_.cost(one); };
      std::ranges::sort(others, {}, cost);
      others.resize(std::min(others.size(), kTriedTurns));
      const std::size_t once = others.size();
      if (once == 0) break;
      if (cost(others.front()) >= cost(best))
        for (std::size_t k = 0; k < once; ++k)
          for (Solution& twice : folded_anew(others[k])) others.push_back(std::move(twice));
      Solution& least = *std::ranges::min_element(others, {}, cost);
      if (cost(least) >= cost(best)) break;
      best = std::move(least);
    }
    return best;
  }

 private:
  /// Maps in which a landmark, with what hangs on it, is folded over the line through two others
  /// with which the looks show it the other way round, and that are lowered again.
  std::vector<Solution> folded_anew(const Solution& from) {
    const Points& map = from.map.coordinates;
    std::vector<SeenTurn> wrong = turned_otherwise(turns_, map);
    std::ranges::stable_sort(wrong, std::ranges::greater(), &SeenTurn::looks);
    wrong.resize(std::min(wrong.size(), kTriedTurns));
    std::set<std::vector<Eigen::Index>> tried;
    std::vector<Solution> result;
    for (const SeenTurn& one : wrong)
      for (const auto& [moved, a, b] : {std::array{one.first, one.second, one.third},
                                        std::array{one.second, one.first, one.third},
                                        std::array{one.third, one.first, one.second}}) {
        const std::vector<Eigen::Index> rows = hanging_on(problem_, moved, a, b);
        if (!tried.insert(rows).second) continue;
        const Points start = folded(map, rows, a, b);
        result.push_back(lowered(
            problem_, start,
            shares(residuals(problem_, start), width_in(Width::kWide, 0) * options_.tolerance),
            Width::kWide, options_));
      }
    return result;
  }

  Problem& problem_;
  const std::vector<SeenTurn>& turns_;
  const Judge& judge_;
  const PairMapOptions& options_;
};

/// The best of what several starts come to, the first of those that are about as good.
Solution searched(Problem& problem, const std::vector<std::vector<double>>& starts,
                  const std::vector<SeenTurn>& turns, const PairMapOptions& options) {
  const auto n = static_cast<std::size_t>(problem.distances.rows());
  std::vector<Solution> solutions;
  double usual = std::numeric_limits<double>::infinity();
  for (const Width width : {Width::kNarrow, Width::kWide})
    for (const std::vector<double>& left : starts) {
      const Points start = isomap(starting_graph(problem.pairs, left, n)).coordinates;
      solutions.push_back(lowered(problem, start, left, width, options));
      usual = std::min(usual, usual_residual(solutions.back().residuals));
      if (solutions.size() == 1 &&
          Judge(problem.pairs, turns, kGross * options.tolerance * usual).is_agreed(solutions[0]))
        return std::move(solutions[0]);
    }
  const Judge judge(problem.pairs, turns, kGross * options.tolerance * usual);
  const auto cost = [&](const Solution& one) { return judge.cost(one); };
  const double least = cost(*std::ranges::min_element(solutions, {}, cost));
  Solution& best = *std::ranges::find_if(
      solutions, [&](const Solution& one) { return cost(one) <= kAsGood * least; });
  return Unfolding(problem, turns, judge, options).of(std::move(best));
}

/// Shares of the weights without pairs that a map makes out to be wholly wrong.
std::vector<double> without_gross(const Problem& problem, const Points& map,
                                  std::vector<double> left, double tolerance) {
  const std::vector<double> off = residuals(problem, map);
  const double gross = kGross * tolerance * usual_residual(off);
  for (std::size_t k = 0; k < left.size(); ++k)
    if (off[k] > gross) left[k] = kLeastWeight;
  return left;
}

/// The map of the group's rows; its pairs' precisions become those they had at last.
/// @param start  Of the group; empty: looked for.
Embedding solve(Problem& problem, const Points& start, const std::vector<SeenTurn>& turns,
                const PairMapOptions& options) {
  const std::vector<std::vector<double>> starts = first_shares(problem);
  const auto n = static_cast<std::size_t>(problem.distances.rows());
  if (!options.refined) return isomap(starting_graph(problem.pairs, starts.front(), n));
  Solution best = start.rows() > 0 && start.allFinite()
                      ? lowered(problem, start,
                                without_gross(problem, start, starts.front(), options.tolerance),
                                Width::kNarrow, options)
                      : searched(problem, starts, turns, options);
  for (std::size_t k = 0; k < best.left.size(); ++k) problem.pairs[k].precision *= best.left[k];
  return best.map;
}

}  // namespace

PairMap pair_map(const std::vector<MeasuredPair>& pairs, const std::vector<std::string>& names,
                 const PairMapOptions& options, const std::vector<SeenTurn>& turns) {
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
  const Points start = options.start ? Points((*options.start)(group, Eigen::all)) : Points();
  Embedding map = solve(problem, start, turns_of(turns, group), options);
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
  PairMap map = pair_map(measured_pairs(log, noise), log.names, options, seen_turns(log));
  if (seen_mirrored(log, map.embedding.coordinates)) map.embedding.coordinates.col(0) *= -1.0;
  return map;
}

}  // namespace mapproof
