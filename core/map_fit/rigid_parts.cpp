#include "core/map_fit/rigid_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>

namespace mapproof {
namespace {

constexpr double kClearTurn = 0.8;  ///< Of SeenOrientation::direction.

using Body = std::set<int>;

/// Firm pairs and triples of landmarks.
class Bars {
 public:
  Bars(const std::vector<MeasuredPair>& pairs, const std::vector<SeenOrientation>& turns,
       const std::vector<bool>& is_mapped)
      : next_(is_mapped.size()) {
    for (const MeasuredPair& pair : pairs) {
      const auto a = static_cast<int>(pair.first);
      const auto b = static_cast<int>(pair.second);
      if (pair.scans < kFirmScans || !is_mapped[static_cast<std::size_t>(a)] ||
          !is_mapped[static_cast<std::size_t>(b)])
        continue;
      next_[static_cast<std::size_t>(a)].insert(b);
      next_[static_cast<std::size_t>(b)].insert(a);
    }
    for (const SeenOrientation& turn : turns)
      if (turn.scans >= kFirmScans && std::abs(turn.direction) > kClearTurn)
        triples_.insert({turn.first, turn.second, turn.third});
  }

  const std::set<int>& next(int landmark) const {
    return next_[static_cast<std::size_t>(landmark)];
  }

  /// How many firm pairs a landmark has with a body.
  int to(int landmark, const Body& body) const {
    return static_cast<int>(
        std::ranges::count_if(next(landmark), [&](int other) { return body.contains(other); }));
  }

  /// Whether a triple of the landmark and two of the body was seen, both paired with it.
  bool is_turned(int landmark, const Body& body) const {
    for (const int a : next(landmark))
      for (const int b : next(landmark)) {
        if (a >= b || !body.contains(a) || !body.contains(b)) continue;
        std::array<int, 3> triple = {landmark, a, b};
        std::ranges::sort(triple);
        if (triples_.contains(triple)) return true;
      }
    return false;
  }

  bool holds(int landmark, const Body& body) const {
    const int pairs = to(landmark, body);
    return pairs >= 3 || (pairs == 2 && (body.size() == 2 || is_turned(landmark, body)));
  }

 private:
  std::vector<std::set<int>> next_;
  std::set<std::array<int, 3>> triples_;
};

/// The body that grows from two landmarks. A third one needs two pairs: a triangle has one shape.
Body grown(const Bars& bars, int first, int second) {
  Body body = {first, second};
  for (bool grows = true; grows;) {
    grows = false;
    std::set<int> near;
    for (const int one : body)
      for (const int other : bars.next(one))
        if (!body.contains(other)) near.insert(other);
    for (const int one : near)
      if (bars.holds(one, body)) {
        body.insert(one);
        grows = true;
      }
  }
  return body;
}

bool are_joined(const Bars& bars, const Body& one, const Body& other) {
  int shared = 0;
  int pairs = 0;
  bool is_turned = false;
  for (const int k : one) {
    if (other.contains(k)) {
      ++shared;
      continue;
    }
    for (const int next : bars.next(k)) pairs += other.contains(next) && !one.contains(next);
    is_turned = is_turned || bars.is_turned(k, other);
  }
  constexpr std::array kNeeded = {4, 2, 1, 0};
  return pairs >= kNeeded[static_cast<std::size_t>(std::min(shared, 3))] ||
         (shared == 2 && is_turned);
}

/// Joins bodies as long as any two hold together.
void join(const Bars& bars, std::vector<Body>& bodies) {
  for (bool joins = true; joins;) {
    joins = false;
    for (std::size_t a = 0; a < bodies.size() && !joins; ++a)
      for (std::size_t b = a + 1; b < bodies.size() && !joins; ++b)
        if (are_joined(bars, bodies[a], bodies[b])) {
          bodies[a].insert(bodies[b].begin(), bodies[b].end());
          bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(b));
          joins = true;
        }
  }
}

std::vector<Body> bodies_of(const Bars& bars, const std::vector<bool>& is_mapped) {
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < is_mapped.size(); ++i)
    for (const int j : bars.next(static_cast<int>(i))) {
      const int first = static_cast<int>(i);
      if (j < first || std::ranges::any_of(bodies, [&](const Body& body) {
            return body.contains(first) && body.contains(j);
          }))
        continue;
      bodies.push_back(grown(bars, first, j));
      join(bars, bodies);
    }
  return bodies;
}

}  // namespace

RigidParts rigid_parts(const std::vector<MeasuredPair>& pairs,
                       const std::vector<SeenOrientation>& turns,
                       const std::vector<bool>& is_mapped) {
  const Bars bars(pairs, turns, is_mapped);
  std::vector<Body> bodies = bodies_of(bars, is_mapped);
  std::ranges::stable_sort(bodies, std::ranges::greater(), &Body::size);
  RigidParts result;
  std::vector<int> part(is_mapped.size(), -1);
  const auto add = [&](const std::vector<int>& landmarks) {
    for (const int k : landmarks)
      part[static_cast<std::size_t>(k)] = static_cast<int>(result.parts.size());
    result.parts.push_back({landmarks});
  };
  for (const Body& body : bodies) {
    std::vector<int> fresh;
    for (const int k : body)
      if (part[static_cast<std::size_t>(k)] < 0) fresh.push_back(k);
    // Two landmarks have one shape whatever else holds.
    if (fresh.size() > 2 || (!fresh.empty() && result.parts.empty())) add(fresh);
  }
  for (std::size_t k = 0; k < is_mapped.size(); ++k)
    if (is_mapped[k] && part[k] < 0) add({static_cast<int>(k)});
  std::ranges::stable_sort(result.parts, std::ranges::greater(),
                           [](const RigidPart& one) { return one.landmarks.size(); });
  for (std::size_t p = 0; p < result.parts.size(); ++p)
    for (const int k : result.parts[p].landmarks)
      part[static_cast<std::size_t>(k)] = static_cast<int>(p);
  for (const MeasuredPair& pair : pairs) {
    const int a = part[static_cast<std::size_t>(pair.first)];
    const int b = part[static_cast<std::size_t>(pair.second)];
    if (a < 0 || b < 0 || a == b) continue;
    for (const int p : {a, b}) {
      ++result.parts[static_cast<std::size_t>(p)].pairs;
      result.parts[static_cast<std::size_t>(p)].scans += pair.scans;
    }
  }
  return result;
}

}  // namespace mapproof
