#pragma once

#include <optional>

#include "core/experiment/slam_run.hpp"
#include "core/range_slam/factors/windowed_ranges.hpp"

namespace mapproof {

/// The methods on one log; what several of them start from is computed once.
class SlamEstimates {
 public:
  /// Both must outlive it.
  SlamEstimates(const RangeLog& log, const SlamRunOptions& options);

  /// What a method makes of the log, in whatever frame; kFailed where it cannot.
  SlamEstimate estimate(SlamMethod method);

  /// The refinement from random landmarks, of that number from 1.
  SlamEstimate refined_from_random(int number);

  /// Covariances of the landmarks of the spectral map that estimate() made last, by a bootstrap
  /// over windows; none where there is no such map.
  std::vector<Eigen::Matrix2d> landmark_covariances(SlamMethod method,
                                                    const SlamEstimate& estimate) const;

  /// Makes what a method starts from, so that it is not timed with it.
  void prepare(SlamMethod method);

  /// The window lengths tried; empty without odometry.
  std::optional<WindowCurve> windows() const;

  /// Some of the states that the metric upgrade of the last map without known landmarks and heading
  /// was fitted to; empty if there is none.
  const std::optional<UpgradeClouds>& upgrade() const { return upgrade_; }

 private:
  SlamEstimate solve(SlamMethod method);
  SlamEstimate spectral(bool with_known, bool with_heading);
  SlamEstimate filtered() const;
  SlamEstimate refined(const SlamEstimate& start, bool estimate_scale) const;
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
};

}  // namespace mapproof
