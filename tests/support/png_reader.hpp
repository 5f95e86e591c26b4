#pragma once

#include <map>
#include <string>
#include <string_view>

#include "render/image/image.hpp"

namespace mapproof::test {

/// What libpng finds in a PNG file.
struct PngFile {
  Image image;
  std::map<std::string, std::string> texts;
  unsigned pixels_per_metre = 0;
  bool has_time = false;
};

/// @throws std::runtime_error with libpng's words.
PngFile read_png(std::string_view bytes);

}  // namespace mapproof::test
