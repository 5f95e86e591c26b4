#include "core/align/space_similarity.hpp"

#include "core/align/rigid.hpp"

namespace mapproof {

SpaceSimilarity fit_space_similarity(const SpacePoints& from, const SpacePoints& to,
                                     bool may_scale) {
  const SpaceMotion motion = fit_space_motion(from, to, false);
  SpaceSimilarity map{.rotation = motion.rotation, .offset = motion.offset};
  if (!may_scale) return map;
  const Eigen::RowVector3d from_center = from.colwise().mean();
  const Eigen::RowVector3d to_center = to.colwise().mean();
  const SpacePoints a = from.rowwise() - from_center;
  const SpacePoints b = to.rowwise() - to_center;
  const double spread = a.squaredNorm();
  if (!(spread > 0.0)) return map;
  // The best rotation does not depend on the scale; the best scale is a regression through 0.
  map.scale = (a * motion.rotation.transpose()).cwiseProduct(b).sum() / spread;
  map.offset = to_center - map.scale * from_center * map.rotation.transpose();
  return map;
}

}  // namespace mapproof
