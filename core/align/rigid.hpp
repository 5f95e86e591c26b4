#pragma once

#include <Eigen/Core>

#include "core/model/points.hpp"
#include "core/model/slam/slam.hpp"

namespace mapproof {

/// z -> rotation * z + offset, points as rows. A reflection is a rotation of determinant -1.
struct SpaceMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::RowVector3d offset = Eigen::RowVector3d::Zero();

  SpacePoints operator()(const SpacePoints& points) const {
    return (points * rotation.transpose()).rowwise() + offset;
  }
};

/// The rigid motion, or reflection where allowed, that takes `from` closest to `to` in least
/// squares [umeyama1991], in closed form. Where the points determine no rotation, one of the best.
/// @param from, to  n x 3, finite, n >= 1.
/// @throws InvalidInput if the bounds above are broken.
SpaceMotion fit_space_motion(const SpacePoints& from, const SpacePoints& to, bool may_mirror);

/// z -> scale * rotation * z + offset in space, points as rows.
struct SpaceSimilarity {
  double scale = 1.0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::RowVector3d offset = Eigen::RowVector3d::Zero();

  SpacePoints operator()(const SpacePoints& points) const {
    return (scale * points * rotation.transpose()).rowwise() + offset;
  }
};

/// The rotation and translation, and the scale if it may change, that take `from` closest to `to`
/// in least squares [umeyama1991], in closed form. Where the points determine no rotation, one of
/// the best; where those of `from` coincide, the scale is 1.
/// @param from, to  n x 3, finite, n >= 1.
/// @throws InvalidInput if the bounds above are broken.
SpaceSimilarity fit_space_similarity(const SpacePoints& from, const SpacePoints& to,
                                     bool may_scale);

/// z -> scale * rotation * z + offset, points as rows. A reflection is a rotation of determinant
/// -1.
struct Similarity {
  double scale = 1.0;
  Eigen::Matrix2d rotation = Eigen::Matrix2d::Identity();
  Eigen::RowVector2d offset = Eigen::RowVector2d::Zero();

  Points operator()(const Points& points) const {
    return (scale * points * rotation.transpose()).rowwise() + offset;
  }
};

/// The map of that type that takes `from` closest to `to` in least squares [umeyama1991], in closed
/// form. The identity for kNone.
///
/// Where the points determine no rotation, because those of one side coincide, it does not rotate
/// (and does not scale, if that is the side of `from`).
/// @param from, to  n x 2, finite, n >= 1.
/// @throws InvalidInput if the bounds above are broken.
Similarity fit_similarity(const Points& from, const Points& to, Alignment alignment);

}  // namespace mapproof
