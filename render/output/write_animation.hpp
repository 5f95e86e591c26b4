#pragma once

#include <filesystem>

#include "render/scene/film.hpp"
#include "render/scene_client/scene_client.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// Writes ID.apng at the theme's dpi, each frame drawn as a scene's PNG is, with the titles and
/// records of the last frame as its texts.
/// @throws InvalidInput if a frame cannot be drawn or their sizes differ; IoError; SceneError;
///         AnimationError.
void write_animation(const Film& film, const Theme& theme, const std::filesystem::path& folder,
                     SceneClient& client);

}  // namespace mapproof
