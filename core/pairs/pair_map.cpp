#include "core/pairs/pair_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/embed/isomap.hpp"
#include "core/graph/components.hpp"
#include "core/pairs/orientation.hpp"
#include "core/pairs/pair_graph.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {
namespace {

constexpr int kMostFolds = 5;           ///< Unfolded, one after the other,
constexpr std::size_t kTriedTurns = 3;  ///< by so many triples each.
constexpr int kFirmScans = 28;          ///< Of pairs that hold landmarks together in a fold.
constexpr int kMostSay = 100;           ///< Scans that count for a pair when maps are compared.
constexpr double kAsGood = 1.15;        ///< Costs that maps of one quality differ by.
constexpr double kAgreed = 0.02;        ///< Share of the scans that disagree with a map that fits.

/// Compares maps by how many scans they disagree with, in distance and in orientation of landmarks:
/// a pair that is off costs at most as much as its scans [geman1985].
class Judge {
 public:
  /// @param width  Residual of which a pair costs half of the most.
  Judge(const std::vector<MeasuredPair>& pairs, const std::vector<SeenOrientation>& turns,
        double width)
      : pairs_(pairs), turns_(turns), width_(width) {}

  /// Whether hardly any scan disagrees.
  bool is_agreed(const PairSolution& one) const {
    double most = 0.0;
    for (const MeasuredPair& pair : pairs_) most += std::min(pair.scans, kMostSay);
    return cost(one) <= kAgreed * most;
  }

  double cost(const PairSolution& one) const {
    double sum = scans_at_other_orientation(turns_, one.map.coordinates, kMostSay);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const double off = one.residuals[k] / width_;
      sum += std::min(pairs_[k].scans, kMostSay) * off * off / (1.0 + off * off);
    }
    return sum;
  }

 private:
  const std::vector<MeasuredPair>& pairs_;
  const std::vector<SeenOrientation>& turns_;
  double width_;
};

