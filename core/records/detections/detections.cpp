#include "core/records/detections/detections.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/input_file.hpp"
#include "core/json/text_input.hpp"
#include "core/records/detections/detections_long.hpp"
#include "core/records/detections/mrclam.hpp"
#include "core/records/detections/scan_grouping.hpp"
#include "core/records/detections/scan_rows.hpp"
#include "core/records/limits.hpp"
#include "core/records/observations/input_kind.hpp"
#include "core/records/observations/observation_json.hpp"
#include "core/records/tables/cells.hpp"
#include "core/records/tables/respelling.hpp"
#include "core/records/tables/table_stream.hpp"

namespace mapproof {
namespace {

constexpr const char* kDetectionsSchema = "mapproof.detections";

}  // namespace

bool is_detections(ByteSource& source, const TableFormat& format) {
  respell(source);
  if (is_json(source)) return json_schema(source) == kDetectionsSchema;
  return first_row_is(source, [&](const TableRow& row) {
    return names_detection_columns(row, format.columns) || starts_detection_list(row);
  });
}

MeasuredColumns measured_in(ByteSource& source, const TableFormat& format) {
  MeasuredColumns measured{.range = true, .bearing = true};
  if (is_json(source)) return measured;
  first_row_is(source, [&](const TableRow& row) {
    measured = measured_columns(row, format.columns);
    return true;
  });
  return measured;
}

bool is_large_long_table(ByteSource& source, const TableFormat& format) {
  respell(source);
  constexpr std::size_t kLarge = 64'000'000;
  if (is_json(source)) return false;
  const auto is_long = [&](const TableRow& row) {
    return names_detection_columns(row, format.columns) || starts_detection_list(row) ||
           names_value_columns(row, format.columns);
  };
  return first_row_is(source, is_long) && source.holds_more_than(kLarge);
}

DetectionSource read_detections(ByteSource& source, const TableFormat& format) {
  respell(source);
  if (!is_json(source)) return read_long_detections(source, format);
  if (format.scan_window_s) refuse_window(source.name());
  const std::string bytes = source.rest();
  return parse_detections(checked_text(bytes, source.name()), source.name());
}

DetectionSource read_detections(const std::filesystem::path& path, const TableFormat& format) {
  if (is_folder(path)) return read_mrclam_detections(path, format.scan_window_s);
  ByteSource source(path);
  return read_detections(source, format);
}

}  // namespace mapproof
