#include "core/records/slam_values.hpp"

#include "core/json/record_json.hpp"
#include "core/records/slam_fields.hpp"

namespace mapproof {

SlamMethod read_slam_method(const JsonCursor& value) { return from_json_value<SlamMethod>(value); }

nlohmann::ordered_json range_log_value(const RangeLog& log) { return to_json_value(log); }

nlohmann::ordered_json published_drive_value(const std::optional<PublishedDrive>& drive) {
  return to_json_value(drive);
}

std::optional<PublishedDrive> read_published_drive(const JsonCursor& value) {
  return from_json_value<std::optional<PublishedDrive>>(value);
}

}  // namespace mapproof
