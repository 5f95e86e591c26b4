#include <array>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/out_of_memory.hpp"
#include "core/base/parent_watch.hpp"
#include "render/animation/animation_encoder.hpp"

namespace mapproof {
namespace {

AnimationInput read_header() {
  AnimationInput input;
  std::array<char, 8> format{};
  if (std::scanf("%d %d %d %d %7s", &input.width, &input.height, &input.frames, &input.frame_ms,
                 format.data()) != 5 ||
      std::getchar() != '\n')
    throw std::runtime_error("no header");
  input.format = format.data();
  constexpr int kLargest = 100'000;
  for (const int number : {input.width, input.height, input.frames, input.frame_ms})
    if (number < 1 || number > kLargest) throw std::runtime_error("a header out of range");
  return input;
}

void run() {
  const AnimationInput input = read_header();
  AnimationEncoder encoder(input);
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(input.width) *
                                    static_cast<std::size_t>(input.height));
  for (int i = 0; i < input.frames; ++i) {
    if (std::fread(pixels.data(), sizeof(pixels[0]), pixels.size(), stdin) != pixels.size())
      throw std::runtime_error("the frames end too soon");
    encoder.add(pixels);
  }
  const std::string file = encoder.finish();
  if (std::fwrite(file.data(), 1, file.size(), stdout) != file.size() || std::fflush(stdout) != 0)
    throw std::runtime_error("the file cannot be written");
}

}  // namespace
}  // namespace mapproof

/// Reads an AnimationInput with its frames and writes an animation. mapproof starts it; it is
/// not meant for direct use.
int main() {
  mapproof::end_with_parent();
  try {
    mapproof::run();
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "%s\n", mapproof::kOutOfMemory);
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
