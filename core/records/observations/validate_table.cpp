#include "core/records/observations/validate_table.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/input_file.hpp"
#include "core/json/text_input.hpp"
#include "core/records/maps/map_csv.hpp"
#include "core/records/observations/detection_columns.hpp"
#include "core/records/observations/detection_values.hpp"
#include "core/records/observations/landmarks_csv.hpp"
#include "core/records/observations/observation_values.hpp"
#include "core/records/observations/table_stream.hpp"

namespace mapproof {
namespace {

using Reader = ObservationSource (*)(std::string_view, const std::string&, Sensor, AngleUnit);

/// Of the three kinds the bearings' error says most: values that fit none are often degrees.
void check_observations(std::string_view text, const std::string& source, Reader reader) {
  for (const Sensor sensor : {Sensor::kVisibility, Sensor::kRange}) {
    try {
      reader(text, source, sensor, AngleUnit::kRadians);
      return;
    } catch (const IoError&) {
    }
  }
  reader(text, source, Sensor::kBearing, AngleUnit::kRadians);
}

bool is_map(const TableRow& header) {
  return header.cells.size() >= 6 && header.cells[0] == "name" && header.cells[3] == "true_x_m" &&
         std::ranges::find(header.cells, "anchor") != header.cells.end();
}

bool is_results_table(const TableRow& header) {
  return header.cells.size() >= 3 && header.cells[0] == "setup" && header.cells[1] == "method" &&
         header.cells[2] == "quantity";
}

bool is_part_of_mrclam(const std::filesystem::path& path) {
  const std::string name = unpacked_name(path.filename()).string();
  return name == "Barcodes.dat" || name.ends_with("_Measurement.dat");
}

}  // namespace

void check_table(ByteSource& input, std::string& kind) {
  const std::string& source = input.name();
  if (is_part_of_mrclam(input.path()))
    throw IoError(source, "is one file of an MRCLAM data set: check the folder");
  if (first_row_is(input, is_results_table))
    throw IoError(source, "is a table of results without its study.json: check the study's folder");
  if (first_row_is(input, names_detection_columns)) {
    kind = "detections";
    read_long_detections(input, {});
    return;
  }
  const std::string bytes = input.rest();
  const std::string_view text = checked_text(bytes, source);
  TableReader reader(text, source);
  TableRow first;
  if (reader.next(first) && is_map(first)) {
    kind = "map CSV";
    parse_map_csv(text, source);
    return;
  }
  if (has_long_header(text, source) || starts_as_long(text, source)) {
    kind = "long CSV observations";
    return check_observations(text, source, read_long);
  }
  if (is_landmarks_table(text, source)) {
    kind = "landmarks with positions";
    parse_landmarks(text, source);
    return;
  }
  kind = "wide CSV observations";
  check_observations(text, source, read_wide);
}

}  // namespace mapproof
