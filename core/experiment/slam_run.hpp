#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/model/slam/slam_study.hpp"
#include "core/range_slam/factors/squared_ranges.hpp"
#include "core/range_slam/factors/windowed_ranges.hpp"
#include "core/range_slam/fit/log_fit.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

struct RefineOptions;

/// How the methods are run on one log.
struct SlamRunOptions {
  std::vector<SlamMethod> methods;        ///< In the order of the tables.
  std::optional<KnownLandmarks> known{};  ///< For the methods that know landmarks.
  /// The refinement holds the known landmarks too; errors of landmarks then leave them out.
  bool ties_refinement = false;
  RangeNoise noise{};      ///< The bias that is subtracted from squared ranges that come together.
  int random_starts = 0;   ///< Of the refinement, in addition to the one that is kept.
  std::uint64_t seed = 0;  ///< Of the random starts.
  /// The noise is estimated from the log, and the fit of log and map tested; empty: the noise is
  /// that of RefineOptions and EkfOptions.
  std::optional<LogFitOptions> fit{};
  /// With `fit`: a record of the map under the cause of a misfit, too, unless it predicts held-out
  /// ranges worse.
  bool repairs = false;
};

struct SlamRunResult {
  SlamRun run;
  std::vector<SlamTiming> timings;  ///< A method's own seconds, without those of its start and of
                                    ///< the choice of windows.
};

/// Runs each method on a log, aligns the results to the frame of the ground truth (or, without one,
/// of a method that holds the known landmarks, or of the first method), and computes the errors.
///
/// All is computed about the mean of the known landmarks, or about the start where none is known:
/// the results move with the coordinates that are given, however far from 0 these are.
/// With odometry, windows of the ranges are chosen by their predictions. Without, the spectral
/// methods take the times at which all landmarks were ranged to, the map's reflection is as good as
/// the map, and all other methods fail with kFailed.
/// Pure but for the timings.
SlamRunResult make_slam_run(const std::string& id, RangeLog log, const SlamRunOptions& options);

/// Aligns an estimate to the ground truth of a log by `first` and computes its errors, under this
/// and every weaker alignment that is meaningful. Nothing without ground truth.
void score_against_ground_truth(SlamRecord& record, const RangeLog& log, Alignment first);

/// Aligns an estimate to a path, rigidly, with reflection if it is free.
void align_to(SlamEstimate& estimate, const Trajectory& path, bool may_mirror);

/// The methods on one log; starts that several of them share are computed once.
class SlamEstimates {
 public:
  /// Both must outlive it.
  SlamEstimates(const RangeLog& log, const SlamRunOptions& options);

  /// A method's estimate from the log, in whatever frame; kFailed where it cannot.
  SlamEstimate estimate(SlamMethod method);

  /// The refinement from random landmarks, of that number from 1.
  SlamEstimate refined_from_random(int number);

  /// Covariances of the landmarks of the spectral map that estimate() made last, by a bootstrap
  /// over windows; none where there is no such map.
  std::vector<Eigen::Matrix2d> landmark_covariances(SlamMethod method,
                                                    const SlamEstimate& estimate) const;

  /// Computes a method's start, so that it is not timed with it.
  void prepare(SlamMethod method);

  /// Seconds of prepare() that are the method's own: those of the map that it takes from the fit.
  double prepared_s(SlamMethod method) const;

  /// The log fitted with its own noise; null unless it was asked for.
  /// @throws InvalidInput as fit_log().
  const LogFit* log_fit();

  /// The window lengths tried; empty without odometry.
  std::optional<WindowCurve> windows() const;

  /// Some of the states that the metric upgrade of the last map without known landmarks and heading
  /// was fitted to; empty if there is none.
  const std::optional<UpgradeClouds>& upgrade() const { return upgrade_; }

 private:
  SlamEstimate solve(SlamMethod method);
  /// Whether the method's estimate is that of log_fit().
  bool is_of_fit(SlamMethod method) const;
  SlamEstimate spectral(bool with_known, bool with_heading);
  SlamEstimate filtered();
  SlamEstimate refined(const SlamEstimate& start, bool estimate_scale);
  /// In the frame of the known landmarks where they tie the refinement.
  SlamEstimate repaired();
  RefineOptions refinement(const LogNoise& noise) const;
  OdometryNoise noise_of_motion(const LogNoise& noise) const;
  const Trajectory& reckoned();
  const WindowOptions& window();
  const SlamEstimate& spectral_start();
  const SlamEstimate& odometry_start();

  const RangeLog& log_;
  const SlamRunOptions& options_;
  std::optional<Trajectory> reckoned_;
  std::optional<WindowOptions> window_;
  WindowCurve curve_;
  Eigen::MatrixXd Y_;  ///< Squared ranges of the spectral map made last.
  std::optional<UpgradeClouds> upgrade_;
  std::optional<SlamEstimate> spectral_start_;
  std::optional<SlamEstimate> odometry_start_;
  std::optional<LogFit> fit_;
};

/// The length that the constants of the range-only methods take for 30 m: the median range. With
/// lengths in it a log gives the same map whatever its unit.
double unit_of(const RangeLog& log);

/// All lengths of a log times a factor, > 0.
RangeLog in_unit(RangeLog log, double factor);

/// All lengths of a run's results times a factor, > 0; its log is put in place of the run's.
void take_unit(SlamRun& run, RangeLog log, double factor);

}  // namespace mapproof
