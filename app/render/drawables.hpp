#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "render/scene/film.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

/// What an input of `render` holds, as values that may be changed.
struct Drawables {
  std::filesystem::path root;  ///< Its folder of figures stands in this one.
  std::vector<Figure> figures;
  std::vector<Scene> scenes;
  std::vector<Film> films;  ///< Of a study alone.
};

/// Reads what can be drawn: the folder of a study, of a map or of a range-only map, any folder that
/// holds ID.figure.json or ID.scene.json or has them in its folder figures/, the page of a report,
/// which carries them, or one such file.
/// @throws IoError.
Drawables read_drawables(const std::filesystem::path& input);

std::vector<std::string> ids_of(const Drawables& drawables);

/// The figure that a panel shows: `panel` is the id of one in `from`, a file, or a folder, which
/// stands for its first figure.
/// @throws InvalidInput if there is none, or it is a scene; IoError.
Figure panel_figure(const std::string& panel, const std::optional<Drawables>& from);

}  // namespace mapproof
