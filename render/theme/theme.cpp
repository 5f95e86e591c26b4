#include "render/theme/theme.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "render/theme/palette.hpp"

namespace mapproof {
namespace {

Theme on_white() {
  Theme theme;
  theme.background = colour(0xFFFFFF);
  theme.text = colour(0x1A1A1A);
  theme.muted = colour(0x757575);
  theme.grid = colour(0xE4E4E4);
  theme.warning = colour(0xA33C00);
  theme.series = kSeriesColours;
  return theme;
}

}  // namespace

Colour Theme::of(ThemeColour colour) const {
  switch (colour) {
    case ThemeColour::kText:
      return text;
    case ThemeColour::kMuted:
      return muted;
    case ThemeColour::kFaint:
      return mix(muted, background, faint);
    case ThemeColour::kWarning:
      return warning;
    default:
      return series[static_cast<std::size_t>(colour) -
                    static_cast<std::size_t>(ThemeColour::kSeries1)];
  }
}

Colour Theme::of_dashed(ThemeColour colour) const {
  return colour == ThemeColour::kMuted ? mix(text, muted, dashed) : of(colour);
}

Theme report_theme() {
  Theme theme = on_white();
  theme.name = "report";
  theme.width_pt = 600.0;
  theme.height_pt = 450.0;
  theme.dpi = 144.0;
  theme.font_pt = 12.0;
  theme.tick_font_pt = 11.0;
  theme.title_font_pt = 14.0;
  theme.line_pt = 1.5;
  theme.hairline_pt = 0.75;
  theme.marker_pt = 6.0;
  theme.space_pt = 6.0;
  return theme;
}

Theme dark_theme() {
  Theme theme = report_theme();
  theme.name = "dark";
  theme.background = colour(0x15181C);
  theme.text = colour(0xE6E9ED);
  theme.muted = colour(0x9AA3AD);
  theme.grid = colour(0x2B3138);
  theme.warning = colour(0xF3AC72);
  theme.series = kDarkSeriesColours;
  theme.faint = 0.6;
  theme.dashed = 0.6;
  return theme;
}

Theme paper_theme(double width_in) {
  if (!(width_in >= 2.0 && width_in <= 20.0))
    throw InvalidInput(fmt::format("paper_theme: width {} in is not in 2 to 20", width_in));
  Theme theme = on_white();
  theme.name = fmt::format("paper-{}in", width_in);
  theme.width_pt = 72.0 * width_in;
  theme.height_pt = 72.0 * std::min(0.8 * width_in, 3.5);
  theme.dpi = 300.0;
  theme.draws_title = false;
  theme.draws_notes = false;
  theme.font_pt = 8.0;
  theme.tick_font_pt = 8.0;
  theme.title_font_pt = 8.0;
  theme.line_pt = 1.0;
  theme.hairline_pt = 0.5;
  theme.marker_pt = 4.0;
  theme.space_pt = 3.5;
  return theme;
}

}  // namespace mapproof
