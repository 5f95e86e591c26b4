#pragma once

#include <array>
#include <tuple>

#include "core/json/fields.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

// The fields of a figure in files (core/json/fields.hpp), and what its enumerators are called
// there.

inline EnumNames enum_names(ThemeColour) {
  static constexpr std::array<std::string_view, 14> kNames = {
      "text",    "muted",   "faint",   "warning", "series1", "series2", "series3",
      "series4", "series5", "series6", "series7", "series8", "series9", "series10"};
  return {"colour", kNames};
}

inline EnumNames enum_names(Dash) {
  static constexpr std::array<std::string_view, 5> kNames = {"solid", "dashed", "dotted",
                                                             "dash-dot", "long-dash"};
  return {"dash", kNames};
}

inline EnumNames enum_names(Marker) {
  static constexpr std::array<std::string_view, 8> kNames = {
      "none", "circle", "square", "triangle", "diamond", "triangle-down", "cross", "plus"};
  return {"marker", kNames};
}

inline EnumNames enum_names(Fill) {
  static constexpr std::array<std::string_view, 4> kNames = {"none", "tint", "solid", "paper"};
  return {"fill", kNames};
}

inline EnumNames enum_names(Ramp) {
  static constexpr std::array<std::string_view, 2> kNames = {"colour", "viridis"};
  return {"ramp", kNames};
}

inline EnumNames enum_names(Align) {
  static constexpr std::array<std::string_view, 3> kNames = {"start", "middle", "end"};
  return {"align", kNames};
}

inline EnumNames enum_names(Scale) {
  static constexpr std::array<std::string_view, 2> kNames = {"linear", "log"};
  return {"scale", kNames};
}

inline auto as_tuple(Range& range) { return std::tie(range.low, range.high); }

namespace figure_rules {

/// Names are others', and repeated in marks.
inline constexpr std::size_t kLongestText = 100'000'000;
inline constexpr FieldRule kText = {.max_bytes = kLongestText};
/// NaN, which is null: nothing is drawn there.
inline constexpr FieldRule kNumbers = {.nullable = true};
inline constexpr FieldRule kSize = {.minimum = 0.0, .maximum = 100.0, .above_minimum = true};
inline constexpr FieldRule kCount = {.minimum = 0.0, .maximum = 1e9};

inline constexpr TextForm kFigureId = {"^[a-z][a-z0-9-]{0,119}$", is_figure_id,
                                       "a letter a-z and then up to 119 of a-z, 0-9 and '-'"};
inline constexpr TextForm kMarkId = {
    "^[a-z0-9-]*$",
    [](std::string_view text) {
      return text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == text.npos;
    },
    "a-z, 0-9 and '-'"};

inline constexpr FieldRule described(FieldRule rule, std::string_view description) {
  rule.description = description;
  return rule;
}

}  // namespace figure_rules

template <typename Visitor>
void fields(Visitor& v, Mark& mark) {
  v.type("mark");
  v.field("id", mark.id, {.max_bytes = figure_rules::kLongestText, .form = &figure_rules::kMarkId});
  v.field("data", mark.data, figure_rules::kText);
}

/// The fields of a colour scale are among those of its layer, in two places.
/// @param is_coloured  Whether the layer has values; otherwise these are not written.
template <typename Visitor>
void ramp_fields(Visitor& v, ColourScale& colours, Key key, bool is_coloured) {
  v.field("limits", colours.limits, {.key = key, .written = is_coloured});
  v.field("ramp", colours.ramp, {.key = key, .written = is_coloured});
}

template <typename Visitor>
void bar_fields(Visitor& v, ColourScale& colours) {
  v.field("scale", colours.scale,
          {.description = "Of the values along the ramp. Missing: linear.",
           .key = Key::kOptional,
           .written = colours.scale != Scale::kLinear});
  v.field("bar_label", colours.bar_label,
          {.description = "Of a colour bar beside the frame. Missing: there is none.",
           .max_bytes = figure_rules::kLongestText,
           .key = Key::kIfAny});
}

