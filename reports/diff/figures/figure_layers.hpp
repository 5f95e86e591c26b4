#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/plot/figure.hpp"

namespace mapproof {

/// One attribute of a layer as text.
struct LayerStyle {
  std::string_view what;  ///< "colour".
  std::string value;      ///< "series2".
};

/// Numbers of a layer, one per point.
struct Coordinates {
  std::string_view name;  ///< "x0".
  std::span<const double> values;
};

/// A number of the whole layer.
struct LayerExtent {
  std::string_view what;  ///< "left edge".
  double value = 0.0;
};

/// The coordinates that form a position of each point.
struct Locations {
  std::size_t x = 0;  ///< Index into LayerView::coordinates.
  std::size_t y = 0;
};

/// A uniform view of any layer. Refers to the layer.
struct LayerView {
  std::string_view kind;  ///< As in files: "polyline".
  std::string label;
  std::vector<LayerStyle> styles;
  std::vector<Coordinates> coordinates;
  std::vector<Locations> locations;
  std::vector<LayerExtent> extents;
  std::span<const std::string> texts;  ///< One per point, or none.
  std::span<const Mark> marks;         ///< One per point, one for all, or none.
  bool is_whole = false;               ///< The mark belongs to the whole layer.

  std::size_t points() const { return coordinates.empty() ? 0 : coordinates[0].values.size(); }
  bool has_mark_a_point() const { return !is_whole && marks.size() == points(); }
};

LayerView view_of(const Layer& layer);

/// The value of an attribute of a mark; empty if it has none of that name.
std::string_view data_of(const Mark& mark, std::string_view key);

}  // namespace mapproof
