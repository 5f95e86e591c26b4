#include "render/style/figure_style.hpp"

#include <charconv>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLargestFont = std::size_t{1} << 26;  // Bytes.

void take(const std::string& hex, Colour& to) {
  if (hex.empty()) return;
  std::uint32_t rgb = 0;
  std::from_chars(hex.data() + 1, hex.data() + hex.size(), rgb, 16);
  to = colour(rgb);
}

void take(const std::optional<double>& value, double& to, double factor = 1.0) {
  if (value) to = factor * *value;
}

}  // namespace

Theme theme_of(const FigureStyle& style) {
  constexpr double kPointsPerInch = 72.0;
  constexpr double kColumn_in = 3.25;
  Theme theme = style.theme == BaseTheme::kPaper  ? paper_theme(style.width_in.value_or(kColumn_in))
                : style.theme == BaseTheme::kDark ? dark_theme()
                                                  : report_theme();
  if (style.theme != BaseTheme::kPaper && style.width_in) {
    theme.height_pt *= kPointsPerInch * *style.width_in / theme.width_pt;
    theme.width_pt = kPointsPerInch * *style.width_in;
  }
  take(style.height_in, theme.height_pt, kPointsPerInch);
  take(style.dpi, theme.dpi);
  theme.draws_title = style.draws_title.value_or(theme.draws_title);
  theme.draws_notes = style.draws_notes.value_or(theme.draws_notes);
  take(style.font_pt, theme.font_pt);
  take(style.tick_font_pt, theme.tick_font_pt);
  take(style.title_font_pt, theme.title_font_pt);
  take(style.line_pt, theme.line_pt);
  take(style.hairline_pt, theme.hairline_pt);
  take(style.marker_pt, theme.marker_pt);
  take(style.space_pt, theme.space_pt);
  take(style.colours.background, theme.background);
  take(style.colours.text, theme.text);
  take(style.colours.muted, theme.muted);
  take(style.colours.grid, theme.grid);
  take(style.colours.warning, theme.warning);
  for (std::size_t i = 0; i < style.colours.series.size(); ++i)
    take(style.colours.series[i], theme.series.at(i));
  if (!style.font.empty())
    theme.font = std::make_shared<const Font>(read_file(style.font, kLargestFont), style.font);
  return theme;
}

}  // namespace mapproof
