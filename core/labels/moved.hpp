#pragma once

#include <cstdint>
#include <vector>

#include "core/labels/log_blocks.hpp"
#include "core/labels/robust_map.hpp"
#include "core/model/detection_log.hpp"

namespace mapproof {

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
