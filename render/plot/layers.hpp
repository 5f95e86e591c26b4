#pragma once

#include <cstddef>

#include "render/plot/axis_map.hpp"
#include "render/plot/drawing.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// Draws the panel's layers, labels of points apart, clipped to its frame.
void draw_layers(const Panel& panel, std::size_t panel_index, const PanelMap& map,
                 const Theme& theme, Drawing& drawing);

bool has_image(const Panel& panel);

/// More bars side by side are too thin to be distinguished.
inline constexpr std::size_t kMostBars = 20;

/// Whether at some x more than three bands of the panel have a value in common: none of them could
/// be distinguished, and each is drawn as a bar per point, side by side.
bool bands_hide_each_other(const Panel& panel);

/// The lengths of a dash, in points; empty for a solid line.
std::vector<double> dash_lengths(Dash dash, double width_pt);

/// A line of that colour class, its width in the theme's lines.
Stroke stroke_of(ThemeColour colour, Dash dash, double width, const Theme& theme);

/// A shape without a path, filled so.
Shape filled_shape(Fill fill, ThemeColour colour, const Theme& theme);

/// How much of a band covers what is below.
inline constexpr double kBandOpacity = 0.2;

}  // namespace mapproof
