#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/theme/theme.hpp"

namespace mapproof {

/// The theme that a style begins with.
enum class BaseTheme { kReport, kDark, kPaper };

/// Colours that replace those of the theme, as "#rrggbb"; empty: the theme's.
struct StyleColours {
  std::string background = {}, text = {}, muted = {}, grid = {}, warning = {};
  std::vector<std::string> series = {};  ///< The first ones of ten.
};

/// How a person wants figures drawn; what is left out is the theme's. Lengths in inches or points.
struct FigureStyle {
  BaseTheme theme = BaseTheme::kReport;
  std::optional<double> width_in = {}, height_in = {}, dpi = {};
  std::optional<bool> draws_title = {};  ///< The report's theme draws it, the paper's does not.
  std::optional<bool> draws_notes = {};  ///< Likewise.
  std::string font = {};                 ///< File; empty: the embedded font.
  std::optional<double> font_pt = {}, tick_font_pt = {}, title_font_pt = {};
  std::optional<double> line_pt = {}, hairline_pt = {}, marker_pt = {}, space_pt = {};
  StyleColours colours = {};
  std::string language = {};  ///< Of the words, see languages(); empty: English.
  std::map<std::string, std::string> words = {};  ///< Phrases and what replaces them in all texts.
};

/// The theme that a style amounts to; reads its font.
/// @throws InvalidInput for a font that cannot be used; IoError if it cannot be read.
Theme theme_of(const FigureStyle& style);

}  // namespace mapproof
