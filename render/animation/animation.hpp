#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/image/image.hpp"

namespace mapproof {

/// An animation could not be made: the program that encodes is missing or ended. One line.
class AnimationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class AnimationFormat {
  kApng,  ///< Animated PNG: without loss, shown by browsers.
  kMp4,   ///< H.264 (MPEG-4 where FFmpeg has no encoder of it): for slides.
  kGif,   ///< 256 colours chosen for all frames.
};

/// What files call it: "apng", "mp4", "gif".
std::string_view name(AnimationFormat format);

struct AnimationOptions {
  AnimationFormat format = AnimationFormat::kApng;
  int frame_ms = 700;  ///< How long each frame is shown, in [1, 60000].
  std::vector<std::pair<std::string, std::string>> texts = {};  ///< As of PngOptions; of APNG alone.
};

/// The program that encodes animations: the one that the environment variable MAPPROOF_ANIMATION
/// names, else `mapproof-animation` beside the running program.
std::filesystem::path animation_program();

/// @throws InvalidInput with the limit if there are fewer than two frames, a side is not in 1 to
///         8192, or all frames together have more than 2^28 pixels.
void require_animation_size(int width, int height, std::size_t frames);

/// Encodes frames of one size as an animation: APNG and GIF repeat for ever, and a viewer that cannot
/// show animations shows their first frame. MP4 has even sides: an odd row or column is repeated.
/// FFmpeg's libraries do it in a separate program, so that no other loads them. The same frames and
/// options give the same bytes.
/// @throws InvalidInput as require_animation_size() does, if the sizes of frames differ, or if
///         frame_ms is out of its bounds; std::bad_alloc if the program runs out of memory;
///         AnimationError.
std::string encode_animation(std::span<const Image> frames, const AnimationOptions& options = {},
                             const std::filesystem::path& program = animation_program());

}  // namespace mapproof
