#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/range_log.hpp"
#include "core/model/status.hpp"
#include "core/range_slam/local_regression.hpp"

namespace mapproof {

struct WindowOptions {
  double length_s = 0.0;     ///< Of a window, > 0.
  double range_scale = 1.0;  ///< Measured range over distance, > 0.
};

/// Squared ranges of all landmarks at common times, from readings that never come together.
struct WindowedRanges {
  Eigen::MatrixXd Y;                  ///< N x columns: 1/2 r^2 over range_scale^2, m^2.
  std::vector<Eigen::Index> columns;  ///< The times asked for that every landmark is told at.
  std::vector<Eigen::Index> told;     ///< N: how many of the times asked for each is told at.
};

/// Landmarks times times beyond which the matrix is refused: 400 MB, and some copies of it.
inline constexpr double kMostWindowedRanges = 5e7;

/// That so many landmarks at so many times are too many, in a sentence; empty if they are not.
std::string windowed_size_problem(Eigen::Index landmarks, Eigen::Index times);

/// Readings by landmark, with positions on the path; those before its first pose or after its last
/// are left out.
/// @throws InvalidInput for ranges that check_ranges() refuses, or a path_problem().
/// @note O(T + R log T) time for R readings.
std::vector<LandmarkReadings> readings_by_landmark(const std::vector<RangeReading>& ranges,
                                                   Eigen::Index landmarks, const Trajectory& path);

/// Half squared range to one landmark at some times: in overlapping windows a regression on the
/// dead-reckoned path, and of the windows over a time the mean, by their variance and how central
/// it is.
/// @param path_m  Positions at the times.
/// @return As many as times, over range_scale^2; NaN where no window has 6 readings.
Eigen::VectorXd windowed_half_squares(const LandmarkReadings& readings,
                                      const Eigen::VectorXd& time_s, const Points& path_m,
                                      const WindowOptions& options);

/// The same for all landmarks.
/// @param path    Dead-reckoned.
/// @param time_s  Ascending, T of them, within the path's.
/// @throws InvalidInput if a bound is broken, or N T is above kMostWindowedRanges.
/// @note O(R + N T) time for R readings, O(N T) memory.
WindowedRanges windowed_ranges(const std::vector<LandmarkReadings>& readings,
                               const Trajectory& path, const Eigen::VectorXd& time_s,
                               const WindowOptions& options);

/// Scale of the ranges against odometry, from how r^2 curves along the path in windows of that
/// length; 1 where paths are too straight or round to tell.
/// @param first_s, last_s  The time that matters.
/// @param length_s         > 0.
/// @throws InvalidInput unless times and length are finite, first_s <= last_s, and windows are at
///         most a million.
double range_scale_of(const std::vector<LandmarkReadings>& readings, double first_s, double last_s,
                      double length_s);

}  // namespace mapproof
