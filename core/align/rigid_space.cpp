#include "core/align/rigid_space.hpp"

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"

namespace mapproof {

SpaceMotion fit_space_motion(const SpacePoints& from, const SpacePoints& to, bool may_mirror) {
  if (from.rows() < 1 || from.rows() != to.rows())
    throw InvalidInput("an alignment needs pairs of points");
  if (!from.allFinite() || !to.allFinite()) throw InvalidInput("an alignment needs finite points");
  const Eigen::RowVector3d from_center = from.colwise().mean();
  const Eigen::RowVector3d to_center = to.colwise().mean();
  const Eigen::Matrix3d moments =
      (to.rowwise() - to_center).transpose() * (from.rowwise() - from_center);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moments, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.info() != Eigen::Success) throw InvalidInput("an alignment needs points whose squares are finite");
  // The last axis is turned where only a mirror would fit better.
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  const double determinant = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  const Eigen::Vector3d& s = svd.singularValues();
  const bool is_flat = s(2) <= 1e-12 * s(0);
  if (determinant < 0.0 && (!may_mirror || is_flat)) signs(2) = -1.0;
  SpaceMotion motion;
  motion.rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  motion.offset = to_center - from_center * motion.rotation.transpose();
  return motion;
}

}  // namespace mapproof
