#include "render/plot/figure_json.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

// The names of enumerators in files, in the order of the enumerators.
constexpr std::array kInks = {"text",    "muted",   "warning", "series1", "series2",
                              "series3", "series4", "series5", "series6", "series7"};
constexpr std::array kDashes = {"solid", "dashed", "dotted", "dash-dot", "long-dash"};
constexpr std::array kMarkers = {"none",    "circle",        "square", "triangle",
                                 "diamond", "triangle-down", "cross",  "plus"};
constexpr std::array kFills = {"none", "tint", "solid", "paper"};
constexpr std::array kRamps = {"ink", "viridis"};
constexpr std::array kAligns = {"start", "middle", "end"};
constexpr std::array kScales = {"linear", "log"};

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
  return {{"kind", "cells"},
          {"label", cells.label},
          {"x", range_json(cells.x)},
          {"y", range_json(cells.y)},
          {"columns", cells.columns},
          {"values", numbers_json(cells.values)},
          {"limits", range_json(cells.limits)},
          {"ramp", enum_json(cells.ramp, kRamps)},
          {"ink", enum_json(cells.ink, kInks)},
          {"mark", mark_json(cells.mark)}};
}

Json layer_json(const Texts& texts) {
  return {{"kind", "texts"},
          {"x", numbers_json(texts.x)},
          {"y", numbers_json(texts.y)},
          {"text", texts.text},
          {"align", enum_json(texts.align, kAligns)},
          {"ink", enum_json(texts.ink, kInks)}};
}

Json axis_json(const Axis& axis) {
  return {{"label", axis.label},
          {"scale", enum_json(axis.scale, kScales)},
          {"limits", axis.limits ? range_json(*axis.limits) : Json()},
          {"whole", axis.whole}};
}

Json panel_json(const Panel& panel) {
  Json layers = Json::array();
  for (const Layer& layer : panel.layers)
    layers.push_back(std::visit([](const auto& one) { return layer_json(one); }, layer));
  return {{"title", panel.title},    {"x", axis_json(panel.x)},
          {"y", axis_json(panel.y)}, {"equal_aspect", panel.equal_aspect},
          {"bare", panel.bare},      {"layers", std::move(layers)}};
}

/// A value of a document and where it stands, for messages.
class Reader {
 public:
  Reader(const Json& value, std::string pointer, const std::string& path)
      : value_(value), pointer_(std::move(pointer)), path_(path) {}

  [[noreturn]] void refuse(const std::string& what) const {
    throw IoError(path_, pointer_.empty() ? "/" : pointer_, what);
  }

  Reader at(const char* key) const {
    if (!value_.is_object()) refuse("an object was expected");
    const auto found = value_.find(key);
    if (found == value_.end()) refuse(std::string("has no \"") + key + "\"");
    return {*found, pointer_ + "/" + key, path_};
  }

  std::vector<Reader> items() const {
    if (!value_.is_array()) refuse("an array was expected");
    std::vector<Reader> list;
    for (std::size_t i = 0; i < value_.size(); ++i)
      list.emplace_back(value_[i], fmt::format("{}/{}", pointer_, i), path_);
    return list;
  }

  std::string text() const {
    if (!value_.is_string()) refuse("a string was expected");
    return value_.get<std::string>();
  }

  bool flag() const {
    if (!value_.is_boolean()) refuse("true or false was expected");
    return value_.get<bool>();
  }

  double number() const {
    if (!value_.is_number()) refuse("a number was expected");
    return value_.get<double>();
  }

  std::size_t count() const {
    const double value = number();
    if (!(value >= 0.0 && value <= 1e9 && value == std::floor(value)))
      refuse("a whole number from 0 to 10^9 was expected");
    return static_cast<std::size_t>(value);
  }

  bool has(const char* key) const { return value_.is_object() && value_.contains(key); }
  bool is_null() const { return value_.is_null(); }

