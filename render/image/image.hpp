#pragma once

#include <cstdint>
#include <vector>

namespace mapproof {

/// Opaque pixels 0x00RRGGBB, row by row from the top; the upper eight bits have no meaning.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> pixels;

  const std::uint32_t* row(int y) const {
    return pixels.data() + static_cast<std::size_t>(y) * width;
  }
  std::uint32_t* row(int y) { return pixels.data() + static_cast<std::size_t>(y) * width; }
};

}  // namespace mapproof
