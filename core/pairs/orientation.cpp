#include "core/pairs/orientation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "core/pairs/pair_graph.hpp"

namespace mapproof {
namespace {

/// A triangle's area, twice; negative if clockwise.
double turn(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b, const Eigen::RowVector2d& c) {
  return cross(b - a, c - a);
}

/// Twice the area of a triple in a map; 0 if it is not whole there.
double turn_of(const SeenOrientation& triple, const Points& map) {
  const double area = turn(map.row(triple.first), map.row(triple.second), map.row(triple.third));
  return std::isnan(area) ? 0.0 : area;
}

/// Above 0 if the scan and the map have the same orientation, each triple bounded by the smaller of
/// its areas so that no single wrong one decides.
double agreement(std::span<const Detection* const> scan, const Points& map) {
  double sum = 0.0;
  for (std::size_t k = 0; k + 2 < scan.size(); ++k) {
    const double seen = turn(position_observed(*scan[k]), position_observed(*scan[k + 1]),
                             position_observed(*scan[k + 2]));
    const double mapped = turn(map.row(scan[k]->landmark), map.row(scan[k + 1]->landmark),
                               map.row(scan[k + 2]->landmark));
    sum += std::copysign(std::min(std::abs(seen), std::abs(mapped)), seen * mapped);
  }
  return sum;
}

/// Calls `visit` with the whole detections of each scan.
template <typename Visit>
void for_each_scan(const DetectionLog& log, const Visit& visit) {
  std::vector<const Detection*> scan;
  for (const Detection& seen : log.detections) {
    if (!scan.empty() && scan.back()->step != seen.step) {
      visit(scan);
      scan.clear();
    }
    if (is_located(seen)) scan.push_back(&seen);
  }
  visit(scan);
}

/// Twice the areas of the triples of one landmark order in all scans, and of these without signs.
struct Turned {
  int scans = 0;
  double area = 0.0;
  double size = 0.0;
};

using Triple = std::array<int, 3>;

void add_turn(const Detection& a, const Detection& b, const Detection& c,
              std::map<Triple, Turned>& turned) {
  const double area = turn(position_observed(a), position_observed(b), position_observed(c));
  Turned& one = turned[{a.landmark, b.landmark, c.landmark}];
  ++one.scans;
  one.area += area;
  one.size += std::abs(area);
}

}  // namespace

bool seen_mirrored(const DetectionLog& log, const Points& map) {
  double sum = 0.0;
  for_each_scan(log, [&](std::vector<const Detection*> scan) {
    std::erase_if(scan,
                  [&](const Detection* seen) { return !map.row(seen->landmark).allFinite(); });
    sum += agreement(scan, map);
  });
  return sum < 0.0;
}

std::vector<SeenOrientation> seen_turns(const DetectionLog& log) {
  constexpr std::size_t kAllTriples = 8;
  std::map<Triple, Turned> turned;
  for_each_scan(log, [&](const std::vector<const Detection*>& scan) {
    for (std::size_t i = 0; i < scan.size(); ++i)
      for (std::size_t j = i + 1; j < scan.size(); ++j)
        for (std::size_t k = j + 1; k < scan.size(); ++k) {
          if (scan.size() > kAllTriples && k > i + 2) break;
          add_turn(*scan[i], *scan[j], *scan[k], turned);
        }
  });
  std::vector<SeenOrientation> turns;
  for (const auto& [triple, one] : turned)
    turns.push_back(
        {triple[0], triple[1], triple[2], one.scans, one.size > 0.0 ? one.area / one.size : 0.0});
  return turns;
}

std::vector<SeenOrientation> at_other_orientation(const std::vector<SeenOrientation>& turns,
                                                  const Points& map) {
  constexpr double kClear = 0.8;
  std::vector<SeenOrientation> alike;
  std::vector<SeenOrientation> mirrored;
  for (const SeenOrientation& one : turns)
    if (const double area = turn_of(one, map); std::abs(one.direction) > kClear && area != 0.0)
      (area * one.direction > 0.0 ? alike : mirrored).push_back(one);
  const auto scans = [](const std::vector<SeenOrientation>& some) {
    int sum = 0;
    for (const SeenOrientation& one : some) sum += one.scans;
    return sum;
  };
  return scans(alike) < scans(mirrored) ? alike : mirrored;
}

double scans_at_other_orientation(const std::vector<SeenOrientation>& turns, const Points& map,
                                  double most_scans) {
  double alike = 0.0;
  double mirrored = 0.0;
  for (const SeenOrientation& one : turns) {
    const double scans = std::min<double>(one.scans, most_scans) * std::abs(one.direction);
    const double area = turn_of(one, map);
    if (area != 0.0) (area * one.direction > 0.0 ? alike : mirrored) += scans;
  }
  return std::min(alike, mirrored);
}

}  // namespace mapproof
