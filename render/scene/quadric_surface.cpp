#include "render/scene/quadric_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

namespace mapproof {
namespace {

constexpr int kRings = 24;
constexpr int kRays = 72;
constexpr int kLineRings = 4;
constexpr int kLineRays = 8;
constexpr double kBeyond = 1.06;     // The sheet's edge, of the farthest point.
constexpr double kFarthestSheet = 10.0;   // A point of the sheet this far out, in sizes of the cloud,
                                     // is none.
constexpr double kStraight = 1e-12;  // A curvature below this share of the largest is none.

/// A quadric as heights over a plane through the points' mean: the small root of a square equation,
/// which is the near side of an ellipsoid and all of a paraboloid.
class Sheet {
 public:
  explicit Sheet(const QuadricPoints& cloud) : Q_(cloud.Q), center_(cloud.points.colwise().mean()) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
        Eigen::Matrix3d(Q_.topLeftCorner<3, 3>()));
    Eigen::Index weakest = 0;
    solver.eigenvalues().cwiseAbs().minCoeff(&weakest);
    axis_ = solver.eigenvectors().col(weakest);
    const double most = solver.eigenvalues().cwiseAbs().maxCoeff();
    for (Eigen::Index k = 0, side = 0; k < 3; ++k) {
      if (k == weakest) continue;
      const double curvature = std::abs(solver.eigenvalues()(k));
      curved_ = curved_ && curvature > kStraight * most;
      across_.col(side++) = solver.eigenvectors().col(k) / std::sqrt(std::max(curvature, 1e-300));
    }
    if (!curved_) return;
    for (const auto& point : cloud.points.rowwise()) {
      const Eigen::Vector3d offset = point.transpose() - center_;
      const double a = offset.dot(across_.col(0)) / across_.col(0).squaredNorm();
      const double b = offset.dot(across_.col(1)) / across_.col(1).squaredNorm();
      reach_ = std::max(reach_, kBeyond * std::hypot(a, b));
      size_ = std::max(size_, offset.norm());
    }
  }

  bool exists() const { return curved_ && reach_ > 0.0 && std::isfinite(reach_); }

  /// At a share of the reach from the middle; NaN where the quadric does not reach.
  Point3 at(double share, double angle) const {
    const Point3 foot =
        center_ +
        share * reach_ * (std::cos(angle) * across_.col(0) + std::sin(angle) * across_.col(1));
    const Eigen::Vector4d from(foot.x(), foot.y(), foot.z(), 1.0);
    const Eigen::Vector4d along(axis_.x(), axis_.y(), axis_.z(), 0.0);
    const double a = along.dot(Q_ * along), b = 2.0 * along.dot(Q_ * from), c = from.dot(Q_ * from);
    const double root = std::sqrt(b * b - 4.0 * a * c);
    const Point3 point = foot - 2.0 * c / (b + std::copysign(root, b)) * axis_;
    return (point - center_).norm() <= kFarthestSheet * size_ ? point : Point3::Constant(NAN);
  }

 private:
  Eigen::Matrix4d Q_;
  Point3 center_, axis_;
  Eigen::Matrix<double, 3, 2> across_;
  bool curved_ = true;
  double reach_ = 0.0;
  double size_ = 0.0;  ///< The farthest point's distance from the middle.
};

double angle_of(int ray, int rays) { return 2.0 * std::numbers::pi * ray / rays; }

void add_line(Rods& lines, const Point3& from, const Point3& to) {
  if (!from.allFinite() || !to.allFinite()) return;
  lines.from.push_back(from);
  lines.to.push_back(to);
}

/// The sheet's points that exist, and triangles between them.
Surface surface_of(const Sheet& sheet) {
  Surface surface{.smooth = true};
  std::vector<std::int64_t> index;
  for (int i = 0; i <= kRings; ++i)
    for (int j = 0; j < kRays; ++j) {
      const Point3 point = sheet.at(double(i) / kRings, angle_of(j, kRays));
      index.push_back(point.allFinite() ? std::ssize(surface.points) : -1);
      if (point.allFinite()) surface.points.push_back(point);
    }
  const auto add = [&](int a, int b, int c) {
    const std::array corners{index[a], index[b], index[c]};
    if (std::ranges::min(corners) < 0) return;
    surface.triangles.push_back({static_cast<std::uint32_t>(corners[0]),
                                 static_cast<std::uint32_t>(corners[1]),
                                 static_cast<std::uint32_t>(corners[2])});
  };
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kRays; ++j) {
      const int next = (j + 1) % kRays;
      const int a = i * kRays + j, b = (i + 1) * kRays + j;
      const int c = (i + 1) * kRays + next, d = i * kRays + next;
      add(a, b, c);
      if (i > 0) add(a, c, d);  // The innermost ring is one point.
    }
  return surface;
}

}  // namespace

QuadricSurface quadric_surface(const QuadricPoints& cloud) {
  QuadricSurface found;
  const Sheet sheet(cloud);
  if (!sheet.exists()) return found;
  found.sheet = surface_of(sheet);
  for (int ring = 1; ring <= kLineRings; ++ring)
    for (int j = 0; j < kRays; ++j)
      add_line(found.lines, sheet.at(double(ring) / kLineRings, angle_of(j, kRays)),
               sheet.at(double(ring) / kLineRings, angle_of(j + 1, kRays)));
  for (int ray = 0; ray < kLineRays; ++ray)
    for (int i = 0; i < kRings; ++i)
      add_line(found.lines, sheet.at(double(i) / kRings, angle_of(ray, kLineRays)),
               sheet.at(double(i + 1) / kRings, angle_of(ray, kLineRays)));
  return found;
}

Eigen::VectorXd quadric_distances(const QuadricPoints& cloud) {
  Eigen::MatrixX4d lifted(cloud.points.rows(), 4);
  lifted << cloud.points, Eigen::VectorXd::Ones(cloud.points.rows());
  const Eigen::MatrixX4d half_gradient = lifted * cloud.Q;
  const Eigen::ArrayXd values = half_gradient.cwiseProduct(lifted).rowwise().sum().array();
  const Eigen::ArrayXd slopes = 2.0 * half_gradient.leftCols<3>().rowwise().norm().array();
  return (slopes > 0.0).select(values.abs() / slopes, 0.0);
}

}  // namespace mapproof
