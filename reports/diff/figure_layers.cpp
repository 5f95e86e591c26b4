#include "reports/diff/figure_layers.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "render/plot/figure_json_names.hpp"

namespace mapproof {
namespace {

template <typename Names, typename Enum>
std::string_view name_in(const Names& names, Enum value) {
  return names[static_cast<std::size_t>(value)];
}

std::string layer_number(double value) { return fmt::format("{}", value); }
std::string yes_or_no(bool value) { return value ? "yes" : "no"; }
std::string range(const Range& range) { return fmt::format("{} to {}", range.low, range.high); }

struct Viewer {
  LayerView operator()(const Polyline& l) const {
    return {.kind = "polyline",
            .label = l.label,
            .looks = {{"colour", std::string(name(l.ink))},
                      {"dash", std::string(name(l.dash))},
                      {"width", layer_number(l.width)},
                      {"marker", std::string(name(l.marker))}},
            .coordinates = {{"x", l.x}, {"y", l.y}},
            .places = {{0, 1}},
            .extents = {},
            .texts = {},
            .marks = {&l.mark, 1},
            .is_whole = true};
  }
  LayerView operator()(const Band& l) const {
    return {.kind = "band",
            .label = l.label,
            .looks = {{"colour", std::string(name(l.ink))}},
            .coordinates = {{"x", l.x}, {"low", l.low}, {"high", l.high}},
            .places = {{0, 1}, {0, 2}},
            .extents = {},
            .texts = {},
            .marks = {&l.mark, 1},
            .is_whole = true};
  }
  LayerView operator()(const Scatter& l) const {
    return {.kind = "scatter",
            .label = l.label,
            .looks = {{"colour", std::string(name(l.ink))},
                      {"marker", std::string(name(l.marker))},
                      {"filled", yes_or_no(l.filled)},
                      {"size", layer_number(l.size)}},
            .coordinates = {{"x", l.x}, {"y", l.y}},
            .places = {{0, 1}},
            .extents = {},
            .texts = {},
            .marks = l.marks};
  }
  LayerView operator()(const Segments& l) const {
    return {.kind = "segments",
            .label = l.label,
            .looks = {{"colour", std::string(name(l.ink))},
                      {"dash", std::string(name(l.dash))},
                      {"width", layer_number(l.width)},
                      {"arrow", yes_or_no(l.arrow)}},
            .coordinates = {{"x0", l.x0}, {"y0", l.y0}, {"x1", l.x1}, {"y1", l.y1}},
            .places = {{0, 1}, {2, 3}},
            .extents = {},
            .texts = {},
            .marks = l.marks};
  }
  LayerView operator()(const PointLabels& l) const {
    return {.kind = "labels",
            .label = "",
            .looks = {{"colour", std::string(name(l.ink))}},
            .coordinates = {{"x", l.x}, {"y", l.y}},
            .places = {{0, 1}},
            .extents = {},
            .texts = l.text,
            .marks = {}};
  }
  LayerView operator()(const Area& l) const {
    return {.kind = "area",
            .label = l.label,
            .looks = {{"colour", std::string(name(l.ink))},
                      {"fill", std::string(name_in(figure_json::kFills, l.fill))},
                      {"outlined", yes_or_no(l.outlined)},
                      {"dash", std::string(name(l.dash))},
                      {"width", layer_number(l.width)}},
            .coordinates = {{"x", l.x}, {"y", l.y}},
            .places = {{0, 1}},
            .extents = {},
            .texts = {},
            .marks = {&l.mark, 1},
            .is_whole = true};
  }
  LayerView operator()(const Ellipses& l) const {
    return {.kind = "ellipses",
            .label = l.label,
            .looks = {{"colour", std::string(name(l.ink))},
                      {"fill", std::string(name_in(figure_json::kFills, l.fill))},
                      {"dash", std::string(name(l.dash))},
                      {"width", layer_number(l.width)}},
            .coordinates = {{"x", l.x}, {"y", l.y}, {"a", l.a}, {"b", l.b}, {"turn", l.turn_rad}},
            .places = {{0, 1}},
            .extents = {},
            .texts = {},
            .marks = l.marks};
  }
  LayerView operator()(const Cells& l) const {
    return {.kind = "cells",
            .label = l.label,
            .looks = {{"limits of the ramp", range(l.limits)},
                      {"ramp", std::string(name_in(figure_json::kRamps, l.ramp))},
                      {"colour", std::string(name(l.ink))},
                      {"columns", layer_number(static_cast<double>(l.columns))},
                      {"scale", l.scale == Scale::kLog ? "log" : "linear"},
                      {"label of the colour bar", l.bar_label}},
            .coordinates = {{"value", l.values}},
            .places = {},
            .extents = {{"left edge", l.x.low},
                        {"right edge", l.x.high},
                        {"lower edge", l.y.low},
                        {"upper edge", l.y.high}},
            .texts = {},
            .marks = {&l.mark, 1},
            .is_whole = true};
  }
  LayerView operator()(const Texts& l) const {
    return {.kind = "texts",
            .label = "",
            .looks = {{"align", std::string(name_in(figure_json::kAligns, l.align))},
                      {"colour", std::string(name(l.ink))}},
            .coordinates = {{"x", l.x}, {"y", l.y}},
            .places = {{0, 1}},
            .extents = {},
            .texts = l.text,
            .marks = {}};
  }
  LayerView operator()(const Picture& l) const {
    return {.kind = "picture",
            .label = "",
            .looks = {{"source", layer_number(static_cast<double>(l.source))}},
            .coordinates = {{"x", l.clear_x}, {"y", l.clear_y}, {"half a side", l.clear_by}},
            .places = {{0, 1}},
            .extents = {{"left edge", l.x.low},
                        {"right edge", l.x.high},
                        {"lower edge", l.y.low},
                        {"upper edge", l.y.high}},
            .texts = {},
            .marks = {}};
  }
};

}  // namespace

LayerView view_of(const Layer& layer) { return std::visit(Viewer(), layer); }

std::string_view name(Ink ink) { return name_in(figure_json::kInks, ink); }
std::string_view name(Dash dash) { return name_in(figure_json::kDashes, dash); }
std::string_view name(Marker marker) { return name_in(figure_json::kMarkers, marker); }

std::string_view data_of(const Mark& mark, std::string_view key) {
  const auto found = std::ranges::find(
      mark.data, key, [](const auto& item) { return std::string_view(item.first); });
  return found == mark.data.end() ? std::string_view() : std::string_view(found->second);
}

}  // namespace mapproof
