#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/command_line.hpp"
#include "render/style/figure_style.hpp"

namespace mapproof {

/// How a person wants figures drawn, as typed.
struct StyleArguments {
  std::optional<std::string> file, theme, title, font, language;
  std::optional<double> width_in, height_in, dpi;
  bool no_title = false;
  std::vector<std::string> landmarks;       ///< That are named: names, or "all" or "none" alone.
  std::vector<std::string> only_landmarks;  ///< That are shown.

  /// Whether figures will be others than in the report.
  bool changes_figures() const;
};

/// Adds --theme, --width, --height, --dpi, --title, --no-title, --landmarks, --only-landmarks,
/// --font, --language and --style.
void add_style_options(CLI::App& app, StyleArguments& arguments);

/// The style that they amount to: the file's under what was typed. @throws IoError, InvalidInput.
FigureStyle style_of(const StyleArguments& arguments);

}  // namespace mapproof
