#include "core/records/map_files.hpp"

#include <algorithm>

#include "core/base/csv.hpp"
#include "core/json/json_text.hpp"
#include "core/records/map_values.hpp"

namespace mapproof {
namespace {

std::string csv_row(const MapRecord& map, Eigen::Index i) {
  const bool has_truth = map.truth_m && map.truth_m->row(i).allFinite();
  const bool is_metric = map.frame == Frame::kTruth;
  std::string row = csv_field(map.names[static_cast<std::size_t>(i)]);
  for (const double x : {map.estimate(i, 0), map.estimate(i, 1)}) row += ',' + csv_number(x);
  row += ',' + (has_truth ? csv_number((*map.truth_m)(i, 0)) : "");
  row += ',' + (has_truth ? csv_number((*map.truth_m)(i, 1)) : "");
  if (is_metric)
    row += ',' + (has_truth ? csv_number((map.estimate.row(i) - map.truth_m->row(i)).norm()) : "");
  row += std::ranges::find(map.anchors, i) != map.anchors.end() ? ",1" : ",0";
  return row + "\r\n";
}

}  // namespace

std::string map_json(const MapRecord& map) {
  nlohmann::ordered_json value = {{"schema", schema_value("mapproof.map")}};
  value.update(map_value(map));
  return json_text(value);
}

MapRecord parse_map(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  expect_schema(document.cursor(), "mapproof.map");
  return read_map(document.cursor(), nullptr, {"schema"});
}

std::string map_csv(const MapRecord& map) {
  std::string csv = map.frame == Frame::kTruth ? "name,x_m,y_m,true_x_m,true_y_m,error_m,anchor\r\n"
                                               : "name,x,y,true_x_m,true_y_m,anchor\r\n";
  for (Eigen::Index i = 0; i < map.estimate.rows(); ++i) csv += csv_row(map, i);
  return csv;
}

}  // namespace mapproof
