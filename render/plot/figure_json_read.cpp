#include <array>
#include <cmath>
#include <limits>

#include "core/json/json_cursor.hpp"
#include "core/json/text_input.hpp"
#include "render/plot/figure_json.hpp"
#include "render/plot/figure_json_names.hpp"

namespace mapproof {
namespace {

using namespace figure_json;

constexpr double kGreatest = std::numeric_limits<double>::max();
constexpr std::size_t kLongestText = 100'000'000;  // Names are others', and repeated in marks.

std::string text(const JsonCursor& json) { return json.text(kLongestText); }

double number(const JsonCursor& json) { return json.number(-kGreatest, kGreatest); }

std::size_t count(const JsonCursor& json) {
  return static_cast<std::size_t>(json.integer(0, 1'000'000'000));
}

std::vector<double> numbers(const JsonCursor& json) {
  return json.numbers_or_null(-kGreatest, kGreatest);
}

std::vector<std::string> texts(const JsonCursor& json) {
  std::vector<std::string> list;
  for (const JsonCursor& item : json.elements()) list.push_back(text(item));
  return list;
}

template <typename Enum, std::size_t N>
Enum named(const JsonCursor& json, const std::array<const char*, N>& names) {
  const std::string given = text(json);
  for (std::size_t i = 0; i < N; ++i)
    if (given == names[i]) return static_cast<Enum>(i);
  json.fail(in_quotes(given) + " is unknown");
}

Mark read_mark(const JsonCursor& json) {
  json.allow_only({"id", "data"});
  Mark mark{text(json.at("id")), {}};
  for (const JsonCursor& pair : json.at("data").elements()) {
    const std::vector<JsonCursor> parts = pair.elements(2, 2);
    mark.data.emplace_back(text(parts[0]), text(parts[1]));
  }
  return mark;
}

std::vector<Mark> read_marks(const JsonCursor& json) {
  std::vector<Mark> marks;
  for (const JsonCursor& item : json.elements()) marks.push_back(read_mark(item));
  return marks;
}

Polyline read_polyline(const JsonCursor& json) {
  json.allow_only({"kind", "label", "x", "y", "ink", "dash", "width", "marker", "mark"});
  return {text(json.at("label")),
          numbers(json.at("x")),
          numbers(json.at("y")),
          named<Ink>(json.at("ink"), kInks),
          named<Dash>(json.at("dash"), kDashes),
          number(json.at("width")),
          named<Marker>(json.at("marker"), kMarkers),
          read_mark(json.at("mark"))};
}

Band read_band(const JsonCursor& json) {
  json.allow_only({"kind", "label", "x", "low", "high", "ink", "mark"});
  return {text(json.at("label")),
          numbers(json.at("x")),
          numbers(json.at("low")),
          numbers(json.at("high")),
          named<Ink>(json.at("ink"), kInks),
          read_mark(json.at("mark"))};
}

Scatter read_scatter(const JsonCursor& json) {
  json.allow_only({"kind", "label", "x", "y", "ink", "marker", "filled", "size", "marks"});
  return {text(json.at("label")),
          numbers(json.at("x")),
          numbers(json.at("y")),
          named<Ink>(json.at("ink"), kInks),
          named<Marker>(json.at("marker"), kMarkers),
          json.at("filled").boolean(),
          number(json.at("size")),
          read_marks(json.at("marks"))};
}

Segments read_segments(const JsonCursor& json) {
  json.allow_only(
      {"kind", "label", "x0", "y0", "x1", "y1", "ink", "dash", "width", "arrow", "marks"});
  return {text(json.at("label")),
          numbers(json.at("x0")),
          numbers(json.at("y0")),
          numbers(json.at("x1")),
          numbers(json.at("y1")),
          named<Ink>(json.at("ink"), kInks),
          named<Dash>(json.at("dash"), kDashes),
          number(json.at("width")),
          json.at("arrow").boolean(),
          read_marks(json.at("marks"))};
}

PointLabels read_labels(const JsonCursor& json) {
  json.allow_only({"kind", "x", "y", "text", "ink"});
  return {numbers(json.at("x")), numbers(json.at("y")), texts(json.at("text")),
          named<Ink>(json.at("ink"), kInks)};
}

Range read_range(const JsonCursor& json) {
  const std::vector<JsonCursor> ends = json.elements(2, 2);
  return {number(ends[0]), number(ends[1])};
}

Area read_area(const JsonCursor& json) {
  json.allow_only({"kind", "label", "x", "y", "ink", "fill", "outlined", "dash", "width", "mark"});
  return {text(json.at("label")),
          numbers(json.at("x")),
          numbers(json.at("y")),
          named<Ink>(json.at("ink"), kInks),
          named<Fill>(json.at("fill"), kFills),
          json.at("outlined").boolean(),
          named<Dash>(json.at("dash"), kDashes),
          number(json.at("width")),
          read_mark(json.at("mark"))};
}

Ellipses read_ellipses(const JsonCursor& json) {
  json.allow_only(
      {"kind", "label", "x", "y", "a", "b", "turn_rad", "ink", "fill", "dash", "width", "marks"});
  return {text(json.at("label")),
          numbers(json.at("x")),
          numbers(json.at("y")),
          numbers(json.at("a")),
          numbers(json.at("b")),
          numbers(json.at("turn_rad")),
          named<Ink>(json.at("ink"), kInks),
          named<Fill>(json.at("fill"), kFills),
          named<Dash>(json.at("dash"), kDashes),
          number(json.at("width")),
          read_marks(json.at("marks"))};
}

Cells read_cells(const JsonCursor& json) {
  json.allow_only({"kind", "label", "x", "y", "columns", "values", "limits", "ramp", "ink", "mark",
                   "scale", "bar_label", "text"});
  Cells cells{text(json.at("label")),
              read_range(json.at("x")),
              read_range(json.at("y")),
              count(json.at("columns")),
              numbers(json.at("values")),
              read_range(json.at("limits")),
              named<Ramp>(json.at("ramp"), kRamps),
              named<Ink>(json.at("ink"), kInks),
              read_mark(json.at("mark"))};
  if (const auto scale = json.find("scale")) cells.scale = named<Scale>(*scale, kScales);
  if (const auto label = json.find("bar_label")) cells.bar_label = text(*label);
  if (const auto shown = json.find("text")) cells.text = texts(*shown);
  return cells;
}

Texts read_texts(const JsonCursor& json) {
  json.allow_only({"kind", "x", "y", "text", "align", "ink"});
  return {numbers(json.at("x")), numbers(json.at("y")), texts(json.at("text")),
          named<Align>(json.at("align"), kAligns), named<Ink>(json.at("ink"), kInks)};
}

Picture read_picture(const JsonCursor& json) {
  json.allow_only({"kind", "x", "y", "source", "clear_x", "clear_y", "clear_by"});
  return {read_range(json.at("x")),    read_range(json.at("y")),    count(json.at("source")),
          numbers(json.at("clear_x")), numbers(json.at("clear_y")), numbers(json.at("clear_by"))};
}

Layer read_layer(const JsonCursor& json) {
  const std::string kind = text(json.at("kind"));
  if (kind == "polyline") return read_polyline(json);
  if (kind == "band") return read_band(json);
  if (kind == "scatter") return read_scatter(json);
  if (kind == "segments") return read_segments(json);
  if (kind == "labels") return read_labels(json);
  if (kind == "area") return read_area(json);
  if (kind == "ellipses") return read_ellipses(json);
  if (kind == "cells") return read_cells(json);
  if (kind == "texts") return read_texts(json);
  if (kind == "picture") return read_picture(json);
  json.at("kind").fail("the kind " + in_quotes(kind) + " is unknown");
}

Axis read_axis(const JsonCursor& json) {
  json.allow_only({"label", "scale", "whole", "limits", "names"});
  Axis axis{text(json.at("label")), named<Scale>(json.at("scale"), kScales)};
  if (json.find("whole")) axis.whole = json.at("whole").boolean();
  if (!json.at("limits").is_null()) axis.limits = read_range(json.at("limits"));
  if (const auto names = json.find("names")) axis.names = texts(*names);
  return axis;
}

Panel read_panel(const JsonCursor& json) {
  json.allow_only({"title", "x", "y", "equal_aspect", "bare", "layers"});
  Panel panel{text(json.at("title")),
              read_axis(json.at("x")),
              read_axis(json.at("y")),
              json.at("equal_aspect").boolean(),
              json.find("bare") && json.at("bare").boolean(),
              {}};
  for (const JsonCursor& layer : json.at("layers").elements())
    panel.layers.push_back(read_layer(layer));
  return panel;
}

Note read_note(const JsonCursor& json) {
  json.allow_only({"text", "ink"});
  return {text(json.at("text")), named<Ink>(json.at("ink"), kInks)};
}

PanelArrow read_arrow(const JsonCursor& json) {
  json.allow_only({"from", "label"});
  return {count(json.at("from")), text(json.at("label"))};
}

Figure read_figure(const JsonCursor& json) {
  expect_schema(json, "mapproof.figure");
  json.allow_only({"schema", "id", "title", "caption", "alt", "records", "varies", "notes",
                   "panels", "columns", "shared_x", "shared_y", "arrows"});
  Figure figure;
  figure.id = text(json.at("id"));
  figure.title = text(json.at("title"));
  figure.caption = text(json.at("caption"));
  figure.alt = text(json.at("alt"));
  figure.record_ids = texts(json.at("records"));
  figure.varies = json.at("varies").boolean();
  for (const JsonCursor& note : json.at("notes").elements())
    figure.notes.push_back(read_note(note));
  for (const JsonCursor& panel : json.at("panels").elements())
    figure.panels.push_back(read_panel(panel));
  // Figures written before there were grids of panels have none of these.
  if (json.find("columns")) figure.columns = count(json.at("columns"));
  if (json.find("shared_x")) figure.shared_x = json.at("shared_x").boolean();
  if (json.find("shared_y")) figure.shared_y = json.at("shared_y").boolean();
  if (json.find("arrows"))
    for (const JsonCursor& arrow : json.at("arrows").elements())
      figure.arrows.push_back(read_arrow(arrow));
  if (const std::string what = problem(figure); !what.empty()) json.fail(what);
  return figure;
}

}  // namespace

Figure figure_from_json(std::string_view text, const std::string& path) {
  const JsonDocument document = parse_json(text, path);
  return read_figure(document.cursor());
}

}  // namespace mapproof
