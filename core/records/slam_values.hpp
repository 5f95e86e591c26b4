#pragma once

#include <optional>

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/model/slam_study.hpp"

namespace mapproof {

/// Values of range-only records within other JSON. Readers throw IoError with the place.

SlamMethod read_slam_method(const JsonCursor& value);

nlohmann::ordered_json range_log_value(const RangeLog& log);

/// What a paper prints of a drive; null: nothing.
nlohmann::ordered_json published_drive_value(const std::optional<PublishedDrive>& drive);
std::optional<PublishedDrive> read_published_drive(const JsonCursor& value);

}  // namespace mapproof
