#include "core/simulate/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/base/angle.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

/// Whether a cylinder of that radius stands on the segment from `from` to `to`.
bool cuts(const Eigen::RowVector2d& center, double radius, const Eigen::RowVector2d& from,
          const Eigen::RowVector2d& to) {
  const Eigen::RowVector2d along = to - from;
  const double share = std::clamp((center - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (from + share * along - center).squaredNorm() < radius * radius;
}

/// One column of a visibility history: what is seen from `position`.
Eigen::VectorXd seen_from(const World& world, const Eigen::RowVector2d& position,
                          const SensorOptions& options) {
  const std::vector<View> views = views_from(world, position, options);
  Eigen::VectorXd seen(std::ssize(views));
  for (std::size_t i = 0; i < views.size(); ++i)
    seen(static_cast<Eigen::Index>(i)) = views[i] == View::kVisible ? 1.0 : 0.0;
  return seen;
}

Eigen::VectorXd measured_from(const World& world, const Path& path, Eigen::Index step,
                              const SensorOptions& options) {
  const Eigen::RowVector2d position = path.positions_m.row(step);
  if (options.sensor == Sensor::kVisibility) return seen_from(world, position, options);

  const Points offsets = world.landmarks_m.rowwise() - position;
  if (options.sensor == Sensor::kRange) return offsets.rowwise().norm();
  Eigen::VectorXd bearings(offsets.rows());
  for (Eigen::Index i = 0; i < offsets.rows(); ++i)
    bearings(i) = wrapped(std::atan2(offsets(i, 1), offsets(i, 0)) - path.headings_rad(step));
  return bearings;
}

double disturbed(double value, const SensorOptions& options, Random& random) {
  if (options.noise > 0.0) switch (options.sensor) {
      case Sensor::kVisibility:
        value = random.uniform() < options.noise ? 1.0 - value : value;
        break;
      case Sensor::kBearing:
        value = wrapped(value + options.noise * random.normal());
        break;
      case Sensor::kRange:
        value = std::max(0.0, value + options.noise * random.normal());
        break;
    }
  const bool lost = options.dropout_share > 0.0 && random.uniform() < options.dropout_share;
  return lost ? kNaN : value;
}

}  // namespace

ObservationHistory observe(const World& world, const Path& path, const SensorOptions& options,
                           Random& random) {
  const Eigen::Index M = world.landmarks_m.rows();
  const Eigen::Index N = path.positions_m.rows();
  ObservationHistory history{
      .sensor = options.sensor, .names = landmark_names(M), .values = Eigen::MatrixXd(M, N)};
  const bool is_limited = options.reach_m > 0.0 && options.sensor != Sensor::kVisibility;
  for (Eigen::Index t = 0; t < N; ++t) {
    const Eigen::VectorXd measured = measured_from(world, path, t, options);
    for (Eigen::Index i = 0; i < M; ++i)
      history.values(i, t) = disturbed(measured(i), options, random);
    if (!is_limited) continue;
    const Eigen::RowVector2d position = path.positions_m.row(t);
    for (Eigen::Index i = 0; i < M; ++i)
      if ((world.landmarks_m.row(i) - position).norm() > options.reach_m)
        history.values(i, t) = kNaN;
  }
  return history;
}

double visibility_reach(const World& world, const SensorOptions& options) {
  return world.landmark_diameter_m / 2.0 /
         std::sin(std::min(options.visual_angle_rad, std::numbers::pi) / 2.0);
}

std::vector<View> views_from(const World& world, const Eigen::RowVector2d& position,
                             const SensorOptions& options) {
  const double radius = world.landmark_diameter_m / 2.0;
  const double reach = visibility_reach(world, options);
  const Eigen::VectorXd distances = (world.landmarks_m.rowwise() - position).rowwise().norm();
  std::vector<Eigen::Index> near;
  for (Eigen::Index i = 0; i < distances.size(); ++i)
    if (distances(i) <= reach) near.push_back(i);

  std::vector<View> views(static_cast<std::size_t>(distances.size()), View::kOutOfReach);
  for (const Eigen::Index i : near) {
    const bool hidden =
        options.occlusion && std::ranges::any_of(near, [&](Eigen::Index j) {
          return j != i && distances(j) < distances(i) &&
                 cuts(world.landmarks_m.row(j), radius, position, world.landmarks_m.row(i));
        });
    views[static_cast<std::size_t>(i)] = hidden ? View::kHidden : View::kVisible;
  }
  return views;
}

Occlusion count_occlusion(const World& world, const Path& path, const SensorOptions& options) {
  Occlusion count;
  for (Eigen::Index t = 0; t < path.positions_m.rows(); ++t)
    for (const View view : views_from(world, path.positions_m.row(t), options)) {
      if (view != View::kOutOfReach) ++count.within_reach;
      if (view == View::kHidden) ++count.hidden;
    }
  return count;
}

std::vector<std::string> landmark_names(Eigen::Index count) {
  std::vector<std::string> names;
  for (Eigen::Index i = 1; i <= count; ++i) names.push_back(fmt::format("L{}", i));
  return names;
}

}  // namespace mapproof
