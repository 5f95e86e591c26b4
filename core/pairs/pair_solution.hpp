#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/embed/smacof.hpp"
#include "core/model/embedding.hpp"
#include "core/model/trial_study.hpp"
#include "core/pairs/handedness.hpp"
#include "core/pairs/pair_distances.hpp"

namespace mapproof {

/// How measured pairs become a map.
struct PairMapOptions {
  /// A pair seen in fewer scans is left out, unless one of its landmarks has fewer than three
  /// better ones: a few scans may all be of wrong ids. >= 1.
  int fewest_scans = 3;
  /// Times that pairs are weighted anew by how well they fit the map of the others; 0: never.
  int reweightings = 10;
  /// A pair this many typical residuals off has a quarter of its weight left; > 0.
  double tolerance = 2.0;
  bool refined = true;  ///< False: the start, the map of shortest paths, is all.
  /// M x 2, a map to begin with instead of looking for one, as for draws of the same scans. Not
  /// taken if a landmark that pairs hold has no place in it.
  std::optional<Points> start = {};
  SmacofOptions smacof{.relative_fall = 1e-9, .max_iterations = 5000};
};

/// Which pairs most triangles speak against: with the other two sides measured, no third is
/// longer than both together, nor shorter than their difference.
///
/// A triangle speaks against its sides if it fails to close by more than `slack` of the longest.
/// A pair is named if more than half of its triangles do, and two or more.
/// @param pairs  As pair_map takes them; `landmarks` of them.
/// @return As many as pairs.
/// @note O(pairs * landmarks) time.
std::vector<bool> against_triangles(const std::vector<MeasuredPair>& pairs, Eigen::Index landmarks,
                                    double slack = 0.25);

/// Distances and weights of the group's pairs, in its own rows.
struct PairProblem {
  Eigen::MatrixXd distances;
  Eigen::MatrixXd weights;
  std::vector<MeasuredPair> pairs;  ///< Of the group, in its rows.
};

/// How wide the weights begin to follow the residuals, in tolerances.
enum class Width {
  kNarrow,  ///< One tolerance throughout: what is off is soon left out.
  kWide,    ///< From several down to less than one: what is right but off draws the map
            ///< [blake1987].
};

/// A map of a problem's pairs, and what is left of their weights.
struct PairSolution {
  Embedding map;
  std::vector<double> left;       ///< Shares, 1 for a pair that fits.
  std::vector<double> residuals;  ///< In units of what the precisions promise.
  Width width = Width::kNarrow;   ///< That it was found by.
};

/// Residuals in units of what the precisions promise, and the usual one: the standard deviation
/// of a normal of their median, never nothing.
std::vector<double> residuals(const PairProblem& problem, const Points& map);
double usual_residual(const std::vector<double>& residuals);

/// Least stress from a start, with weights that follow the residuals [geman1985].
/// @param left  Shares of the weights to begin with.
PairSolution lowered(PairProblem& problem, const Points& start, std::vector<double> left,
                     Width width, const PairMapOptions& options);

/// The same from a map that is folded somewhere, however far its pairs are off.
PairSolution lowered_widely(PairProblem& problem, const Points& start,
                            const PairMapOptions& options);

/// The same in the last width alone, by stress of all precision.
PairSolution polished(PairProblem& problem, const PairSolution& rough,
                      const PairMapOptions& options);

/// Shares of the weights to begin with: without what triangles speak against.
std::vector<double> shares_by_triangles(const PairProblem& problem);

/// A set of them for each of several starts. The first is shares_by_triangles(); the others, one
/// by one, also what was seen in ever more scans: pairs that none but wrong ids made agree with
/// one another, and can only be told by being few.
std::vector<std::vector<double>> first_shares(const PairProblem& problem);

/// Shares of the weights without pairs that a map makes out to be wholly wrong.
std::vector<double> without_gross(const PairProblem& problem, const Points& map,
                                  std::vector<double> left, double tolerance);

/// The map of shortest paths over the pairs that are not left out.
Embedding path_map(const PairProblem& problem, const std::vector<double>& left);

inline constexpr double kGross = 4.0;  ///< Tolerances from which on a pair is wholly wrong.

/// The best of what several starts come to, the first of those that are about as good: the map
/// that most scans agree with, by what they measured and by the way round that they show
/// landmarks. Folds that distances alone leave are taken back.
/// @param turns  In the problem's rows; may be empty.
PairSolution searched(PairProblem& problem, const std::vector<SeenTurn>& turns,
                      const PairMapOptions& options);

}  // namespace mapproof
