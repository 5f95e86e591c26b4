#pragma once

#include <vector>

#include "core/model/slam_study.hpp"
#include "core/range_slam/factors/windowed_ranges.hpp"

namespace mapproof {

/// One window length that was tried.
struct WindowTrial {
  double length_s = 0.0;
  double range_scale = 1.0;  ///< Of range_scale_of().
  double error_m = 0.0;  ///< Mean absolute error of ranges held out; NaN: too many are not told.
  double covered = 0.0;  ///< Share of the times asked for that every landmark is told at.
};

/// A window length chosen by what it predicts, without ground truth.
struct WindowSearch {
  WindowOptions options;
  std::vector<WindowTrial> trials;  ///< By descending length.
  bool all_covered = true;          ///< False: no length tells all times; the best of those that
                                    ///< tell the most was taken.
};

/// Tries lengths from all the time down by factors of sqrt(2), and takes the one of least error of
/// held-out ranges among those that cover the most times. Held out, in five turns, are blocks of
/// consecutive readings of one landmark, a sixth of a window long, so that a window has to carry a
/// prediction over a gap as it has to in the data.
/// @param path    Dead-reckoned.
/// @param time_s  Ascending, at least 2: the times that are to be covered.
/// @throws InvalidInput if a bound is broken.
/// @note O(R + N T) time a length, some 15 of them.
WindowSearch choose_window(const std::vector<LandmarkReadings>& readings, const Trajectory& path,
                           const Eigen::VectorXd& time_s);

/// The lengths and errors of the trials, for records.
WindowCurve summary(const WindowSearch& search);

}  // namespace mapproof
