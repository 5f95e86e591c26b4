#pragma once

#include <string>

#include "core/base/files/output_folder.hpp"
#include "render/plot/drawing.hpp"
#include "render/scene/film.hpp"
#include "render/scene/scene.hpp"
#include "render/scene_client/scene_client.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// Writes ID.apng at the theme's dpi, each frame drawn as the image in a scene's SVG is,
/// with the titles and
/// records of the last frame as its texts.
/// @throws InvalidInput if a frame cannot be drawn, their sizes differ or they are too many (see
///         require_animation_size; checked after the first); IoError; SceneError;
///         AnimationError.
void write_animation(const Film& film, const Theme& theme, const OutputFolder& folder,
                     SceneClient& client);

/// A scene laid out, its images drawn: at the theme's dpi, and at twice that unless a side would
/// then have more than SceneClient::kLargestSide pixels.
struct SceneDrawing {
  Drawing screen;
  Drawing poster;
};

/// @throws InvalidInput if the scene cannot be drawn (see `problem`); SceneError.
SceneDrawing draw_scene(const Scene& scene, const Theme& theme, SceneClient& client);

/// Writes ID.svg with images at the theme's dpi, ID.png and ID.pdf at twice that, and
/// ID.scene.json, each at once or not at all.
/// @return The text of the SVG file.
/// @throws IoError; otherwise as draw_scene.
std::string write_scene(const Scene& scene, const Theme& theme, const OutputFolder& folder,
                        SceneClient& client);

}  // namespace mapproof
