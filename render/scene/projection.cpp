#include "render/scene/projection.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "render/base/span.hpp"

namespace mapproof {
namespace {

constexpr double kAngle_rad = 0.45;  // Of fitted perspective cameras: little distortion.
constexpr int kRounds = 12;          // Each moves the image's middle nearer to the points'.

/// Middle and extent of the points in the image.
struct Extent {
  Span x, y;
};

Extent extent_of(const Projection& projection, std::span<const Point3> points) {
  Extent extent;
  for (const Point3& point : points) {
    const Point at = projection(point);
    extent.x.see(at.x);
    extent.y.see(at.y);
  }
  return extent;
}

/// The least distance from the target, not below `least`, at which no point is outside the share of
/// the image.
double distance_for(std::span<const Point3> points, const Camera& camera, double share,
                    double least) {
  const Projection projection(camera);
  const Point3 back = (camera.eye - camera.target).normalized();
  const double slope_y = share * std::tan(camera.angle_rad / 2.0),
               slope_x = slope_y * camera.aspect;
  double distance = least;
  for (const Point3& point : points) {
    const Point3 offset = point - camera.target;
    const double near = offset.dot(back);
    distance = std::max({distance, near + std::abs(offset.dot(projection.right())) / slope_x,
                         near + std::abs(offset.dot(projection.upward())) / slope_y});
  }
  return distance;
}

}  // namespace

Projection::Projection(const Camera& camera)
    : eye_(camera.eye),
      forward_((camera.target - camera.eye).normalized()),
      right_(forward_.cross(camera.up).normalized()),
      up_(right_.cross(forward_)),
      parallel_(camera.parallel),
      half_(camera.parallel ? camera.height / 2.0 : std::tan(camera.angle_rad / 2.0)) {}

double Projection::units_per_length(const Point3& position) const {
  if (parallel_) return 1.0 / half_;
  const double ahead = depth(position);
  return ahead > 0.0 ? 1.0 / (half_ * ahead) : kNaN;
}

Point Projection::operator()(const Point3& position) const {
  const double scale = units_per_length(position);
  const Point3 offset = position - eye_;
  return {offset.dot(right_) * scale, offset.dot(up_) * scale};
}

double Projection::size_at(const Point3& position, double length) const {
  return length * units_per_length(position);
}

Camera fitted_camera(std::span<const Point3> points, const Point3& from, bool parallel,
                     double aspect, double margin) {
  if (points.empty()) throw InvalidInput("fitted_camera: no points");
  Point3 low = points[0], high = points[0];
  for (const Point3& point : points) low = low.cwiseMin(point), high = high.cwiseMax(point);
  // One point has the size that single precision tells apart; at the origin, any will do.
  const double farthest = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
  const double least = 1e-6 * (farthest > 0.0 ? farthest : 1.0);
  const double size = std::max((high - low).norm(), least), least_distance = 1e-3 * size;
  const Point3 back = from.normalized();
  Camera camera{.target = (low + high) / 2.0,
                .up = std::abs(back.z()) > 0.999 ? Point3::UnitY() : Point3::UnitZ(),
                .parallel = parallel,
                .angle_rad = kAngle_rad,
                .aspect = aspect};
  const double share = 1.0 - margin;
  camera.eye = camera.target + back * (3.0 * size);
  for (int round = 0; round < kRounds; ++round) {
    if (!parallel)
      camera.eye = camera.target + back * distance_for(points, camera, share, least_distance);
    const Projection projection(camera);
    const Extent extent = extent_of(projection, points);
    const double unit = 1.0 / projection.size_at(camera.target, 1.0);
    const Point3 shift = projection.right() * ((extent.x.low + extent.x.high) / 2.0 * unit) +
                         projection.upward() * ((extent.y.low + extent.y.high) / 2.0 * unit);
    camera.target += shift;
    camera.eye += shift;
  }
  if (parallel) {
    const Extent extent = extent_of(Projection(camera), points);
    const double half = std::max((extent.y.high - extent.y.low) / 2.0,
                                 (extent.x.high - extent.x.low) / (2.0 * aspect));
    camera.height *= std::max(half, least_distance) / share;
  } else {
    camera.eye = camera.target + back * distance_for(points, camera, share, least_distance);
  }
  return camera;
}

Camera tight_camera(std::span<const Point3> points, const Point3& from, bool parallel,
                    double aspect) {
  constexpr double kNarrowest = 0.9, kWidest = 2.6;
  const Projection project(fitted_camera(points, from, parallel, aspect));
  const Extent extent = extent_of(project, points);
  const double tight =
      (extent.x.high - extent.x.low) / std::max(extent.y.high - extent.y.low, 1e-9);
  return fitted_camera(points, from, parallel, std::clamp(tight, kNarrowest, kWidest));
}

}  // namespace mapproof
