#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>

#include "core/base/files/output_folder.hpp"
#include "render/animation/animation.hpp"
#include "render/output/file_format.hpp"
#include "render/plot/drawing.hpp"
#include "render/scene/film.hpp"
#include "render/scene/scene.hpp"
#include "render/scene_client/scene_client.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// How an animation is written.
struct AnimationJob {
  std::set<AnimationFormat> formats = {AnimationFormat::kApng};
  std::function<void(std::size_t)> drawn = {};  ///< Called with the number of frames drawn so far.
};

/// Writes ID.apng, or ID.mp4 or ID.gif, at the theme's dpi, each frame drawn as the image in a
/// scene's SVG is, with the titles and records of the last frame as its texts.
/// @throws InvalidInput if a frame cannot be drawn, their sizes differ or they are too many (see
///         require_animation_size; checked after the first); IoError; SceneError;
///         AnimationError.
void write_animation(const Film& film, const Theme& theme, const OutputFolder& folder,
                     SceneClient& client, const AnimationJob& job = {});

/// A scene laid out, its images drawn: at the theme's dpi, and at twice that unless a side would
/// then have more than SceneClient::kLargestSide pixels.
struct SceneDrawing {
  Drawing screen;
  Drawing poster;
  std::optional<Drawing> page = {};  ///< The screen's with dark images, if they were asked for.
};

/// Checks the sizes of a scene's images before anything is drawn.
/// @param formats  Files without images have no such bounds.
/// @throws InvalidInput if a side of one would have no pixel or more than
///         SceneClient::kLargestSide.
void require_scene_size(const Scene& scene, const Theme& theme, const FileFormats& formats);

/// Checks the size of a film's first frame, and the number of its frames.
/// @throws InvalidInput as require_scene_size() and require_animation_size().
void require_film_size(const Film& film, const Theme& theme);

/// @param dark  In whose colours the images of the screen are drawn once more, from the same light;
///              null: in none.
/// @throws InvalidInput if the scene cannot be drawn (see `problem`); SceneError.
SceneDrawing draw_scene(const Scene& scene, const Theme& theme, SceneClient& client,
                        const Theme* dark = nullptr);

/// Writes ID.svg with images at the theme's dpi, ID.png and ID.pdf at twice that, and
/// ID.scene.json, or as the formats say, each at once or not at all. The program that draws starts
/// only if one of them shows pixels.
/// @return The text of the SVG file, or with `dark` that of SceneDrawing::page; empty if SVG is
/// none
///         of the formats.
/// @throws IoError; otherwise as draw_scene.
std::string write_scene(const Scene& scene, const Theme& theme, const OutputFolder& folder,
                        SceneClient& client, const FileFormats& formats = usual_formats(),
                        const Theme* dark = nullptr);

}  // namespace mapproof
