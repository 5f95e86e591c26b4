#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "core/base/files/files.hpp"
#include "render/output/write_figure.hpp"
#include "render/output/write_scene.hpp"
#include "tests/support/samples/sample_figures.hpp"
#include "tests/support/samples/sample_scenes.hpp"

/// Draws the sample figures and scenes whose ids begin with PREFIX into a folder, in every theme,
/// for people to look at.
int main(int argc, char** argv) {
  using namespace mapproof;
  if (argc != 2 && argc != 3) {
    std::fputs("usage: draw_samples FOLDER [PREFIX]\n", stderr);
    return 2;
  }
  const auto wanted = [&](const std::string& id) { return argc == 2 || id.starts_with(argv[2]); };
  SceneClient client(MAPPROOF_SCENES_PROGRAM);
  for (const auto& [name, theme] : {std::pair{"report", report_theme()},
                                    {"single", paper_theme(3.25)},
                                    {"double", paper_theme(6.75)}}) {
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / name;
    for (const Figure& figure : test::sample_figures())
      if (wanted(figure.id)) write_figure(figure, theme, folder);
    for (const Scene& scene : test::sample_scenes())
      if (wanted(scene.id)) write_scene(scene, theme, folder, client);
  }
}
