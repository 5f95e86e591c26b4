#include "core/records/maps/map_json.hpp"

#include <algorithm>
#include <numbers>

#include "core/base/text/csv.hpp"
#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"
#include "core/records/maps/map_fields.hpp"

namespace mapproof {
namespace {

std::string ellipse_fields(const MapUncertainty& uncertainty, Eigen::Index i) {
  const std::optional<Ellipse> ellipse = confidence_ellipse(uncertainty, i);
  if (!ellipse) return ",,,";
  return ',' + csv_number(ellipse->a) + ',' + csv_number(ellipse->b) + ',' +
         csv_number(ellipse->rotation_rad * 180.0 / std::numbers::pi);
}

std::string csv_row(const MapRecord& map, Eigen::Index i) {
  const bool has_ground_truth = map.ground_truth_m && map.ground_truth_m->row(i).allFinite();
  const bool is_metric = map.frame == Frame::kGroundTruth;
  std::string row = csv_field(map.names[static_cast<std::size_t>(i)]);
  for (const double x : {map.estimate(i, 0), map.estimate(i, 1)}) row += ',' + csv_number(x);
  row += ',' + (has_ground_truth ? csv_number((*map.ground_truth_m)(i, 0)) : "");
  row += ',' + (has_ground_truth ? csv_number((*map.ground_truth_m)(i, 1)) : "");
  if (is_metric)
    row += ',' + (has_ground_truth
                      ? csv_number((map.estimate.row(i) - map.ground_truth_m->row(i)).norm())
                      : "");
  row += std::ranges::find(map.anchors, i) != map.anchors.end() ? ",1" : ",0";
  return row;
}

}  // namespace

std::string map_json(const MapRecord& map, const std::optional<MapUncertainty>& uncertainty,
                     const std::optional<MapSensors>& sensors, const std::optional<Fit>& fit) {
  return to_json_text(MapFile{map, uncertainty, sensors, fit});
}

MapRecord parse_map(std::string_view text, const std::string& source) {
  return from_json_text<MapFile>(text, source).map;
}

std::optional<MapUncertainty> parse_map_uncertainty(std::string_view text,
                                                    const std::string& source) {
  return from_json_text<MapFile>(text, source).uncertainty;
}

std::optional<Fit> parse_map_fit(std::string_view text, const std::string& source) {
  return from_json_text<MapFile>(text, source).fit;
}

std::string map_csv(const MapRecord& map, const std::optional<MapUncertainty>& uncertainty) {
  const bool metric = map.frame == Frame::kGroundTruth;
  std::string csv = metric ? "name,x_m,y_m,true_x_m,true_y_m,error_m,anchor"
                           : "name,x,y,true_x_m,true_y_m,anchor";
  if (uncertainty)
    csv += metric ? ",ellipse_a_m,ellipse_b_m,ellipse_rotation_deg"
                  : ",ellipse_a,ellipse_b,ellipse_rotation_deg";
  csv += "\r\n";
  for (Eigen::Index i = 0; i < map.estimate.rows(); ++i)
    csv += csv_row(map, i) + (uncertainty ? ellipse_fields(*uncertainty, i) : "") + "\r\n";
  return csv;
}

}  // namespace mapproof