  std::vector<double> numbers() const {
    std::vector<double> list;
    for (const Reader& item : items()) list.push_back(item.is_null() ? NAN : item.number());
    return list;
  }

  std::vector<std::string> texts() const {
    std::vector<std::string> list;
    for (const Reader& item : items()) list.push_back(item.text());
    return list;
  }

  template <typename Enum, std::size_t N>
  Enum named(const std::array<const char*, N>& names) const {
    const std::string given = text();
    for (std::size_t i = 0; i < N; ++i)
      if (given == names[i]) return static_cast<Enum>(i);
    refuse("\"" + printable(given) + "\" is unknown");
  }

 private:
  const Json& value_;
  std::string pointer_;
  const std::string& path_;
};

Mark read_mark(const Reader& json) {
  Mark mark{json.at("id").text(), {}};
  for (const Reader& pair : json.at("data").items()) {
    const std::vector<std::string> parts = pair.texts();
    if (parts.size() != 2) pair.refuse("a name and a value were expected");
    mark.data.emplace_back(parts[0], parts[1]);
  }
  return mark;
}

std::vector<Mark> read_marks(const Reader& json) {
  std::vector<Mark> marks;
  for (const Reader& item : json.items()) marks.push_back(read_mark(item));
  return marks;
}

Polyline read_polyline(const Reader& json) {
  return {json.at("label").text(),
          json.at("x").numbers(),
          json.at("y").numbers(),
          json.at("ink").named<Ink>(kInks),
          json.at("dash").named<Dash>(kDashes),
          json.at("width").number(),
          json.at("marker").named<Marker>(kMarkers),
          read_mark(json.at("mark"))};
}

Band read_band(const Reader& json) {
  return {json.at("label").text(),   json.at("x").numbers(),           json.at("low").numbers(),
          json.at("high").numbers(), json.at("ink").named<Ink>(kInks), read_mark(json.at("mark"))};
}

Scatter read_scatter(const Reader& json) {
  return {json.at("label").text(),
          json.at("x").numbers(),
          json.at("y").numbers(),
          json.at("ink").named<Ink>(kInks),
          json.at("marker").named<Marker>(kMarkers),
          json.at("filled").flag(),
          json.at("size").number(),
          read_marks(json.at("marks"))};
}

Segments read_segments(const Reader& json) {
  return {json.at("label").text(),
          json.at("x0").numbers(),
          json.at("y0").numbers(),
          json.at("x1").numbers(),
          json.at("y1").numbers(),
          json.at("ink").named<Ink>(kInks),
          json.at("dash").named<Dash>(kDashes),
          json.at("width").number(),
          json.at("arrow").flag(),
          read_marks(json.at("marks"))};
}

PointLabels read_labels(const Reader& json) {
  return {json.at("x").numbers(), json.at("y").numbers(), json.at("text").texts(),
          json.at("ink").named<Ink>(kInks)};
}

Range read_range(const Reader& json) {
  const std::vector<double> ends = json.numbers();
  if (ends.size() != 2) json.refuse("two numbers were expected");
  return {ends[0], ends[1]};
}

Area read_area(const Reader& json) {
  return {json.at("label").text(),
          json.at("x").numbers(),
          json.at("y").numbers(),
          json.at("ink").named<Ink>(kInks),
          json.at("fill").named<Fill>(kFills),
          json.at("outlined").flag(),
          json.at("dash").named<Dash>(kDashes),
          json.at("width").number(),
          read_mark(json.at("mark"))};
}

Ellipses read_ellipses(const Reader& json) {
  return {json.at("label").text(),
          json.at("x").numbers(),
          json.at("y").numbers(),
          json.at("a").numbers(),
          json.at("b").numbers(),
          json.at("turn_rad").numbers(),
          json.at("ink").named<Ink>(kInks),
          json.at("fill").named<Fill>(kFills),
          json.at("dash").named<Dash>(kDashes),
          json.at("width").number(),
          read_marks(json.at("marks"))};
}

