#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/console.hpp"
#include "app/own_map.hpp"
#include "core/follow/followed_map.hpp"
#include "core/model/sensor.hpp"
#include "core/records/sightings.hpp"

namespace mapproof {

/// How often a followed map is made again.
struct FollowInterval {
  long steps = 0;        ///< After so many; 0: by time.
  double seconds = 1.0;  ///< After so long, if there is a step more.
};

/// "100": steps; "2s", "0.5s": seconds. @throws InvalidInput, naming the option.
FollowInterval follow_interval(const std::string& text);

/// What is followed, and how it is mapped.
struct FollowOrder {
  std::string path;  ///< "-": standard input.
  Sensor sensor = Sensor::kVisibility;
  AngleUnit unit = AngleUnit::kRadians;  ///< Of bearings.
  FollowOptions options;
  FollowInterval every;
  std::optional<NamedPointsFile> anchors;  ///< Fitted to once three of them are on the map.
  AffineFit fit = AffineFit::kLeastDistances;
};

/// What is written after an update; `last`: no other comes.
using WriteFollowed = std::function<void(const OwnMap& map, bool last)>;

/// Follows a growing file to its end, or to SIGINT or SIGTERM, and writes its map again and again.
/// A file that is cut short or replaced ends it, too, with a remark. Without anchors each map is
/// laid on the one before, so that it does not jump.
/// @return The last map.
/// @throws IoError for what cannot be read.
OwnMap follow_map(const FollowOrder& order, const Console& console, const WriteFollowed& write);

}  // namespace mapproof
