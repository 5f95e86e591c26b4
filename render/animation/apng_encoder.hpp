#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mapproof {

/// What the program that encodes animations reads: a line of four numbers, then the frames' pixels
/// as Image has them, one after the other.
struct AnimationInput {
  int width = 0;
  int height = 0;
  int frames = 0;
  int frame_ms = 0;
};

/// Encodes frame by frame into an animated PNG, by libavcodec and libavformat, with one thread and
/// without anything that tells version or time.
class ApngEncoder {
 public:
  /// @throws std::runtime_error if FFmpeg has no APNG or takes no such frames.
  explicit ApngEncoder(const AnimationInput& input);
  ~ApngEncoder();
  ApngEncoder(const ApngEncoder&) = delete;
  ApngEncoder& operator=(const ApngEncoder&) = delete;

  /// @throws std::runtime_error.
  void add(const std::vector<std::uint32_t>& pixels);
  /// The file. @throws std::runtime_error.
  std::string finish();

 private:
  struct State;
  void drain();
  State* state_;
};

}  // namespace mapproof
