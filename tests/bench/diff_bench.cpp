#include <cstdio>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "core/base/files.hpp"
#include "render/image/png.hpp"
#include "reports/diff/picture_diff.hpp"

/// Compares two pictures, or all of two folders, and writes the heat maps of those that differ.
int main(int argc, char** argv) {
  using namespace mapproof;
  namespace fs = std::filesystem;
  if (argc != 3 && argc != 4) {
    std::fputs("usage: diff_bench BASELINE CURRENT [HEAT_MAP]\n", stderr);
    return 2;
  }
  const auto compare = [&](const fs::path& baseline, const fs::path& current,
                           const fs::path& heat) {
    Image map;
    const PictureDiff diff = picture_diff(baseline, current, {}, argc == 4 ? &map : nullptr);
    fmt::print("{}: {}: {}\n", baseline.filename().string(), name(diff.state), diff.reason);
    if (map.width > 0 && diff.state == PictureState::kDifferent) write_file(heat, encode_png(map));
  };
  const fs::path heat = argc == 4 ? argv[3] : "";
  if (!fs::is_directory(argv[1])) {
    compare(argv[1], argv[2], heat);
    return 0;
  }
  for (const auto& entry : fs::directory_iterator(argv[1]))
    compare(entry.path(), argv[2] / entry.path().filename(), heat / entry.path().filename());
}
