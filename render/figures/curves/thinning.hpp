#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/model/range_log.hpp"

namespace mapproof {

/// A line of few points for the eye; NaN points break it.
struct ThinLine {
  std::vector<double> x;
  std::vector<double> y;
};

/// The longest step of time that is not a pause: ten usual ones; infinite where there is none.
double longest_step(const Eigen::VectorXd& time_s);

/// A path with the fewest points that Douglas and Peucker's rule leaves: what is left out lies
/// within `tolerance_m` of the line [douglas1973]. Positions that are not numbers, and pauses of
/// more than ten usual steps of time, break it.
/// @throws InvalidInput if times and positions differ in number, or the tolerance is negative.
/// @note O(T log T) time as a rule, O(T^2) at worst.
ThinLine thin_path(const Trajectory& path, double tolerance_m);

/// A curve over time as `bins` equal pieces of time show it: the first, least, greatest and last
/// value of each, so that no peak is lost. Values that are not numbers break it.
/// @param time_s  Ascending, as many as values.
/// @throws InvalidInput if their numbers differ or bins < 1.
ThinLine thin_curve(const Eigen::VectorXd& time_s, const std::vector<double>& values, int bins);

/// The median of a curve in `bins` equal pieces of time, at their middles: what it is as a rule,
/// where all of it would be a barcode. Pieces without a number break it; with fewer than two values
/// a piece, the values themselves.
/// @throws InvalidInput as above.
ThinLine median_curve(const Eigen::VectorXd& time_s, const std::vector<double>& values, int bins);

}  // namespace mapproof
