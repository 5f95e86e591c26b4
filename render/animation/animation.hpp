#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "render/image/image.hpp"

namespace mapproof {

/// No animation came: the program that encodes is missing or ended. One line.
class AnimationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct AnimationOptions {
  int frame_ms = 700;  ///< How long each frame is seen, in [1, 60000].
  std::vector<std::pair<std::string, std::string>> texts = {};  ///< As of PngOptions.
};

/// The program that encodes animations: what the environment's MAPPROOF_ANIMATION names, else
/// `mapproof-animation` beside the running program.
std::filesystem::path animation_program();

/// @throws InvalidInput, naming the limit, if no animation of so many frames can be made: fewer
/// than
///         two, a side not in 1 to 8192, more than 2^28 pixels in all.
void require_animation_size(int width, int height, std::size_t frames);

/// Frames of one size as an animated PNG that begins again at its end, without loss, by FFmpeg's
/// libraries in a program of their own, so that no other has to load them. A viewer that knows no
/// animations shows the first frame. The same bytes each time.
/// @throws InvalidInput as require_animation_size, if the frames' sizes differ, or for other
///         milliseconds; AnimationError.
std::string encode_animation(std::span<const Image> frames, const AnimationOptions& options = {},
                             const std::filesystem::path& program = animation_program());

}  // namespace mapproof
