#include <cmath>

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/json/json_text.hpp"
#include "render/plot/figure_json.hpp"
#include "render/plot/figure_json_names.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;
using namespace figure_json;

template <typename Enum, std::size_t N>
Json enum_json(Enum value, const std::array<const char*, N>& names) {
  return names[static_cast<std::size_t>(value)];
}

Json numbers_json(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(std::isnan(value) ? Json() : Json(value));
  return list;
}

Json mark_json(const Mark& mark) {
  Json data = Json::array();
  for (const auto& [key, value] : mark.data) data.push_back({key, value});
  return {{"id", mark.id}, {"data", std::move(data)}};
}

Json marks_json(const std::vector<Mark>& marks) {
  Json list = Json::array();
  for (const Mark& mark : marks) list.push_back(mark_json(mark));
  return list;
}

Json layer_json(const Polyline& line) {
  return {{"kind", "polyline"},
          {"label", line.label},
          {"x", numbers_json(line.x)},
          {"y", numbers_json(line.y)},
          {"ink", enum_json(line.ink, kInks)},
          {"dash", enum_json(line.dash, kDashes)},
          {"width", line.width},
          {"marker", enum_json(line.marker, kMarkers)},
          {"mark", mark_json(line.mark)}};
}

Json layer_json(const Band& band) {
  return {{"kind", "band"},
          {"label", band.label},
          {"x", numbers_json(band.x)},
          {"low", numbers_json(band.low)},
          {"high", numbers_json(band.high)},
          {"ink", enum_json(band.ink, kInks)},
          {"mark", mark_json(band.mark)}};
}

Json layer_json(const Scatter& points) {
  return {{"kind", "scatter"},
          {"label", points.label},
          {"x", numbers_json(points.x)},
          {"y", numbers_json(points.y)},
          {"ink", enum_json(points.ink, kInks)},
          {"marker", enum_json(points.marker, kMarkers)},
          {"filled", points.filled},
          {"size", points.size},
          {"marks", marks_json(points.marks)}};
}

Json layer_json(const Segments& lines) {
  return {{"kind", "segments"},
          {"label", lines.label},
          {"x0", numbers_json(lines.x0)},
          {"y0", numbers_json(lines.y0)},
          {"x1", numbers_json(lines.x1)},
          {"y1", numbers_json(lines.y1)},
          {"ink", enum_json(lines.ink, kInks)},
          {"dash", enum_json(lines.dash, kDashes)},
          {"width", lines.width},
          {"arrow", lines.arrow},
          {"marks", marks_json(lines.marks)}};
}

Json layer_json(const PointLabels& labels) {
  return {{"kind", "labels"},
          {"x", numbers_json(labels.x)},
          {"y", numbers_json(labels.y)},
          {"text", labels.text},
          {"ink", enum_json(labels.ink, kInks)}};
}

Json range_json(const Range& range) { return Json{range.low, range.high}; }

Json layer_json(const Area& area) {
  return {{"kind", "area"},
          {"label", area.label},
          {"x", numbers_json(area.x)},
          {"y", numbers_json(area.y)},
          {"ink", enum_json(area.ink, kInks)},
          {"fill", enum_json(area.fill, kFills)},
          {"outlined", area.outlined},
          {"dash", enum_json(area.dash, kDashes)},
          {"width", area.width},
          {"mark", mark_json(area.mark)}};
}

Json layer_json(const Ellipses& ellipses) {
  return {{"kind", "ellipses"},
          {"label", ellipses.label},
          {"x", numbers_json(ellipses.x)},
          {"y", numbers_json(ellipses.y)},
          {"a", numbers_json(ellipses.a)},
          {"b", numbers_json(ellipses.b)},
          {"turn_rad", numbers_json(ellipses.turn_rad)},
          {"ink", enum_json(ellipses.ink, kInks)},
          {"fill", enum_json(ellipses.fill, kFills)},
          {"dash", enum_json(ellipses.dash, kDashes)},
          {"width", ellipses.width},
          {"marks", marks_json(ellipses.marks)}};
}

Json layer_json(const Cells& cells) {
  Json json = {{"kind", "cells"},
               {"label", cells.label},
               {"x", range_json(cells.x)},
               {"y", range_json(cells.y)},
               {"columns", cells.columns},
               {"values", numbers_json(cells.values)},
               {"limits", range_json(cells.limits)},
               {"ramp", enum_json(cells.ramp, kRamps)},
               {"ink", enum_json(cells.ink, kInks)},
               {"mark", mark_json(cells.mark)}};
  if (cells.scale != Scale::kLinear) json["scale"] = enum_json(cells.scale, kScales);
  if (!cells.bar_label.empty()) json["bar_label"] = cells.bar_label;
  if (!cells.text.empty()) json["text"] = cells.text;
  return json;
}

Json layer_json(const Texts& texts) {
  return {{"kind", "texts"},
          {"x", numbers_json(texts.x)},
          {"y", numbers_json(texts.y)},
          {"text", texts.text},
          {"align", enum_json(texts.align, kAligns)},
          {"ink", enum_json(texts.ink, kInks)}};
}

Json layer_json(const Picture& picture) {
  return {{"kind", "picture"},
          {"x", range_json(picture.x)},
          {"y", range_json(picture.y)},
          {"source", picture.source},
          {"clear_x", numbers_json(picture.clear_x)},
          {"clear_y", numbers_json(picture.clear_y)},
          {"clear_by", numbers_json(picture.clear_by)}};
}

Json axis_json(const Axis& axis) {
  Json json = {{"label", axis.label},
               {"scale", enum_json(axis.scale, kScales)},
               {"limits", axis.limits ? range_json(*axis.limits) : Json()},
               {"whole", axis.whole}};
  if (!axis.names.empty()) json["names"] = axis.names;
  return json;
}

Json panel_json(const Panel& panel) {
  Json layers = Json::array();
  for (const Layer& layer : panel.layers)
    layers.push_back(std::visit([](const auto& one) { return layer_json(one); }, layer));
  return {{"title", panel.title},    {"x", axis_json(panel.x)},
          {"y", axis_json(panel.y)}, {"equal_aspect", panel.equal_aspect},
          {"bare", panel.bare},      {"layers", std::move(layers)}};
}

}  // namespace

std::string figure_to_json(const Figure& figure) {
  Json notes = Json::array();
  for (const Note& note : figure.notes)
    notes.push_back({{"text", note.text}, {"ink", enum_json(note.ink, kInks)}});
  Json panels = Json::array();
  for (const Panel& panel : figure.panels) panels.push_back(panel_json(panel));
  Json arrows = Json::array();
  for (const PanelArrow& arrow : figure.arrows)
    arrows.push_back({{"from", arrow.from}, {"label", arrow.label}});
  const Json json = {{"schema", schema_value("mapproof.figure")},
                     {"id", figure.id},
                     {"title", figure.title},
                     {"caption", figure.caption},
                     {"alt", figure.alt},
                     {"records", figure.record_ids},
                     {"varies", figure.varies},
                     {"notes", std::move(notes)},
                     {"panels", std::move(panels)},
                     {"columns", figure.columns},
                     {"shared_x", figure.shared_x},
                     {"shared_y", figure.shared_y},
                     {"arrows", std::move(arrows)}};
  return json_text(json);
}

}  // namespace mapproof
