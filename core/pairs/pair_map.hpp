#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/embed/smacof.hpp"
#include "core/model/embedding.hpp"
#include "core/model/topic_study.hpp"
#include "core/pairs/orientation.hpp"
#include "core/pairs/pair_distances.hpp"

namespace mapproof {

/// How measured pairs become a map.
struct PairMapOptions {
  /// A pair seen in fewer scans is left out, unless one of its landmarks has fewer than three
  /// better ones: a few scans may all be of wrong ids. >= 1.
  int fewest_scans = 3;
  /// How often pairs are reweighted by how well they fit the map of the others; 0: never.
  int reweightings = 10;
  /// A pair this many typical residuals off has a quarter of its weight left; > 0.
  double tolerance = 2.0;
  bool refined = true;  ///< False: the result is the start, the map of shortest paths.
  /// M x 2, an initial map instead of a search for one, as for resamples of the same scans. Ignored
  /// if a landmark that pairs hold has no position in it.
  std::optional<Points> start = {};
  SmacofOptions smacof{.relative_fall = 1e-9, .max_iterations = 5000};
};

/// Which pairs most triangles contradict: with the other two sides measured, the third is neither
/// longer than both together, nor shorter than their difference.
///
/// A triangle contradicts its sides if it fails to close by more than `slack` of the longest. A
/// pair is named if more than half of its triangles contradict it, and two or more.
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

/// The initial width of the weights' response to residuals, in tolerances.
enum class Width {
  kNarrow,  ///< One tolerance throughout: outliers soon lose their weight.
  kWide,    ///< From several down to less than one: correct but inaccurate pairs pull the map
            ///< [blake1987].
};

/// A map of a problem's pairs, and the shares of their weights that are left.
struct PairSolution {
  Embedding map;
  std::vector<double> left;       ///< Shares, 1 for a pair that fits.
  std::vector<double> residuals;  ///< In units of the residual that the precisions imply.
  Width width = Width::kNarrow;   ///< The width it was found with.
};

/// Residuals in units of what the precisions imply, and the usual one: the standard deviation of a
/// normal with their median, never zero.
std::vector<double> residuals(const PairProblem& problem, const Points& map);
double usual_residual(const std::vector<double>& residuals);

/// Least stress from a start, with weights that follow the residuals [geman1985].
/// @param left  Initial shares of the weights.
PairSolution minimized(PairProblem& problem, const Points& start, std::vector<double> left,
                       Width width, const PairMapOptions& options);

/// The same from a map that is folded somewhere, however large its residuals are.
PairSolution minimized_widely(PairProblem& problem, const Points& start,
                              const PairMapOptions& options);

/// The same in the last width alone, with the full precision of stress.
PairSolution polished(PairProblem& problem, const PairSolution& rough,
                      const PairMapOptions& options);

/// Initial shares of the weights: zero for pairs that triangles contradict.
std::vector<double> shares_by_triangles(const PairProblem& problem);

/// A set of them for each of several starts. The first is shares_by_triangles(); the others, one by
/// one, also leave out pairs seen in ever more scans: pairs from wrong IDs alone agree with one
/// another, and only their small number gives them away.
std::vector<std::vector<double>> first_shares(const PairProblem& problem);

/// Shares of the weights without the pairs that a map finds wholly wrong.
std::vector<double> without_gross(const PairProblem& problem, const Points& map,
                                  std::vector<double> left, double tolerance);

/// The map of shortest paths over the pairs that are not left out.
Embedding path_map(const PairProblem& problem, const std::vector<double>& left);

inline constexpr double kGross = 4.0;  ///< Tolerances from which on a pair is wholly wrong.

/// The best of the solutions from several starts, the first of those that are about as good: the
/// map that most scans agree with, in distance and in orientation of landmarks. Folds that
/// distances alone leave are removed.
/// @param turns  In the problem's rows; may be empty.
PairSolution searched(PairProblem& problem, const std::vector<SeenOrientation>& turns,
                      const PairMapOptions& options);

/// A map of measured pairs.
struct PairMap {
  Embedding embedding;  ///< In metres, defined up to translation and rotation, and reflection for
                        ///< pair_map.
  std::vector<MeasuredPair> pairs;  ///< The pairs it was made of, with their final precisions.
};

/// A metric map of landmarks some of whose distances were measured: classical scaling of the
/// shortest paths over the measured pairs [tenenbaum2000], without those that violate triangle
/// inequalities (see contradicted_pairs), then least stress over the measured pairs alone
/// [deleeuw1977], each weighted by its precision and, iteratively, by how well it fits [geman1985].
///
/// @param pairs  first < second < landmarks, none twice; distances >= 0, precisions > 0, finite.
/// @param names  Of the landmarks, M, for the statuses.
/// @return M rows. The largest group of landmarks that pairs hold together is mapped; the others
///         get NaN rows, and kLandmarkUnseen (not in any pair) or kTooFewObservations (in another
///         group). kUndetermined names landmarks with too few pairs for one position. kFailed if no
///         three hold together. From SMACOF: kNotConverged, kRankDeficient. Scale is kept.
/// @throws InvalidInput if the bounds above are broken.
/// @note O(M^3) time for the start, and reweightings + 1 runs of SMACOF.
PairMap pair_map(const std::vector<MeasuredPair>& pairs, const std::vector<std::string>& names,
                 const PairMapOptions& options = {},
                 const std::vector<SeenOrientation>& turns = {});

/// The pair map of the scans, reflected so that its landmarks have the orientation that the scans
/// show, bearings being counter-clockwise.
PairMap pair_map_of(const DetectionLog& log, const PairNoise& noise = {},
                    const PairMapOptions& options = {});

}  // namespace mapproof
