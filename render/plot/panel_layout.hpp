#pragma once

#include <set>
#include <string>
#include <vector>

#include "render/plot/axes_layout.hpp"
#include "render/plot/drawing.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// Lays one panel out in `cell`: axes, legend, layers and labels.
/// @param known  Labels that panels before have: a legend of no others is left out.
void lay_out_panel(const Panel& panel, std::size_t panel_index, const Box& cell, const Theme& theme,
                   Drawing& drawing, const std::set<std::string>& known = {});

/// The labels of its layers, but for empty ones.
std::set<std::string> labels_of(const Panel& panel);

/// Draws a panel whose axes stand already: grid, layers, frame and labels of the axes.
void draw_panel(const AxesLayout& layout, std::size_t panel_index, const Axes& axes,
                Drawing& drawing);

/// A line of a panel's title as it is drawn, and what was asked for.
struct TitleLine {
  ShapedText shaped;
  std::string whole;
};

/// The lines of a title, split at line feeds, each wrapped to at most two of `most` em.
std::vector<TitleLine> title_lines(const std::string& title, double most, const Font* font);

/// Draws the panel's title. @return The room left below.
Box draw_panel_title(const Panel& panel, std::size_t index, const Box& cell, const Theme& theme,
                     Drawing& drawing);

}  // namespace mapproof
