#include "render/scene/manifold_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "render/figures/words.hpp"
#include "render/scene/cloud_box.hpp"
#include "render/scene/room.hpp"

namespace mapproof {
namespace {

constexpr double kManifoldAspect = 1.25;  // Two views share a page.

void require_usable(const ManifoldSceneSpec& spec) {
  const Eigen::Index rows = spec.manifold.coordinates.rows();
  if (spec.truth_m.rows() != rows)
    throw InvalidInput("manifold_scene: not as many true positions as coordinates");
  if (!(spec.side_m > 0.0 && std::isfinite(spec.side_m)))
    throw InvalidInput("manifold_scene: the room's side is not a length");
  for (const auto& [a, b] : spec.manifold.edges)
    if (std::min(a, b) < 0 || std::max(a, b) >= rows)
      throw InvalidInput("manifold_scene: an edge has no landmark");
}

/// The landmarks that have coordinates, coloured by one of the two true ones.
Spheres landmarks(const ManifoldSceneSpec& spec, Eigen::Index axis, double radius) {
  Spheres spheres{
      .label = fmt::format("true {}, 0 to {} m", axis == 0 ? "x" : "y", significant(spec.side_m)),
      .radius = radius};
  spheres.tones.limits = {0.0, spec.side_m};
  for (Eigen::Index i = 0; i < spec.manifold.coordinates.rows(); ++i) {
    if (!spec.manifold.coordinates.row(i).allFinite()) continue;
    spheres.at.emplace_back(spec.manifold.coordinates.row(i).transpose());
    const double value = spec.truth_m(i, axis);
    spheres.tones.values.push_back(std::isfinite(value) ? value : NAN);
  }
  return spheres;
}

Rods graph(const ManifoldSceneSpec& spec, double radius) {
  Rods rods{.label = fmt::format("{} nearest neighbours", spec.manifold.neighbours),
            .radius = radius,
            .style = {.ink = Ink::kMuted}};
  for (const auto& [a, b] : spec.manifold.edges) {
    if (!spec.manifold.coordinates.row(a).allFinite() ||
        !spec.manifold.coordinates.row(b).allFinite())
      continue;
    rods.from.emplace_back(spec.manifold.coordinates.row(a).transpose());
    rods.to.emplace_back(spec.manifold.coordinates.row(b).transpose());
  }
  if (rods.from.empty()) rods.label.clear();
  return rods;
}

}  // namespace

bool has_manifold_scene(const ObservationManifold& manifold) {
  Eigen::Index known = 0;
  for (const auto& row : manifold.coordinates.rowwise()) known += row.allFinite();
  return known >= 2;
}

Scene manifold_scene(const ManifoldSceneSpec& spec) {
  require_usable(spec);
  Spheres by_x = landmarks(spec, 0, 1.0);
  if (by_x.at.size() < 2)
    throw InvalidInput("manifold_scene: fewer than two landmarks have coordinates");
  const CloudBox box(by_x.at);
  by_x.radius = 0.014 * box.size();
  Scene scene{.id = spec.id,
              .title = spec.title,
              .caption = spec.caption,
              .alt = fmt::format(
                  "{} in three principal coordinates of their observations, which "
                  "span {}, {} and {}; {} of the neighbour graph.",
                  counted(static_cast<long long>(by_x.at.size()), "landmark"),
                  significant(box.high.x() - box.low.x()), significant(box.high.y() - box.low.y()),
                  significant(box.high.z() - box.low.z()),
                  counted(static_cast<long long>(spec.manifold.edges.size()), "edge")),
              .record_ids = spec.record_ids,
              .lights = usual_lights()};
  scene.parts = {box.edges(), graph(spec, 0.0022 * box.size()), by_x,
                 landmarks(spec, 1, by_x.radius)};
  const std::array<double, 3>& shares = spec.manifold.shares;
  scene.notes = {
      {fmt::format("The three coordinates hold {:.0f}, {:.0f} and {:.0f} % of all spread.",
                   100.0 * shares[0], 100.0 * shares[1], 100.0 * shares[2])}};
  const Shot view{.camera = box.camera(kManifoldAspect), .rules = box.rules({"1st", "2nd", "3rd"})};
  scene.views = {view, view};
  scene.views[0].title = "By true x";
  scene.views[0].parts = {0, 1, 2};
  scene.views[1].title = "By true y";
  scene.views[1].parts = {0, 1, 3};
  require_valid(scene);
  return scene;
}

}  // namespace mapproof
