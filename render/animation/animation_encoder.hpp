#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct AVFrame;

namespace mapproof {

/// The input of the program that encodes animations: one line of these four numbers and the name of
/// the format, then the pixels of each frame as Image has them.
struct AnimationInput {
  int width = 0;   ///< Pixels.
  int height = 0;  ///< Pixels.
  int frames = 0;
  int frame_ms = 0;  ///< How long each frame is shown.
  std::string format = "apng";  ///< Or mp4, gif.
};

/// Encodes frame by frame into an animated PNG, MP4 or GIF, by FFmpeg's libraries, on one thread.
/// The file has no time in it.
class AnimationEncoder {
 public:
  /// @throws std::runtime_error if FFmpeg has no encoder of the format or refuses such frames.
  explicit AnimationEncoder(const AnimationInput& input);
  ~AnimationEncoder();
  AnimationEncoder(const AnimationEncoder&) = delete;
  AnimationEncoder& operator=(const AnimationEncoder&) = delete;

  /// Adds a frame. @param pixels  width * height of them, row by row, each 0x00RRGGBB.
  /// @throws std::runtime_error if it cannot be encoded.
  void add(const std::vector<std::uint32_t>& pixels);
  /// Ends the file and returns its bytes. @throws std::runtime_error if it cannot be encoded.
  std::string finish();

 private:
  struct State;
  /// Encodes a frame; null ends the file.
  void encode(AVFrame* frame);
  std::unique_ptr<State> state_;
};

}  // namespace mapproof
