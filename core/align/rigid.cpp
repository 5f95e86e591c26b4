#include "core/align/rigid.hpp"

#include <complex>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"

namespace mapproof {
namespace {

using Complex = std::complex<double>;

Eigen::Matrix2d turn_of(Complex unit) {
  Eigen::Matrix2d R;
  R << unit.real(), -unit.imag(), unit.imag(), unit.real();
  return R;
}

}  // namespace

SpaceMotion fit_space_motion(const SpacePoints& from, const SpacePoints& to, bool may_mirror) {
  if (from.rows() < 1 || from.rows() != to.rows())
    throw InvalidInput("an alignment needs pairs of points");
  if (!from.allFinite() || !to.allFinite()) throw InvalidInput("an alignment needs finite points");
  const Eigen::RowVector3d from_center = from.colwise().mean();
  const Eigen::RowVector3d to_center = to.colwise().mean();
  const Eigen::Matrix3d moments =
      (to.rowwise() - to_center).transpose() * (from.rowwise() - from_center);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moments, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.info() != Eigen::Success)
    throw InvalidInput("an alignment needs points whose squares are finite");
  // The last axis is flipped where only a reflection would fit better.
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

Similarity fit_similarity(const Points& from, const Points& to, Alignment alignment) {
  if (from.rows() < 1 || from.rows() != to.rows())
    throw InvalidInput("an alignment needs pairs of points");
  if (!from.allFinite() || !to.allFinite()) throw InvalidInput("an alignment needs finite points");
  if (alignment == Alignment::kNone) return {};

  // Points as complex numbers about their centres: a rotation is a factor, a reflection the
  // conjugate. The best factor has the direction of sum conj(a) b; reflected, of sum a b; the
  // longer sum fits better.
  const Eigen::RowVector2d from_center = from.colwise().mean();
  const Eigen::RowVector2d to_center = to.colwise().mean();
  Complex plain = 0.0;
  Complex mirrored = 0.0;
  double spread = 0.0;
  for (Eigen::Index i = 0; i < from.rows(); ++i) {
    const Complex a(from(i, 0) - from_center(0), from(i, 1) - from_center(1));
    const Complex b(to(i, 0) - to_center(0), to(i, 1) - to_center(1));
    plain += std::conj(a) * b;
    mirrored += a * b;
    spread += std::norm(a);
  }
  const bool is_mirrored = alignment == Alignment::kRigidWithReflection &&
                           std::abs(mirrored) > std::abs(plain) * (1.0 + 1e-12);
  const Complex sum = is_mirrored ? mirrored : plain;

  Similarity map;
  if (std::abs(sum) > 0.0) map.rotation = turn_of(sum / std::abs(sum));
  if (is_mirrored) map.rotation.col(1) *= -1.0;
  if (alignment == Alignment::kSimilarity && spread > 0.0) map.scale = std::abs(sum) / spread;
  map.offset = to_center - map.scale * from_center * map.rotation.transpose();
  return map;
}

}  // namespace mapproof
