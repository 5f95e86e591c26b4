#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// How far the landmarks' positions would move if the same steps were walked and observed again.
struct MapUncertainty {
  /// M, of the map's unit squared; NaN where too few replicates placed the landmark.
  std::vector<Eigen::Matrix2d> covariances;
  /// Of the ellipse: (x - position)' C^-1 (x - position) up to this.
  double squared_radius = 0.0;
  double confidence = 0.95;  ///< That the ellipse holds the mean of such maps.
  int replicates = 0;        ///< Drawn.
  int maps = 0;              ///< Of them, those that gave a map that could be aligned.
  int block_steps = 0;       ///< Consecutive steps that were drawn together.

  bool operator==(const MapUncertainty&) const = default;
};

/// An ellipse about a landmark's position, in the map's unit.
struct Ellipse {
  double a = 0.0;             ///< The longer half axis.
  double b = 0.0;             ///< The shorter.
  double rotation_rad = 0.0;  ///< Of `a` from the x axis, counter-clockwise, in (-pi/2, pi/2].
};

/// The ellipse of the points whose distance by that covariance is `radius`.
/// @param C  Symmetric; not positive semidefinite: the axis is 0 there.
Ellipse ellipse_of(const Eigen::Matrix2d& C, double radius);

/// The confidence ellipse of a landmark; empty where its covariance is not known.
std::optional<Ellipse> confidence_ellipse(const MapUncertainty& uncertainty, Eigen::Index landmark);

/// Whether a point is in the confidence ellipse of a landmark about a position; not where its
/// covariance is not known.
bool covers(const MapUncertainty& uncertainty, Eigen::Index landmark,
            const Eigen::RowVector2d& position, const Eigen::RowVector2d& point);

}  // namespace mapproof
