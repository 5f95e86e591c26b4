#pragma once

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/model/slam_study.hpp"

namespace mapproof {

/// The values of range-only records, to and from JSON. Readers throw IoError with the place.

SlamMethod read_slam_method(const JsonCursor& value);

/// Finite numbers; `size` empty: any number of them.
Eigen::VectorXd read_finite(const JsonCursor& value,
                            std::optional<std::size_t> size = std::nullopt);

/// {"time_s": [...], "x_m": [...], "y_m": [...], "heading_rad": [...] or null}.
nlohmann::ordered_json path_value(const Trajectory& path);
Trajectory read_path(const JsonCursor& value);

nlohmann::ordered_json range_log_value(const RangeLog& log);
RangeLog read_range_log_value(const JsonCursor& value);

/// What one method made of a log of so many landmarks.
nlohmann::ordered_json slam_record_value(const SlamRecord& record);
SlamRecord read_slam_record(const JsonCursor& value, Eigen::Index landmarks);

/// What a paper prints of a drive; null: nothing.
nlohmann::ordered_json published_drive_value(const std::optional<PublishedDrive>& drive);
std::optional<PublishedDrive> read_published_drive(const JsonCursor& value);

/// A mean with its interval's half width, null where it has none.
nlohmann::ordered_json mean_value(const MeanEstimate& mean);
MeanEstimate read_mean(const JsonCursor& value);

/// A number, null where it is not finite or not there.
nlohmann::ordered_json optional_value(const std::optional<double>& number);
std::optional<double> read_optional(const JsonCursor& value);

}  // namespace mapproof
