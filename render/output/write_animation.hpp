#pragma once

#include <filesystem>

#include "render/scene/film.hpp"
#include "render/scene_client/scene_client.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// Writes ID.apng at the theme's dpi, each frame drawn as the picture in a scene's SVG is,
/// with the titles and
/// records of the last frame as its texts.
/// @throws InvalidInput if a frame cannot be drawn, their sizes differ or they are too many (see
///         require_animation_size; told after the first); IoError; SceneError;
///         AnimationError.
void write_animation(const Film& film, const Theme& theme, const std::filesystem::path& folder,
                     SceneClient& client);

}  // namespace mapproof
