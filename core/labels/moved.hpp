#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/labels/log_blocks.hpp"
#include "core/labels/robust_map.hpp"
#include "core/model/detection_log.hpp"

namespace mapproof {

/// How a slice of time asks for one landmark's place to be shifted: the cost, near the place it is
/// told of, is x' H x / 2 - g' x for a shift by x.
struct ShiftSlice {
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  Eigen::Vector2d g = Eigen::Vector2d::Zero();
};

/// The two places of one landmark, before and after some slice of time, that lower the cost of one
/// the most. Only slices that show the landmark are told of.
struct PlaceChange {
  std::size_t first = 0;  ///< Slice with which the second place begins; 0: it has one alone.
  std::vector<ShiftSlice> asked;     ///< Of the first place, though linear at each slice's own.
  std::vector<ShiftSlice> residual;  ///< Of each slice's own place: what is left to chance.
};

/// Looks for the places where the map has the landmark and on circles about it whose radii double
/// from an eighth of the cost's width to beyond the map, then where the cost is least nearby.
/// @note O(items * places), some 200 places.
PlaceChange best_change(const std::vector<PairItem>& items, const RobustMap& map,
                        const LogBlocks& blocks, int landmark);

/// The most that a second place, on two slices or more, lowers the cost of what slices ask for.
double best_gain(const std::vector<ShiftSlice>& slices);

struct PermutationOptions {
  int count = 1999;
  std::uint64_t seed = 1;
  double inflation = 1.0;  ///< Of what `residual` gains by chance, >= 1.
};

/// How likely chance gains as much by a second place: the greater of two shares, of permutations of
/// `asked`, which is exact where slices err by themselves, and of permutations of `residual`,
/// inflated, for slices whose errors hang together. 1 for fewer than 6 slices.
/// @note Stops early where it is plainly large, with what was drawn until then.
double chance_of(const PlaceChange& change, const PermutationOptions& options);

/// By how much the landmarks' best gains exceed what permutations of their `residual` gain: the
/// median over landmarks, so that a few that moved do not count; >= 1. More than 1 where errors
/// hang together over slices.
double inflation(const std::vector<PlaceChange>& landmarks, std::uint64_t seed);

/// When a landmark is said to have moved.
struct MovedOptions {
  double level = 0.05;      ///< Of the error of the first kind over all landmarks [holm1979].
  int permutations = 1999;  ///< >= 19; more are drawn where Holm's level asks for it.
  int slices = 30;          ///< Of time, within which errors hang together; >= 6.
  double least_move = 1.5;  ///< In standard deviations of a pair's residuals; 0: any.
  int most_findings = 10;   ///< >= 0.
  std::uint64_t seed = 1;   ///< Of the permutations.
};

/// A landmark that stands elsewhere from some step on.
struct MovedLandmark {
  int landmark = 0;
  int step = 0;           ///< The first detection at the new place, in order of time.
  int earliest_step = 0;  ///< The move lies between these scans: elsewhere it would explain the
  int latest_step = 0;    ///< scans worse by more than chance does.
  double distance_m = 0.0;
  double p = 1.0;              ///< Holm's, over all landmarks.
  double loss_before_m = 0.0;  ///< See RobustMap; of the map with one place,
  double loss_after_m = 0.0;   ///< and with two.
};

/// What moved, and the log with two landmarks for each that did.
struct MovedCheck {
  std::vector<MovedLandmark> moved;  ///< In the order found, the plainest first.
  DetectionLog split;  ///< A moved landmark's later detections are of a landmark "NAME (moved)".
  double loss_before_m = 0.0;
  double loss_after_m = 0.0;
};

/// Looks for landmarks that moved once: the place that the distances to the others ask for changes
/// at one time. The statistic is the most that two places, before and after, lower the cost of one;
/// how much chance alone does is the greater of two permutation tests over slices of time
/// [good2005], see chance_of(), inflated by what the other landmarks gain beyond chance.
///
/// The landmark of the least p is split and the rest are tried anew, while Holm's p is below the
/// level and the move above its least size. A landmark that two labels were swapped of moves too:
/// check the labels first.
/// @throws InvalidInput if an option breaks its bounds, or as scan_pairs and robust_map do.
/// @note A round, one more than moves found: some 200 places for each pair of a scan, and at most
///       M * permutations * slices, stopped early for landmarks that plainly stand.
MovedCheck find_moved(const DetectionLog& log, const MovedOptions& options = {});

}  // namespace mapproof
