#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/fit.hpp"
#include "core/model/points.hpp"
#include "core/model/slam/slam.hpp"
#include "core/model/slam/slam_experiment.hpp"
#include "core/model/study.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {

/// Points in space and the quadric that was fitted to them, [p' 1] Q [p' 1]' = 0.
struct QuadricPoints {
  SpacePoints points;
  Eigen::Matrix4d Q = Eigen::Matrix4d::Zero();
};

/// How a metric upgrade changed the states of the robot's positions, some of them, evenly spread.
struct UpgradeClouds {
  std::vector<Eigen::Index> steps;  ///< Of the estimated path, ascending: a row of each cloud.
  QuadricPoints before;             ///< Whitened, in their plane of scale 1; no unit.
  QuadricPoints after;  ///< (x, y, (x^2 + y^2)/2) about the mean position, m, m and m^2.
};

/// What one method made of one log.
struct SlamRecord {
  SlamMethod method = SlamMethod::kSpectral;
  /// In the frame of its first alignment, the ground truth's if there is one; without a ground
  /// truth aligned rigidly to the run's first record, so that paths can be drawn over one another.
  SlamEstimate estimate;
  std::vector<TrajectoryError> errors;  ///< Under each alignment tried, the first the method's own.
  std::vector<double>
      error_m;  ///< Under the first alignment, one per pose; empty without ground truth.
};

/// Window lengths tried and what each predicted of ranges it had not seen.
struct WindowCurve {
  std::vector<double> lengths_s;
  std::vector<double> held_out_m;  ///< Typical error of the predicted ranges; NaN: failed outright.
  double chosen_s = 0.0;
};

/// What the refinement made of one start. All that were tried are kept, not the best alone.
struct RefinementStart {
  SlamMethod method = SlamMethod::kRefined;  ///< kRefined, …FromOdometry or …FromRandom.
  int number = 1;                            ///< Of the starts of that kind, from 1.
  double cost = 0.0;                         ///< Final; NaN: nothing came out.
  std::optional<double>
      mean_m;  ///< Error of the path under the method's alignment, with ground truth.
  int iterations = 0;
  bool converged = true;
};

/// Everything made of one log: what figures and tables need.
struct SlamRun {
  std::string id;      ///< [a-z0-9-]+: "plaza-1".
  std::string figure;  ///< Id of the figure of its paths: "fig-2b"; empty: "path-" and `id`.
  bool simulated = false;
  RangeLog log;
  std::vector<Eigen::Index> known;  ///< Landmarks whose positions some methods are given.
  std::optional<WindowCurve> windows;
  std::vector<SlamRecord> records;
  std::vector<RefinementStart> starts;  ///< Empty: none compared.
  std::optional<PublishedDrive> published;
  std::optional<UpgradeClouds> upgrade;    ///< Of SlamMethod::kSpectral, where it gave a map.
  std::optional<Fit> fit;                  ///< Of its data to the map; empty: not tested.
  std::vector<FittedRange> fitted_ranges;  ///< What the fit leaves of the ranges.
};

/// Means over random pairs of path and environment, after so many measurements.
struct ConvergencePoint {
  int steps = 0;             ///< Columns of Y.
  MeanEstimate observation;  ///< Frobenius norm of C-hat - C [boots2013, Figure 1B].
  MeanEstimate landmarks_m;  ///< Mean distance of landmarks from their true positions.
  MeanEstimate positions_m;  ///< Mean distance of the robot's positions from theirs.
  MeanEstimate sine;         ///< Largest sine of the canonical angles of the map's subspace.
  double bound = 0.0;        ///< Eq. 5's, its constant fitted at the first point.
};

/// One noise model's convergence.
struct ConvergenceCurve {
  std::string id;     ///< [a-z0-9-]+: "white", "correlated".
  std::string title;  ///< "white noise, 1 % of range".
  int landmarks = 0;  ///< As many measurements per step.
  std::vector<ConvergencePoint> points;
  double slope = 0.0;  ///< Of log observation error over log steps, by least squares.
};

/// What a mapping method [yairi2007], or the spectral map, made of one history of ranges.
struct RangeHistoryMap {
  std::optional<MethodSetting> setting;  ///< Empty: the spectral map, no landmark known.
  bool squared = false;                  ///< Of squared ranges rather than ranges.
  Points positions_m;                    ///< N x 2, by the affine map that fits all landmarks best.
  std::vector<Status> statuses;
  std::optional<Score> score;  ///< Empty if no map came out.
};

/// The mapping methods and the spectral map on the same ranges of one simulated world.
struct RangeHistoryStudy {
  Points landmarks_m;  ///< N x 2, the true positions.
  int steps = 0;
  std::vector<RangeHistoryMap> maps;  ///< Ranges first, then squared ranges; the spectral map last.
};

/// Seconds that one method took on one run; vary from run to run.
struct SlamTiming {
  std::string run;  ///< Its id.
  SlamMethod method = SlamMethod::kSpectral;
  double seconds = 0.0;
};

/// Seconds of the factorisation and upgrade; vary from run to run.
struct FactorizationCost {
  int landmarks = 0;
  long steps = 0;
  double seconds = 0.0;
};

/// What was timed of a study, its sessions apart.
struct SlamTimings {
  std::vector<SlamTiming> methods;
  std::vector<FactorizationCost> factorization;
};

/// A range-only study: a simulated example, convergence over many, and logs of real robots.
struct SlamStudy {
  SlamExperiment experiment;  ///< Of a log of one's own: its name and title alone.
  Provenance provenance;
  /// The simulated example first, if there is one, then the logs of `experiment.data` that are
  /// there.
  std::vector<SlamRun> runs;
  std::vector<ConvergenceCurve> convergence;
  std::optional<RangeHistoryStudy> histories;
  std::optional<SpaceRun> space;
};

}  // namespace mapproof