template <typename Visitor>
void fields(Visitor& v, Polyline& line) {
  using namespace figure_rules;
  v.tag("kind", "polyline");
  v.field("label", line.label, kText);
  v.field("x", line.x, kNumbers);
  v.field("y", line.y, kNumbers);
  v.field("colour", line.colour);
  v.field("dash", line.dash);
  v.field("width", line.width, kSize);
  v.field("marker", line.marker);
  v.field("mark", line.mark);
  v.field("values", line.values,
          {.description = "As many as points, or none: each piece has the colour of the greater "
                          "value of its ends. Missing: none.",
           .nullable = true,
           .key = Key::kIfAny});
  ramp_fields(v, line.colour_scale, Key::kOptional, !line.values.empty());
  bar_fields(v, line.colour_scale);
}

template <typename Visitor>
void fields(Visitor& v, Band& band) {
  using namespace figure_rules;
  v.tag("kind", "band");
  v.field("label", band.label, kText);
  v.field("x", band.x, kNumbers);
  v.field("low", band.low, kNumbers);
  v.field("high", band.high, kNumbers);
  v.field("colour", band.colour);
  v.field("mark", band.mark);
}

template <typename Visitor>
void fields(Visitor& v, Scatter& points) {
  using namespace figure_rules;
  v.tag("kind", "scatter");
  v.field("label", points.label, kText);
  v.field("x", points.x, kNumbers);
  v.field("y", points.y, kNumbers);
  v.field("colour", points.colour);
  v.field("marker", points.marker);
  v.field("filled", points.filled);
  v.field("size", points.size, kSize);
  v.field("marks", points.marks);
}

template <typename Visitor>
void fields(Visitor& v, Segments& lines) {
  using namespace figure_rules;
  v.tag("kind", "segments");
  v.field("label", lines.label, kText);
  v.field("x0", lines.x0, kNumbers);
  v.field("y0", lines.y0, kNumbers);
  v.field("x1", lines.x1, kNumbers);
  v.field("y1", lines.y1, kNumbers);
  v.field("colour", lines.colour);
  v.field("dash", lines.dash);
  v.field("width", lines.width, kSize);
  v.field("arrow", lines.arrow);
  v.field("marks", lines.marks);
}

template <typename Visitor>
void fields(Visitor& v, PointLabels& labels) {
  using namespace figure_rules;
  v.tag("kind", "labels");
  v.field("x", labels.x, kNumbers);
  v.field("y", labels.y, kNumbers);
  v.field("text", labels.text, kText);
  v.field("colour", labels.colour);
}

template <typename Visitor>
void fields(Visitor& v, Area& area) {
  using namespace figure_rules;
  v.tag("kind", "area");
  v.about("Closed outlines; null ends one and begins the next.");
  v.field("label", area.label, kText);
  v.field("x", area.x, kNumbers);
  v.field("y", area.y, kNumbers);
  v.field("colour", area.colour);
  v.field("fill", area.fill);
  v.field("outlined", area.outlined);
  v.field("dash", area.dash);
  v.field("width", area.width, kSize);
  v.field("mark", area.mark);
}

template <typename Visitor>
void fields(Visitor& v, Ellipses& ellipses) {
  using namespace figure_rules;
  v.tag("kind", "ellipses");
  v.about("Half axes a and b in data units; a is turned from the x axis.");
  v.field("label", ellipses.label, kText);
  v.field("x", ellipses.x, kNumbers);
  v.field("y", ellipses.y, kNumbers);
  v.field("a", ellipses.a, {.minimum = 0.0, .nullable = true});
  v.field("b", ellipses.b, {.minimum = 0.0, .nullable = true});
  v.field("rotation_rad", ellipses.rotation_rad, kNumbers);
  v.field("colour", ellipses.colour);
  v.field("fill", ellipses.fill);
  v.field("dash", ellipses.dash);
  v.field("width", ellipses.width, kSize);
  v.field("marks", ellipses.marks);
}

template <typename Visitor>
void fields(Visitor& v, Cells& cells) {
  using namespace figure_rules;
  v.tag("kind", "cells");
  v.about("A matrix row by row, the uppermost row first, between the edges x and y.");
  v.field("label", cells.label, kText);
  v.field("x", cells.x);
  v.field("y", cells.y);
  v.field("columns", cells.columns, kCount);
  v.field("values", cells.values, kNumbers);
  ramp_fields(v, cells.colour_scale, Key::kRequired, true);
  v.field("colour", cells.colour);
  v.field("mark", cells.mark);
  bar_fields(v, cells.colour_scale);
  v.field("text", cells.text,
          {.description = "As many as values, or none.",
           .max_bytes = kLongestText,
           .key = Key::kIfAny});
}

