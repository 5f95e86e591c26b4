#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/association/log_blocks.hpp"
#include "core/association/robust_map.hpp"
#include "core/model/detection_log.hpp"

namespace mapproof {

/// How a slice of time asks for one landmark's position to be shifted: near the position where it
/// was measured, the cost of a shift by x is x' H x / 2 - g' x.
struct ShiftSlice {
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  Eigen::Vector2d g = Eigen::Vector2d::Zero();
};

/// The two positions of one landmark, before and after some slice of time, that reduce the cost of
/// one the most. Only slices that show the landmark are listed.
struct PositionChange {
  std::size_t first = 0;  ///< Slice with which the second position begins; 0: it has one alone.
  std::vector<ShiftSlice> asked;  ///< Of the first position, though linearized at each slice's own.
  std::vector<ShiftSlice> residual;  ///< Of each slice's own position: what is left to chance.
};

/// Looks for the positions at the map's position of the landmark and on circles about it whose
/// radii double from an eighth of the cost's width to beyond the map, then where the cost is least
/// nearby.
/// @note O(items * positions), some 200 positions.
PositionChange best_change(const std::vector<PairItem>& items, const RobustMap& map,
                           const LogBlocks& blocks, int landmark);

/// The most that a second position, on two slices or more, reduces the cost of what slices ask for.
double best_gain(const std::vector<ShiftSlice>& slices);

struct PermutationOptions {
  int count = 1999;
  std::uint64_t seed = 1;
  double inflation = 1.0;  ///< Of what `residual` gains by chance, >= 1.
};

/// How likely chance gains as much by a second position: the greater of two shares, of permutations
/// of `asked`, which is exact where slices have independent errors, and of permutations of
/// `residual`, inflated, for slices with correlated errors. 1 for fewer than 6 slices.
/// @note Stops early where it is clearly large, with what was drawn until then.
double chance_of(const PositionChange& change, const PermutationOptions& options);

/// By how much the landmarks' best gains exceed what permutations of their `residual` gain: the
/// median over landmarks, so that a few that moved do not count; >= 1. More than 1 where errors are
/// correlated over slices.
double inflation(const std::vector<PositionChange>& landmarks, std::uint64_t seed);

/// When a landmark is reported as moved.
struct MovedOptions {
  double level = 0.05;      ///< Of the error of the first kind over all landmarks [holm1979].
  int permutations = 1999;  ///< >= 19; more are drawn where Holm's level asks for it.
  int slices = 30;          ///< Of time, within which errors are correlated; >= 6.
  double least_move = 1.5;  ///< In standard deviations of a pair's residuals; 0: any.
  int most_findings = 10;   ///< >= 0.
  std::uint64_t seed = 1;   ///< Of the permutations.
  /// Whether a move must also stand out from what correlated errors do to other landmarks, see
  /// contrast_ratio(). Permutations take slices of time to be independent.
  bool is_contrasted = false;
};

/// A landmark that is at another position from some step on.
struct MovedLandmark {
  int landmark = 0;
  int step = 0;           ///< The first detection at the new position, in order of time.
  int earliest_step = 0;  ///< The move lies between these scans: at any other time it would
  int latest_step = 0;    ///< explain the scans significantly worse.
  double distance_m = 0.0;
  double p = 1.0;              ///< Holm's, over all landmarks.
  double loss_before_m = 0.0;  ///< See RobustMap; of the map with one position,
  double loss_after_m = 0.0;   ///< and with two.
};

/// The moved landmarks, and the log with two landmarks for each.
struct MovedCheck {
  std::vector<MovedLandmark> moved;  ///< In the order found, the clearest first.
  DetectionLog split;  ///< A moved landmark's later detections are of a landmark "NAME (moved)".
  double loss_before_m = 0.0;
  double loss_after_m = 0.0;
};

/// Looks for landmarks that moved once: the position that the distances to the others ask for
/// changes at one time. The statistic is the most that two positions, before and after, reduce the
/// cost of one; the gain of chance alone is the greater of two permutation tests over slices of
/// time [good2005], see chance_of(), inflated by what the other landmarks gain beyond chance.
///
/// The landmark of the least p is split and the rest are tested again, while Holm's p is below the
/// level and the move above its least size. An ID swap looks like a move of both landmarks: check
/// the IDs first.
/// @throws InvalidInput if an option breaks its bounds, or as scan_pairs and robust_map do.
/// @note Rounds: one more than moves found; each some 200 positions for each pair of a scan, and at
///         most M * permutations * slices, stopped early for landmarks that clearly stand.
MovedCheck find_moved(const DetectionLog& log, const MovedOptions& options = {});

}  // namespace mapproof
