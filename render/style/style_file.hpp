#pragma once

#include <filesystem>

#include "render/style/figure_style.hpp"

namespace mapproof {

/// The style that a file holds (docs/schemas/style.schema.json). A font in it is relative to the
/// folder of the file.
/// @throws IoError with the file and the JSON pointer.
FigureStyle read_figure_style(const std::filesystem::path& file);

}  // namespace mapproof
