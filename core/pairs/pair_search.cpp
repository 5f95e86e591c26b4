#include "core/pairs/pair_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "core/graph/components.hpp"
#include "core/pairs/pair_graph.hpp"

namespace mapproof {
namespace {

constexpr int kMostFolds = 5;           ///< Taken back, one after the other,
constexpr std::size_t kTriedTurns = 3;  ///< by so many triples each.
constexpr int kFirmScans = 28;          ///< Of pairs that hold landmarks together in a fold.
constexpr int kMostSay = 100;           ///< Scans that count for a pair when maps are compared.
constexpr double kAsGood = 1.15;        ///< Costs that maps of one quality differ by.
constexpr double kAgreed = 0.02;        ///< Share of the scans that disagree with a map that fits.

/// Compares maps by how many scans they disagree with, by what those measured and by the way round
/// that they show landmarks: a pair that lies off costs at most as much as its scans [geman1985].
class Judge {
 public:
  /// @param width  Residual of which a pair costs half of the most.
  Judge(const std::vector<MeasuredPair>& pairs, const std::vector<SeenTurn>& turns, double width)
      : pairs_(pairs), turns_(turns), width_(width) {}

  /// Whether hardly any scan disagrees.
  bool is_agreed(const PairSolution& one) const {
    double most = 0.0;
    for (const MeasuredPair& pair : pairs_) most += std::min(pair.scans, kMostSay);
    return cost(one) <= kAgreed * most;
  }

  double cost(const PairSolution& one) const {
    double sum = scans_turned_otherwise(turns_, one.map.coordinates, kMostSay);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const double off = one.residuals[k] / width_;
      sum += std::min(pairs_[k].scans, kMostSay) * off * off / (1.0 + off * off);
    }
    return sum;
  }

 private:
  const std::vector<MeasuredPair>& pairs_;
  const std::vector<SeenTurn>& turns_;
  double width_;
};

/// One landmark and what hangs on it once two others are gone, by pairs of many scans; it alone if
/// that is all the rest.
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

/// Takes back folds: distances alone leave landmarks on the wrong side of a line.
class Unfolding {
 public:
  Unfolding(PairProblem& problem, const std::vector<SeenTurn>& turns, const Judge& judge,
            const PairMapOptions& options)
      : problem_(problem), turns_(turns), judge_(judge), options_(options) {}

  /// The map with folds taken back, singly or two together, as long as that helps.
  PairSolution of(PairSolution best) {
    for (int round = 0; round < kMostFolds; ++round) {
      std::vector<PairSolution> others = folded_anew(best);
      const auto cost = [&](const PairSolution& one) { return judge_.cost(one); };
      std::ranges::sort(others, {}, cost);
      others.resize(std::min(others.size(), kTriedTurns));
      const std::size_t once = others.size();
      if (once == 0) break;
      if (cost(others.front()) >= cost(best))
        for (std::size_t k = 0; k < once; ++k)
          for (PairSolution& twice : folded_anew(others[k])) others.push_back(std::move(twice));
      PairSolution& least = *std::ranges::min_element(others, {}, cost);
      if (cost(least) >= cost(best)) break;
      best = std::move(least);
    }
    return best;
  }

 private:
  /// Maps in which a landmark, with what hangs on it, is folded over the line through two others
  /// with which the scans show it the other way round, and that are lowered again.
  std::vector<PairSolution> folded_anew(const PairSolution& from) {
    const Points& map = from.map.coordinates;
    std::vector<SeenTurn> wrong = turned_otherwise(turns_, map);
    std::ranges::stable_sort(wrong, std::ranges::greater(), &SeenTurn::scans);
    wrong.resize(std::min(wrong.size(), kTriedTurns));
    std::set<std::vector<Eigen::Index>> tried;
    std::vector<PairSolution> result;
    for (const SeenTurn& one : wrong)
      for (const auto& [moved, a, b] : {std::array{one.first, one.second, one.third},
                                        std::array{one.second, one.first, one.third},
                                        std::array{one.third, one.first, one.second}}) {
        const std::vector<Eigen::Index> rows = hanging_on(problem_, moved, a, b);
        if (!tried.insert(rows).second) continue;
        const Points start = folded(map, rows, a, b);
        result.push_back(lowered_widely(problem_, start, options_));
      }
    return result;
  }

  PairProblem& problem_;
  const std::vector<SeenTurn>& turns_;
  const Judge& judge_;
  const PairMapOptions& options_;
};

}  // namespace

PairSolution searched(PairProblem& problem, const std::vector<SeenTurn>& turns,
                      const PairMapOptions& options) {
  const std::vector<std::vector<double>> starts = first_shares(problem);
  PairMapOptions rough = options;  // Tells which map it will be.
  rough.smacof.relative_fall = std::max(rough.smacof.relative_fall, 1e-6);
  rough.smacof.max_iterations = std::min(rough.smacof.max_iterations, 300);
  std::vector<PairSolution> solutions;
  double usual = std::numeric_limits<double>::infinity();
  for (const Width width : {Width::kNarrow, Width::kWide})
    for (const std::vector<double>& left : starts) {
      solutions.push_back(
          lowered(problem, path_map(problem, left).coordinates, left, width, rough));
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

}  // namespace mapproof
