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

/// One column of a history.
/// @param sight  Used for visibility alone.
Eigen::VectorXd measured_from(const World& world, const Path& path, Eigen::Index step,
                              const SensorOptions& options, const Sight& sight) {
  const Eigen::RowVector2d position = path.positions_m.row(step);
  if (options.sensor == Sensor::kVisibility) {
    Eigen::VectorXd seen = Eigen::VectorXd::Zero(world.landmarks_m.rows());
    for (const Eigen::Index i : sight.visible(position)) seen(i) = 1.0;
    return seen;
  }

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
  const Sight sight(world, options);
  for (Eigen::Index t = 0; t < N; ++t) {
    const Eigen::VectorXd measured = measured_from(world, path, t, options, sight);
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

Sight::Sight(const World& world, const SensorOptions& options)
    : world_(world),
      occlusion_(options.occlusion),
      reach_m_(visibility_reach(world, options)),
      grid_(world.landmarks_m, world.side_m, reach_m_) {}

std::vector<std::pair<Eigen::Index, View>> Sight::views(const Eigen::RowVector2d& position) const {
  std::vector<std::pair<Eigen::Index, double>> near;
  grid_.any_near(position.x(), position.y(), reach_m_, [&](Eigen::Index i) {
    const double distance = (world_.landmarks_m.row(i) - position).norm();
    if (distance <= reach_m_) near.emplace_back(i, distance);
    return false;
  });
  std::ranges::sort(near);

  const double radius = world_.landmark_diameter_m / 2.0;
  std::vector<std::pair<Eigen::Index, View>> views;
  for (const auto& [i, distance] : near) {
    const auto hides = [&](const std::pair<Eigen::Index, double>& other) {
      return other.first != i && other.second < distance &&
             cuts(world_.landmarks_m.row(other.first), radius, position,
                  world_.landmarks_m.row(i));
    };
    views.emplace_back(
        i, occlusion_ && std::ranges::any_of(near, hides) ? View::kHidden : View::kVisible);
  }
  return views;
}

std::vector<Eigen::Index> Sight::visible(const Eigen::RowVector2d& position) const {
  std::vector<Eigen::Index> seen;
  for (const auto& [i, view] : views(position))
    if (view == View::kVisible) seen.push_back(i);
  return seen;
}

std::vector<View> views_from(const World& world, const Eigen::RowVector2d& position,
                             const SensorOptions& options) {
  std::vector<View> views(static_cast<std::size_t>(world.landmarks_m.rows()), View::kOutOfReach);
  for (const auto& [i, view] : Sight(world, options).views(position))
    views[static_cast<std::size_t>(i)] = view;
  return views;
}

Occlusion count_occlusion(const World& world, const Path& path, const SensorOptions& options) {
  Occlusion count;
  const Sight sight(world, options);
  for (Eigen::Index t = 0; t < path.positions_m.rows(); ++t)
    for (const auto& [i, view] : sight.views(path.positions_m.row(t))) {
      ++count.within_reach;
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
