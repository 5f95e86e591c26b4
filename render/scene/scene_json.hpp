#pragma once

#include <string>
#include <string_view>

#include "render/scene/scene.hpp"

namespace mapproof {

/// The scene as JSON (docs/schemas/scene.schema.json): doubles round-trip, NaN is null, a line feed
/// at the end. The same scene gives the same bytes.
std::string scene_to_json(const Scene& scene);

/// The scene that such JSON holds. @throws IoError with `path` and the JSON pointer of what is
/// wrong.
Scene scene_from_json(std::string_view text, const std::string& path);

/// The same on one line.
std::string scene_to_line(const Scene& scene);

}  // namespace mapproof