template <typename Visitor>
void fields(Visitor& v, Texts& texts) {
  using namespace figure_rules;
  v.tag("kind", "texts");
  v.field("x", texts.x, kNumbers);
  v.field("y", texts.y, kNumbers);
  v.field("text", texts.text, kText);
  v.field("align", texts.align);
  v.field("colour", texts.colour);
}

template <typename Visitor>
void fields(Visitor& v, ImageLayer& image) {
  using namespace figure_rules;
  v.tag("kind", "image");
  v.about("Where a raster image is painted, and squares in it that stay free of labels.");
  v.field("x", image.x);
  v.field("y", image.y);
  v.field("source", image.source, kCount);
  v.field("clear_x", image.clear_x, kNumbers);
  v.field("clear_y", image.clear_y, kNumbers);
  v.field("clear_by", image.clear_by,
          {.description = "Half their sides.", .minimum = 0.0, .nullable = true});
}

template <typename Visitor>
void fields(Visitor& v, Axis& axis) {
  using namespace figure_rules;
  v.type("axis");
  v.field("label", axis.label, kText);
  v.field("scale", axis.scale);
  v.field("limits", axis.limits);
  v.field("whole", axis.whole,
          {.description = "Ticks at whole numbers alone. Missing: false.", .key = Key::kOptional});
  v.field("names", axis.names,
          {.description = "Of the numbers 0, 1, ..., instead of them. Missing: none.",
           .max_bytes = kLongestText,
           .key = Key::kIfAny});
}

template <typename Visitor>
void fields(Visitor& v, Panel& panel) {
  using namespace figure_rules;
  v.type("panel");
  v.field("title", panel.title, kText);
  v.field("x", panel.x);
  v.field("y", panel.y);
  v.field("equal_aspect", panel.equal_aspect);
  v.field("bare", panel.bare,
          {.description = "Without axes. Missing: false.", .key = Key::kOptional});
  v.field("layers", panel.layers);
}

template <typename Visitor>
void fields(Visitor& v, Note& note) {
  v.type("note");
  v.field("text", note.text, figure_rules::kText);
  v.field("colour", note.colour);
}

template <typename Visitor>
void fields(Visitor& v, PanelArrow& arrow) {
  using namespace figure_rules;
  v.type("arrow");
  v.about("From a panel, counted from 0, to the next one.");
  v.field("from", arrow.from, kCount);
  v.field("label", arrow.label, kText);
}

template <typename Visitor>
void fields(Visitor& v, Figure& figure) {
  using namespace figure_rules;
  v.file("mapproof.figure",
         "A figure as a value: what is drawn, not how. Written by mapproof as ID.figure.json.");
  v.field("id", figure.id, {.form = &kFigureId});
  v.field("title", figure.title, kText);
  v.field("caption", figure.caption, kText);
  v.field("alt", figure.alt, described(kText, "What the figure shows, in words with numbers."));
  v.field("records", figure.record_ids,
          described(kText, "Ids of the records that it was made from."));
  v.field("varies", figure.varies,
          {.description = "True if it shows what differs from run to run, such as seconds."});
  v.field("notes", figure.notes);
  v.field("panels", figure.panels, {.description = "Row by row.", .min_items = 1});
  // Figures written before there were grids of panels have none of these.
  v.field("columns", figure.columns,
          {.description = "Most panels in a row; 0: all. Missing: 0.",
           .minimum = 0.0,
           .maximum = 1e9,
           .key = Key::kOptional});
  v.field("shared_x", figure.shared_x,
          {.description = "One x axis for all panels. Missing: false.", .key = Key::kOptional});
  v.field("shared_y", figure.shared_y,
          {.description = "One y axis for all panels. Missing: false.", .key = Key::kOptional});
  v.field("arrows", figure.arrows, {.description = "Missing: none.", .key = Key::kOptional});
}

}  // namespace mapproof
