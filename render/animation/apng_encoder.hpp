#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace mapproof {

/// The input of the program that encodes animations: one line of these four numbers, then the
/// pixels of each frame as Image has them.
struct AnimationInput {
  int width = 0;   ///< Pixels.
  int height = 0;  ///< Pixels.
  int frames = 0;
  int frame_ms = 0;  ///< How long each frame is shown.
};

/// Encodes frame by frame into an animated PNG, by libavcodec and libavformat, on one thread. The
/// file has no version and no time in it.
class ApngEncoder {
 public:
  /// @throws std::runtime_error if FFmpeg has no encoder of APNG or refuses such frames.
  explicit ApngEncoder(const AnimationInput& input);
  ~ApngEncoder();
  ApngEncoder(const ApngEncoder&) = delete;
  ApngEncoder& operator=(const ApngEncoder&) = delete;

  /// Adds a frame. @param pixels  width * height of them, row by row, each 0x00RRGGBB.
  /// @throws std::runtime_error if it cannot be encoded.
  void add(const std::vector<std::uint32_t>& pixels);
  /// Ends the file and returns its bytes. @throws std::runtime_error if it cannot be encoded.
  std::string finish();

 private:
  struct State;
  void drain();
  std::unique_ptr<State> state_;
};

}  // namespace mapproof
