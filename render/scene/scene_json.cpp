#include "render/scene/scene_json.hpp"

#include "core/base/errors.hpp"
#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"

namespace mapproof {

std::string scene_to_json(const Scene& scene) { return to_json_text(scene); }

std::string scene_to_line(const Scene& scene) { return json_line(to_json_value(scene)); }

Scene scene_from_json(std::string_view text, const std::string& path) {
  Scene scene = from_json_text<Scene>(text, path);
  if (const std::string what = problem(scene); !what.empty()) throw IoError(path, "/" + what);
  return scene;
}

}  // namespace mapproof
