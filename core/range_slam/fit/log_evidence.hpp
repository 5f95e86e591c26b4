#pragma once

#include <vector>

#include "core/model/fit.hpp"
#include "core/model/range_log.hpp"
#include "core/range_slam/fit/log_problem.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

// What a log and a fit show beside the hypotheses of fit_log().

/// Times without odometry, longer than ten times its median step.
std::vector<OdometryGap> gaps_by_stamps(const RangeLog& log);

/// The times at which gaps begin and end, in ascending order.
std::vector<double> breaks_of(const std::vector<OdometryGap>& gaps);

/// The longest runs of motions that are exactly zero, of ten or more; as gaps. At most `most`.
std::vector<OdometryGap> frozen_stretches(const RangeLog& log, std::size_t most);

/// Of fault-free logs, with a third to three times the usual noise, at most 6 %; of logs whose
/// ranges are 15 s late, 15 % and more. Ranges alone may fit a path: odometry is what the clock
/// stands out by.
inline constexpr double kOdometryErrorBound_percent = 10.0;

/// How far the robot moved otherwise than the odometry reports: the median, over the motions
/// between key poses, of the error over the way, in percent.
double odometry_error_percent(const LogProblem& problem, const LogState& state);

/// How much the variance of a mean of residuals grows through their dependence in time, >= 1:
/// 1 + 2 sum of the correlations of each landmark's residuals, with Bartlett's
/// weights [bartlett1950].
double inflation_of(const LogProblem& problem, const LogProblem::Fit& fit);

/// Tests of the residuals by themselves: all, of each landmark, over time, over range.
std::vector<FitTest> residual_tests(const RangeLog& log, const LogProblem& problem,
                                    const LogProblem::Fit& fit, double inflation);

/// Positions of the robot at the ranges of a problem: R x 2.
Points range_positions(const LogProblem& problem, const LogState& state);

/// The position from which a landmark's ranges fit best, the path held: by linear least squares of
/// the squared ranges and robust steps. NaN: fewer than three ranges.
/// @param rows  Of problem.ranges().
Eigen::Vector2d located(const LogProblem& problem, const Points& positions_m,
                        const std::vector<std::size_t>& rows, const LogProblem::Fit& fit,
                        const Eigen::Vector2d& start);

/// Landmarks whose mirror image about the robot's way fits as well.
std::vector<Eigen::Index> mirrored_landmarks(const LogProblem& problem, const LogProblem::Fit& fit,
                                             double inflation);

/// Given positions of landmarks compared with a free map, after a rigid fit.
struct KnownLandmarksTest {
  double statistic = 0.0;
  double bound = 1.0;
  double scale_statistic = 0.0;  ///< Of the scale; 0 with fewer than four positions.
  double scale_bound = 1.0;
  std::vector<FitCause> causes;  ///< By rows of landmarks as names: filled in by the caller.
  std::vector<std::vector<Eigen::Index>> rows;  ///< As many: the landmarks of each cause.
};
/// The errors of a free map and of given positions.
struct KnownLandmarksNoise {
  Eigen::MatrixXd covariance;   ///< 2N x 2N, of the map free of the frame.
  double survey_sigma_m = 0.0;  ///< Of a given coordinate.
  double scale_sigma = 0.0;     ///< Of the scale of odometry, a share: the map has that scale.
};

/// With four given positions or more, their scale is tested as well: if it alone is off, odometry
/// is too long or too short, and no position is named.
KnownLandmarksTest known_landmarks_test(const KnownLandmarks& known,
                                        const std::vector<Eigen::Vector2d>& landmarks_m,
                                        const KnownLandmarksNoise& noise);

}  // namespace mapproof
