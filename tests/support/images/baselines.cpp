#include "tests/support/images/baselines.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/files/files.hpp"
#include "render/image/png.hpp"
#include "render/image/png_read.hpp"
#include "tests/support/images/image_difference.hpp"
#include "tests/support/samples/sample_figures.hpp"

namespace mapproof::test {

namespace fs = std::filesystem;

Theme baseline_theme() {
  Theme theme = paper_theme(480.0 / 144.0);
  theme.name = "baseline";
  theme.height_pt = 180.0;
  theme.dpi = 144.0;
  theme.draws_title = true;
  theme.draws_notes = true;
  return theme;
}

namespace {

/// NAME.png and NAME@KEY.png, as far as they are there.
std::vector<fs::path> baselines_of(const std::string& name) {
  std::vector<fs::path> found;
  for (const fs::path& file : fs::directory_iterator(MAPPROOF_BASELINES)) {
    const std::string stem = file.stem().string();
    if (file.extension() == ".png" && stem.substr(0, stem.find('@')) == name) found.push_back(file);
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace

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
          "wall-eleven",         "heat-usual",      "path-errors"})
      if (figure.id == id) return false;
    return true;
  });
  return figures;
}

std::string baseline_png(const Image& image) { return encode_png(image); }

std::string difference_from_baseline(const std::string& name, const Image& image) {
  const fs::path candidate = fs::path(MAPPROOF_VISUAL) / "differing" / (name + ".png");
  const std::string png = baseline_png(image);
  // As stored: the encoder may have moved a few colours.
  const Image stored = read_png(png).image;
  std::string difference;
  for (const fs::path& baseline : baselines_of(name)) {
    const ImageDifference found = image_difference(read_png(read_file(baseline)).image, stored);
    if (is_alike(found)) {
      fs::remove(candidate);
      return {};
    }
    difference +=
        fmt::format("{}: {}, {:.3f} % of pixels changed, least structure {:.3f}, shift {:.1f}; ",
                    baseline.filename().string(), found.same_size ? "same size" : "another size",
                    100.0 * found.changed_share, found.structure, found.shift);
  }
  if (difference.empty()) difference = "there is no baseline " + name + "; ";
  write_file(candidate, png);
  return difference + "the candidate is " + candidate.string();
}

}  // namespace mapproof::test
