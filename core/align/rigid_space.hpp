#pragma once

#include <Eigen/Core>

#include "core/model/space_points.hpp"

namespace mapproof {

/// z -> rotation * z + offset, points as rows. A mirror is a rotation of determinant -1.
struct SpaceMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::RowVector3d offset = Eigen::RowVector3d::Zero();

  SpacePoints operator()(const SpacePoints& points) const {
    return (points * rotation.transpose()).rowwise() + offset;
  }
};

/// The motion, or mirror where it may, that takes `from` closest to `to` in least squares
/// [umeyama1991], in closed form. Where the points fix no turn, one of the best.
/// @param from, to  n x 3, finite, n >= 1.
/// @throws InvalidInput if the bounds above are broken.
SpaceMotion fit_space_motion(const SpacePoints& from, const SpacePoints& to, bool may_mirror);

}  // namespace mapproof
