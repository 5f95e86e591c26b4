#pragma once

#include <vector>

#include "core/pairs/pair_map.hpp"

namespace mapproof {

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

/// Residuals in units of what the precisions promise, and the usual one: the standard deviation of
/// a normal of their median, never nothing.
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

/// A set of them for each of several starts. The first is shares_by_triangles(); the others, one by
/// one, also what was seen in ever more scans: pairs that none but wrong ids made agree with one
/// another, and can only be told by being few.
std::vector<std::vector<double>> first_shares(const PairProblem& problem);

/// Shares of the weights without pairs that a map makes out to be wholly wrong.
std::vector<double> without_gross(const PairProblem& problem, const Points& map,
                                  std::vector<double> left, double tolerance);

/// The map of shortest paths over the pairs that are not left out.
Embedding path_map(const PairProblem& problem, const std::vector<double>& left);

inline constexpr double kGross = 4.0;  ///< Tolerances from which on a pair is wholly wrong.

}  // namespace mapproof
