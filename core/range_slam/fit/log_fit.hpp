#pragma once

#include <optional>
#include <vector>

#include "core/model/fit.hpp"
#include "core/model/range_log.hpp"
#include "core/model/slam/slam.hpp"
#include "core/range_slam/fit/log_problem.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

/// Noise that is given rather than estimated; 0: estimated.
struct GivenNoise {
  double range_m = 0.0;
  double way_m = 0.0;               ///< Of odometry after 1 m.
  double heading_per_metre = 0.0;   ///< Of the heading after 1 m, rad.
  double heading_per_radian = 0.0;  ///< After turning by 1 rad, rad.
};

struct LogFitOptions {
  GivenNoise noise = {};
  /// Standard deviation of the scale of odometry, a share: in the covariances, unless ranges and
  /// odometry agree on the scale.
  double odometry_scale_sigma = 0.003;
  std::optional<KnownLandmarks> known = std::nullopt;  ///< Compared with the map, which is free.
  Eigen::Index test_keys = 400;                        ///< Poses that are estimated in the tests.
  Eigen::Index final_keys = 1200;                      ///< In the map.
  Eigen::Index covariances = 60;                       ///< Poses with a covariance.
  bool only_tests = false;                             ///< No map of the final keys: for studies.
  bool holds_out = false;                              ///< LogFit::held_out is computed.
};

/// How well the plain model and that under a cause predict ranges that neither was fitted to.
struct HeldOutRanges {
  double plain = 0.0;     ///< Mean log-likelihood of a held-out range, nats per range,
  double repaired = 0.0;  ///< and under the cause.
  Eigen::Index ranges = 0;

  /// Whether the cause predicts as well or better.
  bool is_better() const { return repaired >= plain; }
};

/// What a repaired map of known landmarks is made of.
struct Repair {
  /// Without the effect of the cause: IDs exchanged back, offsets and shifts of time subtracted. A
  /// moved landmark has, after its move, the number N: one more than there are.
  RangeLog log;
  SlamEstimate estimate;  ///< Under the cause, landmarks N, in the frame of the first pose.
  LogNoise noise;
};

struct LogFit {
  SlamEstimate estimate;  ///< Path, landmarks, covariances; cost: half of -2 ln L. Empty: no map.
  LogNoise noise;
  Fit fit;
  std::vector<FittedRange> ranges;  ///< In time; of the plain model.
  double inflation = 1.0;           ///< Of variances, as errors hang together in time.
  LogHypothesis cause;             ///< The most significant that can be modelled; kResiduals: none.
  std::optional<Repair> repaired;  ///< Under that cause, where it can be modelled as a map.
  std::optional<HeldOutRanges> held_out;  ///< With LogFitOptions::holds_out, of that repair.
  double cost = 0.0;                      ///< -2 ln L of the plain model,
  double repaired_cost = 0.0;             ///< and under the cause.
  double map_s = 0.0;  ///< Seconds of `estimate` and `noise`, without the tests; vary.
};

/// Fits path, landmarks, range scale and noise to a log, and tests whether the log fits them.
///
/// The plain model is compared with one hypothesis at a time by the drop of -2 ln L, marginal over
/// the path, the noise estimated again under each, divided by the inflation of the residuals'
/// variance through their dependence in time (docs/methods/goodness-of-fit.md).
/// @param starts  Paths, which are carried along the odometry, with landmarks (NaN rows: not
///                known); the one of least cost counts. None: dead reckoning.
/// @return kNotTestable without odometry, without a map or redundancy.
/// @throws InvalidInput if the log breaks what dead_reckoned() or check_ranges() ask.
/// @note One thread; the same bits every time.
LogFit fit_log(const RangeLog& log, const std::vector<SlamEstimate>& starts,
               const LogFitOptions& options = {});

}  // namespace mapproof
