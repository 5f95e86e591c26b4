#include <cstdio>
#include <filesystem>

#include "core/base/files/files.hpp"
#include "render/cairo/cairo_backend.hpp"
#include "render/output/write_scene.hpp"
#include "render/plot/figure_json.hpp"
#include "render/plot/layout.hpp"
#include "tests/support/images/baselines.hpp"
#include "tests/support/samples/sample_scenes.hpp"

namespace {

constexpr std::size_t kLargestValue = 128 << 10;  // For the sake of the checkout.

}  // namespace

/// Draws into a folder what tests/baselines holds: the chosen figures, with their values where
/// these are small, and all sample scenes. What is there already is removed.
int main(int argc, char** argv) {
  using namespace mapproof;
  if (argc != 2) {
    std::fputs("usage: draw_baselines FOLDER\n", stderr);
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::remove_all(folder);
  const Theme theme = test::baseline_theme();
  for (const Figure& figure : test::baseline_figures()) {
    write_file(folder / (figure.id + ".png"), to_png(lay_out(figure, theme)));
    const std::string value = figure_to_json(figure);
    if (value.size() <= kLargestValue) write_file(folder / (figure.id + ".figure.json"), value);
  }
  SceneClient client(MAPPROOF_SCENES_PROGRAM);
  for (const Scene& scene : test::sample_scenes())
    write_file(folder / ("scene-" + scene.id + ".png"),
               test::baseline_png(to_image(draw_scene(scene, theme, client).screen)));
}
