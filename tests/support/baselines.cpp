#include "tests/support/baselines.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "core/base/files.hpp"
#include "render/image/compare.hpp"
#include "render/image/png.hpp"
#include "render/image/png_read.hpp"
#include "tests/support/sample_figures.hpp"

namespace mapproof::test {

namespace fs = std::filesystem;

Theme baseline_theme() {
  Theme theme = paper_theme(480.0 / 144.0);
  theme.name = "baseline";
  theme.height_pt = 180.0;
  theme.dpi = 144.0;
  theme.draws_title = true;
  return theme;
}

std::vector<Figure> baseline_figures() {
  std::vector<Figure> figures = sample_figures();
  std::erase_if(figures, [](const Figure& figure) {
    for (const char* id :
         {"map-usual",           "map-one-far-off", "map-some-missing", "map-shape",
          "curve-usual",         "curve-log",       "curve-filled",     "measurement-visibility",
          "measurement-bearing", "parameter-usual", "ranks-10",         "ellipses-usual",
          "shepard-usual",       "spectrum-usual",  "film-four",        "pair-usual",
          "idea-visibility",     "anchors-usual",   "levels-usual",     "occlusion-usual",
          "pareto-usual",        "path-usual",      "path-walk",        "convergence-usual",
          "cost-usual",          "singular-usual",  "windows-usual",    "starts-usual",
          "wall-eleven"})
      if (figure.id == id) return false;
    return true;
  });
  return figures;
}

std::string difference_from_baseline(const std::string& name, const Image& image) {
  const fs::path baseline = fs::path(MAPPROOF_BASELINES) / (name + ".png");
  const fs::path candidate = fs::path(MAPPROOF_VISUAL) / (name + ".png");
  const std::string png = encode_png(image);
  std::string difference;
  if (!fs::exists(baseline)) {
    difference = "there is no baseline " + baseline.string();
  } else {
    // As stored: the encoder may have moved a few colours.
    const ImageDifference found =
        compare_images(read_png(read_file(baseline)).image, read_png(png).image);
    if (is_alike(found)) {
      fs::remove(candidate);
      return {};
    }
    difference =
        fmt::format("{}: {}, {:.3f} % of pixels changed, least structure {:.3f}, shift {:.1f}",
                    name, found.same_size ? "same size" : "another size",
                    100.0 * found.changed_share, found.structure, found.shift);
  }
  write_file(candidate, png);
  return difference + "; the candidate is " + candidate.string();
}

}  // namespace mapproof::test
