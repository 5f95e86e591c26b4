#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

struct EllipseMapSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::vector<std::string> names;     ///< M.
  Points ground_truth_m;              ///< M x 2.
  std::vector<Points> estimates_m;    ///< One a run, M x 2; NaN rows: not mapped.
  std::vector<Eigen::Index> anchors;  ///< Rows.
  std::vector<std::string> record_ids;
};

/// Fewer estimates show no ellipse but themselves. The ellipse of a known covariance, which is
/// drawn, is too short where the covariance is that of n estimates: by Hotelling's T^2 the squared
/// half axes have 2 (n - 1) / (n - 2) F(2, n - 2) in place of chi-squared(2), so that the ellipse
/// would have to be 2.1 times as long of 5 estimates and 1.3 times of 10.
inline constexpr int kFewestForEllipse = 10;

/// Mean and covariance of one landmark's estimates, as an ellipse.
struct ScatterEllipse {
  int runs = 0;  ///< That gave the landmark a position.
  Eigen::RowVector2d mean_m = Eigen::RowVector2d::Constant(0.0);  ///< NaN without runs.
  double a_m = 0.0;  ///< Half axes, a >= b; NaN below kFewestForEllipse runs.
  double b_m = 0.0;
  double rotation_rad = 0.0;  ///< Of a from the x axis.
};

/// The ellipse that holds 95 % of a normal scatter with the mean and the covariance (n - 1) of the
/// rows `row` of all runs.
ScatterEllipse scatter_ellipse(const std::vector<Points>& estimates_m, Eigen::Index row);

/// "mean positions 0.045 m off, 95 % ellipses of 0.12 m (half the long axis)": means over the
/// landmarks with an ellipse, anchors apart; if none has one "mean positions 0.045 m off, estimates
/// 0.06 m from their mean", over those with two runs; else empty.
std::string scatter_finding(const EllipseMapSpec& spec);

/// Where the runs of one layout put each landmark: the mean, joined to the ground truth, and the 95
/// % ellipse of the scatter or, of few runs, each estimate, joined to the mean.
/// @throws InvalidInput if parts disagree in size, the ground truth is not finite, or positions are
/// infinite.
Figure ellipse_map_figure(const EllipseMapSpec& spec);

}  // namespace mapproof
