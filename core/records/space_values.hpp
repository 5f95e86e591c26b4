#pragma once

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/model/space_points.hpp"
#include "core/model/upgrade_clouds.hpp"

namespace mapproof {

/// [[x, y, z], null, ...]: null for a row that is not finite.
nlohmann::ordered_json space_points_value(const SpacePoints& points);
/// At most `most` of them. @throws IoError with the place.
SpacePoints read_space_points(const JsonCursor& value, std::size_t most);

/// {"steps": [...], "before": {"points": [...], "quadric": [[...], ...]}, "after": {...}}.
nlohmann::ordered_json upgrade_value(const UpgradeClouds& upgrade);
/// @throws IoError with the place.
UpgradeClouds read_upgrade(const JsonCursor& value);

}  // namespace mapproof