/// One landmark and those connected to it once two others are removed, by pairs of many scans; it
/// alone if that is all the rest.
std::vector<Eigen::Index> hanging_on(const PairProblem& problem, Eigen::Index one, Eigen::Index a,
                                     Eigen::Index b) {
  std::vector<MeasuredPair> firm;
  for (const MeasuredPair& pair : problem.pairs) {
    const auto is_gone = [&](Eigen::Index i) { return i == a || i == b; };
    if (pair.scans >= kFirmScans && !is_gone(pair.first) && !is_gone(pair.second))
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

/// Unfolds the map: distances alone leave landmarks on the wrong side of a line.
class Unfolding {
 public:
  Unfolding(PairProblem& problem, const std::vector<SeenOrientation>& turns, const Judge& judge,
            const PairMapOptions& options)
      : problem_(problem), turns_(turns), judge_(judge), options_(options) {}

  /// The unfolded map, one or two folds at a time, as long as that helps.
  PairSolution of(PairSolution best) {
    for (int round = 0; round < kMostFolds; ++round) {
      std::vector<PairSolution> others = refolded(best);
      const auto cost = [&](const PairSolution& one) { return judge_.cost(one); };
      std::ranges::sort(others, {}, cost);
      others.resize(std::min(others.size(), kTriedTurns));
      const std::size_t once = others.size();
      if (once == 0) break;
      if (cost(others.front()) >= cost(best))
        for (std::size_t k = 0; k < once; ++k)
          for (PairSolution& twice : refolded(others[k])) others.push_back(std::move(twice));
      PairSolution& least = *std::ranges::min_element(others, {}, cost);
      if (cost(least) >= cost(best)) break;
      best = std::move(least);
    }
    return best;
  }

 private:
  /// Maps in which a landmark, with those connected to it, is reflected across the line through two
  /// others with which the scans show the opposite orientation, and whose stress is minimized
  /// again.
  std::vector<PairSolution> refolded(const PairSolution& from) {
    const Points& map = from.map.coordinates;
    std::vector<SeenOrientation> wrong = at_other_orientation(turns_, map);
    std::ranges::stable_sort(wrong, std::ranges::greater(), &SeenOrientation::scans);
    wrong.resize(std::min(wrong.size(), kTriedTurns));
    std::set<std::vector<Eigen::Index>> tried;
    std::vector<PairSolution> result;
    for (const SeenOrientation& one : wrong)
      for (const auto& [moved, a, b] : {std::array{one.first, one.second, one.third},
                                        std::array{one.second, one.first, one.third},
                                        std::array{one.third, one.first, one.second}}) {
        const std::vector<Eigen::Index> rows = hanging_on(problem_, moved, a, b);
        if (!tried.insert(rows).second) continue;
        const Points start = folded(map, rows, a, b);
        result.push_back(minimized_widely(problem_, start, options_));
      }
    return result;
  }

  PairProblem& problem_;
  const std::vector<SeenOrientation>& turns_;
  const Judge& judge_;
  const PairMapOptions& options_;
};

constexpr double kLeastResidual = 0.1;  ///< In units of the residual that the precisions imply.
/// Weights that differ by more than this would disconnect the landmarks.
constexpr double kLeastWeight = 1e-5;  ///< Of that of a pair that fits.
/// Of the pairs that starts after the first are made of.
constexpr int kFewestScansOfStarts[] = {7, 14, 28, 56, 112};

/// Shares of the weights left by each pair's residual on the map [geman1985].
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

/// The graph without pairs that violate triangle inequalities, if it is connected without them.
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

std::vector<bool> against_triangles(const std::vector<MeasuredPair>& pairs, Eigen::Index landmarks,
                                    double slack) {
  Eigen::MatrixXd sides = Eigen::MatrixXd::Constant(landmarks, landmarks, kNaN);
  for (const MeasuredPair& pair : pairs)
    sides(pair.first, pair.second) = sides(pair.second, pair.first) = pair.distance_m;

  std::vector<bool> result;
  for (const MeasuredPair& pair : pairs) {
    const auto a = sides.col(pair.first).array();
    const auto b = sides.col(pair.second).array();
    const Eigen::ArrayXd longest = a.max(b).max(pair.distance_m);
    // By how much one side is longer than the other two together; NaN where one is not known.
    const Eigen::ArrayXd gap = 2.0 * longest - a - b - pair.distance_m;
    const Eigen::Index triangles = (gap == gap).count();
    const Eigen::Index broken = (gap > slack * longest).count();
    result.push_back(broken >= 2 && 2 * broken > triangles);
  }
  return result;
}

std::vector<double> residuals(const PairProblem& problem, const Points& map) {
  std::vector<double> result;
  for (const MeasuredPair& pair : problem.pairs)
    result.push_back(
        std::abs(pair.distance_m - (map.row(pair.first) - map.row(pair.second)).norm()) *
        std::sqrt(pair.precision));
  return result;
}

double usual_residual(const std::vector<double>& residuals) {
  // A normal's standard deviation is 1.4826 times the median absolute deviation.
  return std::max(kLeastResidual, 1.4826 * median(residuals));
}

PairSolution minimized(PairProblem& problem, const Points& start, std::vector<double> left,
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

PairSolution minimized_widely(PairProblem& problem, const Points& start,
                              const PairMapOptions& options) {
  std::vector<double> left =
      shares(residuals(problem, start), width_in(Width::kWide, 0) * options.tolerance);
  return minimized(problem, start, std::move(left), Width::kWide, options);
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

PairSolution searched(PairProblem& problem, const std::vector<SeenOrientation>& turns,
                      const PairMapOptions& options) {
  const std::vector<std::vector<double>> starts = first_shares(problem);
  PairMapOptions rough = options;  // Decides which map it will be.
  rough.smacof.relative_fall = std::max(rough.smacof.relative_fall, 1e-6);
  rough.smacof.max_iterations = std::min(rough.smacof.max_iterations, 300);
  std::vector<PairSolution> solutions;
  double usual = kInfinity;
  for (const Width width : {Width::kNarrow, Width::kWide})
    for (const std::vector<double>& left : starts) {
      solutions.push_back(
          minimized(problem, path_map(problem, left).coordinates, left, width, rough));
      usual = std::min(usual, usual_residual(solutions.back().residuals));
      if (solutions.size() == 1 &&
          Judge(problem.pairs, turns, kGross * options.tolerance * usual).is_agreed(solutions[0]))
        return polished(problem, solutions[0], options);
    }
  const Judge judge(problem.pairs, turns, kGross * options.tolerance * usual);
  const auto cost = [&](const PairSolution& one) { return judge.cost(one); };
  const double least = cost(*std::ranges::min_element(solutions, {}, cost));
  PairSolution& best = *std::ranges::find_if(
      solutions, [&](const PairSolution& one) { return cost(one) <= kAsGood * least; });
  return polished(problem, Unfolding(problem, turns, judge, rough).of(std::move(best)), options);
}

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
