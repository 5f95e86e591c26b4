#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "render/image/image.hpp"

namespace mapproof {

/// An animation could not be made: the program that encodes is missing or ended. One line.
class AnimationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct AnimationOptions {
  int frame_ms = 700;  ///< How long each frame is shown, in [1, 60000].
  std::vector<std::pair<std::string, std::string>> texts = {};  ///< As of PngOptions.
};

/// The program that encodes animations: the one that the environment variable MAPPROOF_ANIMATION
/// names, else `mapproof-animation` beside the running program.
std::filesystem::path animation_program();

/// @throws InvalidInput with the limit if there are fewer than two frames, a side is not in 1 to
///         8192, or all frames together have more than 2^28 pixels.
void require_animation_size(int width, int height, std::size_t frames);

/// Encodes frames of one size, without loss, as an animated PNG that repeats for ever. FFmpeg's
/// libraries do it in a separate program, so that no other loads them. A viewer that cannot show
/// animations shows the first frame. The same frames and options give the same bytes.
/// @throws InvalidInput as require_animation_size() does, if the sizes of frames differ, or if
///         frame_ms is out of its bounds; std::bad_alloc if the program runs out of memory;
///         AnimationError.
std::string encode_animation(std::span<const Image> frames, const AnimationOptions& options = {},
                             const std::filesystem::path& program = animation_program());

}  // namespace mapproof
