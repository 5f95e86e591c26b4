#pragma once

#include <array>
#include <string>

#include "render/theme/colour.hpp"
#include "render/theme/font.hpp"
#include "render/theme/theme_colour.hpp"

namespace mapproof {

/// All that a figure's style depends on, the figure itself apart. Lengths are in points (1/72 in).
struct Theme {
  std::string name;
  double width_pt = 0.0;
  double height_pt = 0.0;
  double dpi = 72.0;  ///< Of the PNG.

  FontHandle font = {};  ///< None: the embedded one.
  bool draws_title = true;
  bool draws_notes = true;  ///< Else the caption has them; a figure without content keeps them.
  double font_pt = 0.0;     ///< Axis labels, legend, notes.
  double tick_font_pt = 0.0;
  double title_font_pt = 0.0;
  double line_pt = 0.0;
  double hairline_pt = 0.0;  ///< Frame and ticks.
  double marker_pt = 0.0;    ///< Diameter.
  double space_pt = 0.0;     ///< The unit of all gaps.

  Colour background, text, muted, grid, warning;
  std::array<Colour, kSeriesCount> series;
  double faint = 0.5;   ///< Share of kMuted in kFaint; the rest is the background.
  double dashed = 0.0;  ///< Share of the text's colour in kMuted of lines with gaps.

  Colour of(ThemeColour colour) const;
  /// Of a line with gaps, which make it paler.
  Colour of_dashed(ThemeColour colour) const;
};

/// For screens: 600 x 450 pt, 1200 x 900 px.
Theme report_theme();

/// The same in the colours of a dark page.
Theme dark_theme();

/// For a journal: 8 pt text, 300 dpi, no title and no notes (the caption below the figure has
/// them).
/// @param width_in  Of the column, 2 to 20; 3.25 (single) and 6.75 (double) are usual.
/// @throws InvalidInput outside that.
Theme paper_theme(double width_in);

}  // namespace mapproof
