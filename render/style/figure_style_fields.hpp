#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/json/fields.hpp"
#include "render/style/figure_style.hpp"

namespace mapproof {

/// The style that a file holds (docs/schemas/style.schema.json). A font in it is relative to the
/// folder of the file.
/// @throws IoError with the file and the JSON pointer.
FigureStyle read_figure_style(const std::filesystem::path& file);

/// The same from its text; a font stays as it is written.
FigureStyle figure_style_from_json(std::string_view text, const std::string& source);

// The fields of a style in files (core/json/fields.hpp).

inline EnumNames enum_names(BaseTheme) {
  static constexpr std::array<std::string_view, 3> kNames = {"report", "dark", "paper"};
  return {"theme", kNames};
}

namespace style_rules {

inline bool is_hex_colour(std::string_view text) {
  return text.size() == 7 && text[0] == '#' &&
         text.find_first_not_of("0123456789abcdefABCDEF", 1) == text.npos;
}

inline constexpr TextForm kColour = {"^#[0-9a-fA-F]{6}$", is_hex_colour, "a colour as #rrggbb"};

constexpr FieldRule colour_rule(std::string_view description) {
  return {.description = description, .form = &kColour, .key = Key::kIfAny};
}

constexpr FieldRule size_rule(std::string_view description, double least, double most) {
  return {.description = description, .minimum = least, .maximum = most, .key = Key::kIfAny};
}

}  // namespace style_rules

template <typename Visitor>
void fields(Visitor& v, StyleColours& colours) {
  using style_rules::colour_rule;
  v.type("colours");
  v.about("Each as #rrggbb.");
  v.field("background", colours.background, colour_rule("Of the page."));
  v.field("text", colours.text, colour_rule("Of texts, frames and ticks."));
  v.field("muted", colours.muted, colour_rule("Of errors and of what helps the eye."));
  v.field("grid", colours.grid, colour_rule("Of grid lines."));
  v.field("warning", colours.warning, colour_rule("Of texts about warnings."));
  v.field("series", colours.series,
          {.description = "Of curves and points, in their order: the first ones of ten.",
           .max_items = kSeriesCount,
           .form = &style_rules::kColour,
           .key = Key::kIfAny});
}

template <typename Visitor>
void fields(Visitor& v, FigureStyle& style) {
  using style_rules::size_rule;
  v.file("mapproof.style",
         "How figures are drawn by mapproof render --style. What is left out is the theme's.");
  v.field("theme", style.theme,
          {.description = "What the style begins with. Missing: report.", .key = Key::kOptional});
  v.field("width_in", style.width_in, size_rule("Width of the page in inches.", 2.0, 20.0));
  v.field("height_in", style.height_in,
          size_rule("Height of the page in inches; of several panels, of one row.", 1.0, 20.0));
  v.field("dpi", style.dpi, size_rule("Pixels per inch of PNG.", 30.0, 1200.0));
  v.field("draws_title", style.draws_title,
          {.description = "Whether the title is drawn. Missing: in the theme report.",
           .key = Key::kIfAny});
  v.field("draws_notes", style.draws_notes,
          {.description = "Whether scores, remarks and warnings are drawn below the title, which "
                          "the caption has else. Missing: in the theme report.",
           .key = Key::kIfAny});
  v.field("font", style.font,
          {.description = "TrueType or OpenType file, relative to this one.", .key = Key::kIfAny});
  v.field("font_pt", style.font_pt, size_rule("Size of axis labels, legend and notes.", 3, 72));
  v.field("tick_font_pt", style.tick_font_pt, size_rule("Size of tick labels.", 3, 72));
  v.field("title_font_pt", style.title_font_pt, size_rule("Size of titles.", 3, 72));
  v.field("line_pt", style.line_pt, size_rule("Width of curves.", 0.1, 20));
  v.field("hairline_pt", style.hairline_pt, size_rule("Width of frame and ticks.", 0.1, 10));
  v.field("marker_pt", style.marker_pt, size_rule("Diameter of markers.", 0.5, 50));
  v.field("space_pt", style.space_pt, size_rule("The unit of all gaps.", 0.5, 40));
  v.field("colours", style.colours,
          {.description = "Colours that replace those of the theme.", .key = Key::kOptional});
  v.field("language", style.language,
          {.description = "Of the words: en, de, fr or es. Missing: en.", .key = Key::kIfAny});
  v.field("words", style.words,
          {.description = "Phrases of texts, and what replaces them.", .key = Key::kOptional});
}

}  // namespace mapproof
