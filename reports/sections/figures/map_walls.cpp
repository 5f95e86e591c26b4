#include "reports/sections/figures/map_walls.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "render/figures/maps/map_grid.hpp"
#include "reports/sections/figures/map_scenes.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostMaps = 12;
constexpr std::size_t kColumns = 3;
constexpr std::string_view kOf = ": ";  ///< Between a subject and what its map is of.

using NamedMap = std::pair<std::string, const MapRecord*>;

struct MapsOfWorld {
  std::string subject = {};
  std::vector<NamedMap> maps = {};
};

std::string subject_of(const std::string& name) {
  const std::size_t end = name.find(kOf);
  return end == std::string::npos ? "" : name.substr(0, end);
}

bool has_use(const MapRecord& map) { return map.score && is_usable(*map.score); }

/// Also where both are not known.
bool are_equal(const Points& a, const Points& b) {
  return a.rows() == b.rows() &&
         (a.array() == b.array() || (a.array().isNaN() && b.array().isNaN())).all();
}

std::vector<MapsOfWorld> worlds_of(const std::vector<NamedMap>& maps) {
  std::vector<MapsOfWorld> worlds;
  for (const auto& [name, map] : maps) {
    if (map->frame != Frame::kGroundTruth || !map->ground_truth_m) continue;
    const std::string subject = subject_of(name);
    auto world = std::ranges::find_if(worlds, [&, &map = map](const MapsOfWorld& one) {
      const MapRecord& first = *one.maps.front().second;
      return one.subject == subject && first.names == map->names &&
             are_equal(*first.ground_truth_m, *map->ground_truth_m);
    });
    if (world == worlds.end()) world = worlds.insert(world, MapsOfWorld{.subject = subject});
    world->maps.emplace_back(name, map);
  }
  for (MapsOfWorld& world : worlds)
    std::ranges::stable_sort(world.maps, {}, [](const NamedMap& map) {
      return std::pair(!has_use(*map.second), error_or_infinity(*map.second));
    });
  return worlds;
}

/// "Range and bearing" above "SMACOF once".
std::string in_two_lines(std::string name) {
  constexpr std::string_view kComma = ", ";
  if (const std::size_t at = name.find(kComma); at != std::string::npos)
    name.replace(at, kComma.size(), "\n");
  return name;
}

/// "of the 3 maps drawn", "of 15 maps, 12 of them drawn": a study may have more methods than maps.
std::string ranked_words(std::size_t maps, std::size_t drawn) {
  return maps == drawn ? fmt::format("of the {} maps drawn", maps)
                       : fmt::format("of {} maps, {} of them drawn", maps, drawn);
}

Figure wall_of(const MapsOfWorld& world, std::string id) {
  MapGridSpec spec{.id = std::move(id), .title = "", .maps = {}};
  const std::size_t cut = world.subject.empty() ? 0 : world.subject.size() + kOf.size();
  // Where no map is usable, the title says so.
  const bool marks = has_use(*world.maps.front().second);
  for (const auto& [name, map] : world.maps)
    if (spec.maps.size() < kMostMaps)
      spec.maps.push_back(
          {in_two_lines(name.substr(cut)) + (marks && !has_use(*map) ? " (not usable)" : ""),
           *map});
  const MapRecord& best = spec.maps.front().map;
  const std::string subject = world.subject.empty() ? "" : world.subject + std::string(kOf);
  if (has_use(best) && std::isfinite(error_or_infinity(best))) {
    const auto useful = static_cast<std::size_t>(std::ranges::count_if(
        world.maps, [](const NamedMap& one) { return has_use(*one.second); }));
    const std::size_t useless = world.maps.size() - useful;
    // Those that are of no use would make the others small.
    spec.framing = std::min(useful, spec.maps.size());
    spec.title = fmt::format("{} is the best {}, {} off", world.maps.front().first,
                             ranked_words(world.maps.size(), spec.maps.size()),
                             error_text(error_or_infinity(best)));
    if (useless > 0)
      spec.title += fmt::format("; {} {} not usable", useless, useless == 1 ? "is" : "are");
    else if (spec.maps.size() > 2)
      spec.title += "; the others in the order of their errors";
  } else {
    const bool is_useless = best.score && !has_use(best);
    spec.title = subject + (is_useless ? "no map is usable" : "maps of one world");
  }
  Figure figure = map_wall_figure(spec);
  figure.columns = kColumns;
  return figure;
}

}  // namespace

bool is_usable(const Score& score) { return !(score.moe_percent > kMostTurned_percent); }

std::vector<Figure> map_walls(const std::string& prefix,
                              const std::vector<std::pair<std::string, const MapRecord*>>& maps) {
  std::vector<Figure> walls;
  for (const MapsOfWorld& world : worlds_of(maps))
    if (world.maps.size() > 1)
      walls.push_back(wall_of(world, fmt::format("{}-world-{}", prefix, walls.size() + 1)));
  return walls;
}

}  // namespace mapproof
