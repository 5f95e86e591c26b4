#include "render/output/write_animation.hpp"

#include "core/base/files.hpp"
#include "render/animation/animation.hpp"
#include "render/cairo/cairo_backend.hpp"
#include "render/output/write_scene.hpp"

namespace mapproof {

void write_animation(const Film& film, const Theme& theme, const std::filesystem::path& folder,
                     SceneClient& client) {
  std::vector<Image> frames;
  AnimationOptions options;
  for (const Scene& scene : film.frames) {
    Drawing drawing = draw_scene(scene, theme, client).screen;
    frames.push_back(to_image(drawing));
    if (frames.size() == 1)
      require_animation_size(frames[0].width, frames[0].height, film.frames.size());
    drawing.id = film.id;
    options.texts = png_words(drawing);
  }
  write_file(folder / (film.id + ".apng"), encode_animation(frames, options));
}

}  // namespace mapproof
