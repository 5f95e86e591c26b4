#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"
#include "core/model/range_log.hpp"
#include "core/model/slam/slam_study.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// Measurements of one landmark, with the dead-reckoned positions of the robot.
struct LandmarkRanges {
  Eigen::VectorXd time_s;   ///< R, ascending.
  Points positions_m;       ///< R x 2.
  Eigen::VectorXd range_m;  ///< R, >= 0.

  Eigen::Index size() const { return time_s.size(); }
  /// Those in some rows.
  LandmarkRanges at(const std::vector<Eigen::Index>& rows) const;
};

/// Squared range to one landmark around one stretch of a path, r^2 = a^2 |p - c|^2 + an affine
/// function of p: exact where dead reckoning is, wherever the landmark is.
struct LocalRange {
  Eigen::RowVector2d center_m;   ///< c.
  double unit_m = 1.0;           ///< Spread of the positions about it.
  double squared_scale = 1.0;    ///< a^2.
  Eigen::Vector3d coefficients;  ///< On [1, (p - c) / unit], m^2.
  Eigen::Matrix3d covariance;    ///< Of the coefficients, up to the measurements' variance.

  /// r^2 at a position, m^2.
  double squared_range(const Eigen::RowVector2d& position) const;
  /// Variance of that, up to the measurements' variance.
  double variance(const Eigen::RowVector2d& position) const;
};

/// Robust fit to measurements `first` to `first + count`: iterated Huber weights, 1.5 scaled
/// medians of the residuals, over 1 / r, since the error of r^2 grows with r.
/// @param range_scale  a: measured range over distance, > 0.
/// @param count  4 or more.
/// @throws InvalidInput if there are fewer.
/// @note O(count) time per round.
LocalRange fit_local_range(const LandmarkRanges& measurements, Eigen::Index first,
                           Eigen::Index count, double range_scale);

/// What measurements determine of a^2 on their own: a weighted mean adds up.
struct ScaleEvidence {
  double squared_scale = 0.0;
  double weight = 0.0;  ///< Inverse variance, up to the measurements' variance; 0: nothing.
};

/// The same fit with a^2 free. No weight where the positions are on a line or circle.
ScaleEvidence local_scale(const LandmarkRanges& measurements, Eigen::Index first,
                          Eigen::Index count);

struct WindowOptions {
  double length_s = 0.0;     ///< Of a window, > 0.
  double range_scale = 1.0;  ///< Measured range over distance, > 0.
};

/// Squared ranges of all landmarks at common times, from measurements that never come together.
struct WindowedRanges {
  Eigen::MatrixXd Y;  ///< N x columns: 1/2 r^2 over range_scale^2, m^2.
  std::vector<Eigen::Index>
      columns;  ///< The times asked for at which every landmark is determined.
  std::vector<Eigen::Index> observed;  ///< N: at how many of the times each is determined.
};

/// Landmarks times times beyond which the matrix is refused: 400 MB, and some copies of it.
inline constexpr double kMostWindowedRanges = 5e7;

/// A sentence if so many landmarks at so many times are too many; empty if they are not.
std::string windowed_size_problem(Eigen::Index landmarks, Eigen::Index times);

/// Measurements by landmark, with positions on the path; those before its first pose or after its
/// last are left out.
/// @throws InvalidInput for ranges that check_ranges() refuses, or a path_problem().
/// @note O(T + R log T) time for R measurements.
std::vector<LandmarkRanges> ranges_by_landmark(const std::vector<RangeMeasurement>& ranges,
                                               Eigen::Index landmarks, const Trajectory& path);

/// Half squared range to one landmark at some times: in overlapping windows a regression on the
/// dead-reckoned path, and of the windows over a time the mean, by their variance and how central
/// it is.
/// @param path_m  Positions at the times.
/// @return As many as times, over range_scale^2; NaN where no window has 6 measurements.
Eigen::VectorXd windowed_half_squares(const LandmarkRanges& measurements,
                                      const Eigen::VectorXd& time_s, const Points& path_m,
                                      const WindowOptions& options);

/// The same for all landmarks.
/// @param path    Dead-reckoned.
/// @param time_s  Ascending, T of them, within the path's.
/// @throws InvalidInput if a bound is broken, or N T is above kMostWindowedRanges.
/// @note O(R + N T) time for R measurements, O(N T) memory.
WindowedRanges windowed_ranges(const std::vector<LandmarkRanges>& measurements,
                               const Trajectory& path, const Eigen::VectorXd& time_s,
                               const WindowOptions& options);

/// Scale of the ranges against odometry, from how r^2 curves along the path in windows of that
/// length; 1 where paths are too straight or round to determine it.
/// @param first_s, last_s  The time that matters.
/// @param length_s         > 0.
/// @throws InvalidInput unless times and length are finite, first_s <= last_s, and windows are at
///         most a million.
double range_scale_of(const std::vector<LandmarkRanges>& measurements, double first_s,
                      double last_s, double length_s);

/// One window length that was tried.
struct WindowCandidate {
  double length_s = 0.0;
  double range_scale = 1.0;  ///< Of range_scale_of().
  double error_m =
      0.0;  ///< Mean absolute error of held-out ranges; NaN: too many are not determined.
  double covered = 0.0;  ///< Share of the times asked for at which every landmark is determined.
};

/// A window length chosen by what it predicts, without ground truth.
struct WindowSearch {
  WindowOptions options;
  std::vector<WindowCandidate> candidates;  ///< By descending length.
  bool all_covered = true;  ///< False: no length covers all times; the best of those that
                            ///< cover the most was taken.
};

/// Tries lengths from all the time down by factors of sqrt(2), and takes the one of least error of
/// held-out ranges among those that cover the most times. Held out, in five rounds, are blocks of
/// consecutive measurements of one landmark, a sixth of a window long, so that a window has to
/// carry a prediction over missing data as it has to in the log.
/// @param path    Dead-reckoned.
/// @param time_s  Ascending, at least 2: the times that are to be covered.
/// @throws InvalidInput if a bound is broken.
/// @note O(R + N T) time a length, some 15 of them.
WindowSearch choose_window(const std::vector<LandmarkRanges>& measurements, const Trajectory& path,
                           const Eigen::VectorXd& time_s);

/// The lengths and errors of the candidates, for records.
WindowCurve summary(const WindowSearch& search);

}  // namespace mapproof
