#pragma once

#include <string>
#include <vector>

#include "render/image/image.hpp"

namespace mapproof::test {

struct ApngFrame {
  Image image;  ///< As a viewer has it on screen, upper bits zero.
  double seconds = 0.0;
};

struct Apng {
  unsigned plays = 0;  ///< 0: for ever.
  std::vector<ApngFrame> frames;
};

/// An animated PNG as a viewer shows it: each frame is decoded by libpng on its own and put on the
/// ones before. @throws std::runtime_error for what is none, by its checksums too.
Apng read_apng(const std::string& bytes);

}  // namespace mapproof::test
