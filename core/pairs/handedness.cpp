#include "core/pairs/handedness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "core/pairs/seen_place.hpp"

namespace mapproof {
namespace {

/// A triangle's area, twice; negative if clockwise.
double turn(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b, const Eigen::RowVector2d& c) {
  return cross(b - a, c - a);
}

/// Twice the area of a triple in a map; 0 if it is not whole there.
double turn_of(const SeenTurn& triple, const Points& map) {
  const double area = turn(map.row(triple.first), map.row(triple.second), map.row(triple.third));
  return std::isnan(area) ? 0.0 : area;
}

/// Above 0 if the look and the map turn alike, each triple bounded by the smaller of its areas so
/// that no wrong one of it decides alone.
double agreement(std::span<const Sighting* const> look, const Points& map) {
  double sum = 0.0;
  for (std::size_t k = 0; k + 2 < look.size(); ++k) {
    const double seen =
        turn(place_seen(*look[k]), place_seen(*look[k + 1]), place_seen(*look[k + 2]));
    const double mapped = turn(map.row(look[k]->landmark), map.row(look[k + 1]->landmark),
                               map.row(look[k + 2]->landmark));
    sum += std::copysign(std::min(std::abs(seen), std::abs(mapped)), seen * mapped);
  }
  return sum;
}

/// Calls `visit` with the whole sightings of each look.
template <typename Visit>
void for_each_look(const SightingLog& log, const Visit& visit) {
  std::vector<const Sighting*> look;
  for (const Sighting& seen : log.sightings) {
    if (!look.empty() && look.back()->step != seen.step) {
      visit(look);
      look.clear();
    }
    if (is_located(seen)) look.push_back(&seen);
  }
  visit(look);
}

/// Twice the areas of the triples of one landmark order in all looks, and of these without signs.
struct Turned {
  int looks = 0;
  double area = 0.0;
  double size = 0.0;
};

using Triple = std::array<int, 3>;

void add_turn(const Sighting& a, const Sighting& b, const Sighting& c,
              std::map<Triple, Turned>& turned) {
  const double area = turn(place_seen(a), place_seen(b), place_seen(c));
  Turned& one = turned[{a.landmark, b.landmark, c.landmark}];
  ++one.looks;
  one.area += area;
  one.size += std::abs(area);
}

}  // namespace

bool seen_mirrored(const SightingLog& log, const Points& map) {
  double sum = 0.0;
  for_each_look(log, [&](std::vector<const Sighting*> look) {
    std::erase_if(look, [&](const Sighting* seen) { return !map.row(seen->landmark).allFinite(); });
    sum += agreement(look, map);
  });
  return sum < 0.0;
}

std::vector<SeenTurn> seen_turns(const SightingLog& log) {
  constexpr std::size_t kAllTriples = 8;
  std::map<Triple, Turned> turned;
  for_each_look(log, [&](const std::vector<const Sighting*>& look) {
    for (std::size_t i = 0; i < look.size(); ++i)
      for (std::size_t j = i + 1; j < look.size(); ++j)
        for (std::size_t k = j + 1; k < look.size(); ++k) {
          if (look.size() > kAllTriples && k > i + 2) break;
          add_turn(*look[i], *look[j], *look[k], turned);
        }
  });
  std::vector<SeenTurn> turns;
  for (const auto& [triple, one] : turned)
    turns.push_back(
        {triple[0], triple[1], triple[2], one.looks, one.size > 0.0 ? one.area / one.size : 0.0});
  return turns;
}

std::vector<SeenTurn> turned_otherwise(const std::vector<SeenTurn>& turns, const Points& map) {
  constexpr double kClear = 0.8;
  std::vector<SeenTurn> alike;
  std::vector<SeenTurn> mirrored;
  for (const SeenTurn& one : turns)
    if (const double area = turn_of(one, map); std::abs(one.direction) > kClear && area != 0.0)
      (area * one.direction > 0.0 ? alike : mirrored).push_back(one);
  const auto looks = [](const std::vector<SeenTurn>& some) {
    int sum = 0;
    for (const SeenTurn& one : some) sum += one.looks;
    return sum;
  };
  return looks(alike) < looks(mirrored) ? alike : mirrored;
}

double looks_turned_otherwise(const std::vector<SeenTurn>& turns, const Points& map,
                              double most_looks) {
  double alike = 0.0;
  double mirrored = 0.0;
  for (const SeenTurn& one : turns) {
    const double looks = std::min<double>(one.looks, most_looks) * std::abs(one.direction);
    const double area = turn_of(one, map);
    if (area != 0.0) (area * one.direction > 0.0 ? alike : mirrored) += looks;
  }
  return std::min(alike, mirrored);
}

}  // namespace mapproof