Cells read_cells(const Reader& json) {
  return {json.at("label").text(),
          read_range(json.at("x")),
          read_range(json.at("y")),
          json.at("columns").count(),
          json.at("values").numbers(),
          read_range(json.at("limits")),
          json.at("ramp").named<Ramp>(kRamps),
          json.at("ink").named<Ink>(kInks),
          read_mark(json.at("mark"))};
}

Texts read_texts(const Reader& json) {
  return {json.at("x").numbers(), json.at("y").numbers(), json.at("text").texts(),
          json.at("align").named<Align>(kAligns), json.at("ink").named<Ink>(kInks)};
}

Layer read_layer(const Reader& json) {
  const std::string kind = json.at("kind").text();
  if (kind == "polyline") return read_polyline(json);
  if (kind == "band") return read_band(json);
  if (kind == "scatter") return read_scatter(json);
  if (kind == "segments") return read_segments(json);
  if (kind == "labels") return read_labels(json);
  if (kind == "area") return read_area(json);
  if (kind == "ellipses") return read_ellipses(json);
  if (kind == "cells") return read_cells(json);
  if (kind == "texts") return read_texts(json);
  json.at("kind").refuse("\"" + printable(kind) + "\" is unknown");
}

Axis read_axis(const Reader& json) {
  Axis axis{json.at("label").text(), json.at("scale").named<Scale>(kScales)};
  if (json.has("whole")) axis.whole = json.at("whole").flag();
  if (!json.at("limits").is_null()) axis.limits = read_range(json.at("limits"));
  return axis;
}

Panel read_panel(const Reader& json) {
  Panel panel{json.at("title").text(),
              read_axis(json.at("x")),
              read_axis(json.at("y")),
              json.at("equal_aspect").flag(),
              json.has("bare") && json.at("bare").flag(),
              {}};
  for (const Reader& layer : json.at("layers").items()) panel.layers.push_back(read_layer(layer));
  return panel;
}

Figure read_figure(const Reader& json) {
  const Reader schema = json.at("schema");
  if (schema.at("name").text() != "mapproof.figure") schema.at("name").refuse("is no figure");
  if (schema.at("version").number() != 1) schema.at("version").refuse("only version 1 is known");
  Figure figure;
  figure.id = json.at("id").text();
  figure.title = json.at("title").text();
  figure.caption = json.at("caption").text();
  figure.alt = json.at("alt").text();
  figure.record_ids = json.at("records").texts();
  figure.varies = json.at("varies").flag();
  for (const Reader& note : json.at("notes").items())
    figure.notes.push_back({note.at("text").text(), note.at("ink").named<Ink>(kInks)});
  for (const Reader& panel : json.at("panels").items()) figure.panels.push_back(read_panel(panel));
  // Figures written before there were grids of panels have none of these.
  if (json.has("columns")) figure.columns = json.at("columns").count();
  if (json.has("shared_x")) figure.shared_x = json.at("shared_x").flag();
  if (json.has("shared_y")) figure.shared_y = json.at("shared_y").flag();
  if (json.has("arrows"))
    for (const Reader& arrow : json.at("arrows").items())
      figure.arrows.push_back({arrow.at("from").count(), arrow.at("label").text()});
  if (const std::string what = problem(figure); !what.empty()) json.refuse(what);
  return figure;
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
  const Json json = {{"schema", {{"name", "mapproof.figure"}, {"version", 1}}},
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
  // Names come from anywhere: bytes that are no UTF-8 become U+FFFD instead of an exception.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Figure figure_from_json(std::string_view text, const std::string& path) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw IoError(path, fmt::format("byte {}", error.byte), "is no JSON");
  } catch (const Json::exception&) {
    throw IoError(path, "holds a number that is out of range");
  }
  return read_figure({json, "", path});
}

}  // namespace mapproof
