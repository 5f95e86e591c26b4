#include "render/scene/quadric_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/scene/cloud_box.hpp"
#include "render/scene/room.hpp"

namespace mapproof {
namespace {

constexpr int kRings = 24;
constexpr int kRays = 72;
constexpr int kLineRings = 4;
constexpr int kLineRays = 8;
constexpr double kBeyond = 1.06;         // The sheet's edge, of the farthest point.
constexpr double kFarthestSheet = 10.0;  // A point of the sheet this far out, in sizes of the
                                         // cloud, is none.
constexpr double kStraight = 1e-12;      // A curvature below this share of the largest is none.

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
    return (point - center_).norm() <= kFarthestSheet * size_ ? point : Point3::Constant(kNaN);
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

constexpr double kQuadricAspect = 1.25;
const Point3 kToQuadricCamera{0.55, -1.0, 0.62};
constexpr double kTallness = 0.6;  // Height of the drawn paraboloid, of its width.

double height_of(const SpacePoints& points) {
  return points.col(2).maxCoeff() - points.col(2).minCoeff();
}

double width_of(const SpacePoints& points) {
  return (points.leftCols<2>().colwise().maxCoeff() - points.leftCols<2>().colwise().minCoeff())
      .maxCoeff();
}

/// The cloud with its coordinates multiplied by `scale`, and the quadric through it.
QuadricPoints scaled(const QuadricPoints& cloud, const Eigen::Vector3d& scale) {
  Eigen::Vector4d back = Eigen::Vector4d::Ones();
  back.head<3>() = scale.cwiseInverse();
  return {cloud.points * scale.asDiagonal(), back.asDiagonal() * cloud.Q * back.asDiagonal()};
}

/// Above zero if the sheet's points are higher than its first one, the middle, on the whole.
double rise_of(const Surface& sheet) {
  double sum = 0.0;
  for (const Point3& point : sheet.points) sum += point.z() - sheet.points[0].z();
  return sum;
}

/// Coordinates of the plane of scale 1 have no sign of their own: the bowl is rotated upright.
QuadricPoints upright(const QuadricPoints& cloud) {
  if (rise_of(quadric_surface(cloud).sheet) >= 0.0) return cloud;
  return scaled(cloud, Eigen::Vector3d::Constant(-1.0));
}

double root_mean_square(const Eigen::VectorXd& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

class QuadricScene {
 public:
  explicit QuadricScene(const QuadricSceneSpec& spec) : spec_(spec) {
    scene_.id = spec.id;
    scene_.title = spec.title;
    scene_.record_ids = spec.record_ids;
    scene_.lights = usual_lights();
  }

  Scene make() {
    const QuadricPoints& after = spec_.clouds.after;
    const double height = height_of(after.points);
    const double lift = kTallness * width_of(after.points) / height;
    add_view(upright(spec_.clouds.before), 1.0, "Before the upgrade", {"1st", "2nd", "3rd"});
    add_view(scaled(after, {1.0, 1.0, lift}), lift, "After the upgrade",
             {"x [m]", "y [m]", "r\u00B2/2 [m\u00B2]"});
    describe(height);
    require_valid(scene_);
    return std::move(scene_);
  }

 private:
  /// @param lift  By which the cloud's third coordinate is multiplied.
  void add_view(const QuadricPoints& cloud, double lift, const std::string& title,
                const std::array<std::string, 3>& labels) {
    QuadricSurface quadric = quadric_surface(cloud);
    std::vector<Point3> shown = quadric.sheet.points;
    for (const auto& point : cloud.points.rowwise()) shown.emplace_back(point.transpose());
    const CloudBox box(shown);
    Shot view{.title = title,
              .camera = box.camera(kToQuadricCamera, kQuadricAspect),
              .rules = box.rules(labels)};
    view.rules[2].range = {view.rules[2].range.low / lift, view.rules[2].range.high / lift};
    const auto add = [&](Part part) {
      view.parts.push_back(scene_.parts.size());
      scene_.parts.push_back(std::move(part));
    };
    add(box.edges());
    add(points_of(cloud.points, 0.009 * box.size()));
    if (!quadric.sheet.triangles.empty()) {
      const bool is_first = scene_.views.empty();
      quadric.lines.radius = 0.0011 * box.size();
      quadric.lines.style = {.colour = ThemeColour::kSeries1, .share = 0.7, .lit = false};
      add(std::move(quadric.lines));
      quadric.sheet.label = is_first ? "fitted quadric" : "";
      quadric.sheet.style = {.colour = ThemeColour::kSeries1, .share = 0.55, .opacity = 0.4};
      add(std::move(quadric.sheet));
    }
    scene_.views.push_back(std::move(view));
  }

  Spheres points_of(const SpacePoints& points, double radius) const {
    const std::vector<Eigen::Index>& steps = spec_.clouds.steps;
    Spheres spheres{.radius = radius};
    if (scene_.views.empty()) spheres.label = "robot's states, start (dark) to end";
    spheres.tones.limits = {static_cast<double>(steps.front()), static_cast<double>(steps.back())};
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      spheres.at.emplace_back(points.row(i).transpose());
      spheres.tones.values.push_back(static_cast<double>(steps[static_cast<std::size_t>(i)]));
    }
    return spheres;
  }

  /// @param height  Of the states over the plane, after the upgrade.
  void describe(double height) {
    const UpgradeClouds& clouds = spec_.clouds;
    const double before = quadric_deviation(clouds.before);
    const SpacePoints& p = clouds.after.points;
    const Eigen::VectorXd lifted = 0.5 * p.leftCols<2>().rowwise().squaredNorm();
    const double after = root_mean_square(p.col(2) - lifted);
    scene_.notes.push_back({fmt::format("From the surface: {} % of the cloud's extent before, {} "
                                        "m\u00B2 in height after (root mean square).",
                                        significant(100.0 * before, 2), significant(after, 2)),
                            ThemeColour::kMuted});
    scene_.caption = fmt::format(
        "{}: states of {} of the path. Of their four entries the scale is divided out. Left, the "
        "whitened factor in orthonormal coordinates of the plane of scale 1, and the quadric "
        "fitted "
        "to it; right, the same after the metric upgrade has made the quadric the paraboloid of x, "
        "y and r\u00B2/2, r\u00B2 = x\u00B2 + y\u00B2, about the mean position (heights drawn to "
        "another scale).",
        spec_.name, counted(static_cast<long long>(clouds.steps.size()), "position"));
    scene_.alt = fmt::format(
        "{} coloured by time on a translucent bowl, leaning on the left and upright on the right. "
        "On the left they are {} % of the cloud's extent from the surface, on the right {} m\u00B2 "
        "of a height of {} m\u00B2 (root mean square).",
        counted(static_cast<long long>(clouds.steps.size()), "state"),
        significant(100.0 * before, 2), significant(after, 2), significant(height));
  }

  const QuadricSceneSpec& spec_;
  Scene scene_;
};

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

double quadric_deviation(const QuadricPoints& cloud) {
  const SpacePoints& at = cloud.points;
  const double extent = (at.colwise().maxCoeff() - at.colwise().minCoeff()).norm();
  return root_mean_square(quadric_distances(cloud)) / extent;
}

bool has_quadric_scene(const UpgradeClouds& clouds) {
  constexpr double kLargest = 1e6, kLeast = 1e-6, kLeastRise = 1e-3;
  const auto size = static_cast<Eigen::Index>(clouds.steps.size());
  if (size < 2 || clouds.steps.front() >= clouds.steps.back()) return false;
  for (const QuadricPoints* cloud : {&clouds.before, &clouds.after}) {
    const SpacePoints& points = cloud->points;
    if (points.rows() != size || !points.allFinite() || !cloud->Q.allFinite() ||
        points.cwiseAbs().maxCoeff() > kLargest ||
        (points.rowwise() - points.row(0)).cwiseAbs().maxCoeff() < kLeast)
      return false;
  }
  const SpacePoints& after = clouds.after.points;
  return width_of(after) > kLeast && height_of(after) > kLeast &&
         height_of(after) > kLeastRise * after.col(2).cwiseAbs().maxCoeff();
}

Scene quadric_scene(const QuadricSceneSpec& spec) {
  if (!has_quadric_scene(spec.clouds))
    throw InvalidInput("quadric_scene: two clouds of finite points, a point a step, are needed");
  return QuadricScene(spec).make();
}

}  // namespace mapproof
