#include "reports/sections/figures/map_scenes.hpp"

#include <cmath>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "render/figures/maps/map.hpp"
#include "render/scene/map_scene.hpp"

namespace mapproof {
namespace {

/// The title, with the mean error of the landmarks where it states none.
std::string with_mean_error(const std::string& title, const MapRecord& map) {
  if (title.ends_with(" off")) return title;
  const MapView view = view_of(map);
  double sum_m = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < view.error_m.size(); ++i) {
    if (view.is_anchor[i] || std::isnan(view.error_m[i])) continue;
    sum_m += view.error_m[i];
    ++count;
  }
  return count == 0 ? title : title + ": " + error_text(sum_m / count) + " off";
}

}  // namespace

double error_or_infinity(const MapRecord& map) {
  return map.score && std::isfinite(map.score->mpe_m) ? map.score->mpe_m : kInfinity;
}

std::vector<Scene> best_map_scene(const std::string& id, const std::vector<MapInSpace>& maps) {
  const MapInSpace* best = nullptr;
  for (const MapInSpace& one : maps)
    if (has_map_scene(*one.map) &&
        (best == nullptr || error_or_infinity(*one.map) < error_or_infinity(*best->map)))
      best = &one;
  if (best == nullptr) return {};
  return {map_scene({.id = id,
                     .title = with_mean_error(best->title, *best->map),
                     .method = best->method,
                     .map = *best->map})};
}

}  // namespace mapproof
