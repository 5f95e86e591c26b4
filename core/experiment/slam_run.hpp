#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/model/slam_study.hpp"
#include "core/range_slam/factors/squared_ranges.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

/// How the methods are run on one log.
struct SlamRunOptions {
  std::vector<SlamMethod> methods;        ///< In the order of the tables.
  std::optional<KnownLandmarks> known{};  ///< For the methods that know landmarks.
  bool ties_refinement = false;           ///< The refinement holds the known landmarks too.
  RangeNoise noise{};                     ///< What is taken off squared ranges that come together.
  int random_starts = 0;                  ///< Of the refinement, beside the one that is kept.
  std::uint64_t seed = 0;                 ///< Of the random starts.
};

struct SlamRunResult {
  SlamRun run;
  std::vector<SlamTiming> timings;  ///< A method's own seconds, without those of its start and of
                                    ///< the choice of windows.
};

/// Runs each method on a log, brings what came out into the frame of the truth (or, without one,
/// of the first method), and takes the errors.
///
/// With odometry, windows of the ranges are chosen by what they predict. Without, the spectral
/// methods take the times at which all landmarks were ranged to, the map's mirror image is as good
/// as the map, and all other methods come out kFailed.
/// Pure but for the timings.
SlamRunResult make_slam_run(const std::string& id, RangeLog log, const SlamRunOptions& options);

}  // namespace mapproof
