#pragma once

#include <optional>
#include <vector>

#include "render/plot/axis_map.hpp"
#include "render/plot/drawing.hpp"
#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// The rings of an area on the page, each closed; rings of fewer than three points are left out.
Outline area_path(const Area& area, const PanelMap& map);

/// The i-th ellipse on the page; empty if it holds a NaN.
Outline ellipse_path(const Ellipses& ellipses, std::size_t i, const PanelMap& map);

/// The closed parts of a path as polygons, curves as eight pieces each.
std::vector<std::vector<Point>> flattened(const Outline& path);

/// Boxes that together cover a polygon, and little more if it is convex.
std::vector<Box> covering_slices(const std::vector<Point>& ring);

/// The colour at `share` (0 to 1) of a ramp.
/// @param colour  For Ramp::kColour.
Colour ramp_colour(Ramp ramp, ThemeColour colour, double share, const Theme& theme);

/// One of `shades` equal steps along a ramp, 0 to shades - 1; -1 for NaN.
int shade_of(double value, const ColourScale& colours, int shades);

/// A line with values as strokes to be drawn in this order: its rim, which is seen on any page
/// where the colours are not, and one per shade of 64. A point without neighbours is a dot.
std::vector<Shape> coloured_line_shapes(const Polyline& line, const PanelMap& map,
                                        const Theme& theme);

/// A field as shapes to be drawn in this order, one a shade. Each covers all cells of its shade and
/// above, so that no background shows between neighbours.
std::vector<Shape> cell_shapes(const Cells& cells, const PanelMap& map, const Theme& theme);

/// The texts of cells in black or white, whichever reads better; none if one of them does not fit.
std::vector<TextLine> cell_texts(const Cells& cells, const PanelMap& map, const Theme& theme);

/// The i-th text at its place, no wider than .37 of the page: a longer one beside its point in
/// lines, see name_lines(). Empty if its position holds a NaN.
std::vector<TextLine> placed_text(const Texts& texts, std::size_t i, const PanelMap& map,
                                  const Theme& theme);

}  // namespace mapproof
