#pragma once

#include <Eigen/Core>

#include "core/model/points.hpp"

namespace mapproof {

/// z -> scale * rotation * z + offset, points as rows.
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

}  // namespace mapproof
