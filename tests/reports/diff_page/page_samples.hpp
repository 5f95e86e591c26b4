#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/diff/diff_result.hpp"

namespace mapproof::test {

/// A white PNG with a dark square of 8 pixels at (x, y).
std::string square_png(int width, int height, int x, int y);

/// Two folders below `folder`, compared: "moved", "resized", "gone", "added", "broken" (PNG
/// cut short) and "same-1" to "same-N"; with "drawn", two SVGs.
DiffResult compared_folders(const std::filesystem::path& folder, int same = 3);

/// A result with a hostile text in every field, and those texts. Its images are those of
/// `folder`, an SVG with a script and a reference to a host among them.
struct HostileDiff {
  DiffResult result;
  std::vector<std::string> texts;
};
HostileDiff hostile_diff(const std::filesystem::path& folder);

}  // namespace mapproof::test
