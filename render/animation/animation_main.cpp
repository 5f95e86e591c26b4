#include <sys/resource.h>

#include <array>
#include <cinttypes>
#include <cstdio>
#include <exception>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/out_of_memory.hpp"
#include "core/base/parent_watch.hpp"
#include "render/animation/animation_encoder.hpp"
#include "render/animation/image_decoder.hpp"

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

void encode() {
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

/// Whether AddressSanitizer maps terabytes for its own use.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
constexpr bool kSanitized = __has_feature(address_sanitizer);
#else
constexpr bool kSanitized = false;
#endif

/// A file of a stranger may ask for more than any image needs.
void set_limits() {
  constexpr rlimit kMemory{rlim_t{4} << 30, rlim_t{4} << 30};
  constexpr rlimit kSeconds{60, 60};
  if (!kSanitized) ::setrlimit(RLIMIT_AS, &kMemory);
  ::setrlimit(RLIMIT_CPU, &kSeconds);
}

void write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size())
    throw std::runtime_error("the pixels cannot be written");
}

/// Writes of each frame "WIDTH HEIGHT MILLISECONDS PROFILE", a line feed and its pixels, RGBA;
/// "end" last.
void decode(std::string_view format) {
  set_limits();
  std::string bytes;
  std::array<char, 1 << 16> block{};
  while (const std::size_t got = std::fread(block.data(), 1, block.size(), stdin))
    bytes.append(block.data(), got);
  decode_image(std::move(bytes), format, [](const DecodedFrame& frame) {
    std::array<char, 64> head{};
    const int length = std::snprintf(head.data(), head.size(), "%d %d %d %" PRIu64 "\n",
                                     frame.width, frame.height, frame.duration_ms, frame.profile);
    write({head.data(), static_cast<std::size_t>(length)});
    for (int y = 0; y < frame.height; ++y)
      write({reinterpret_cast<const char*>(frame.rgba + y * frame.stride),
             static_cast<std::size_t>(frame.width) * 4});
  });
  write("end\n");
  if (std::fflush(stdout) != 0) throw std::runtime_error("the pixels cannot be written");
}

void run(std::span<char*> words) {
  if (words.size() == 3 && std::string_view(words[1]) == "decode") return decode(words[2]);
  encode();
}

}  // namespace
}  // namespace mapproof

/// Reads an AnimationInput with its frames and writes an animation; "decode FORMAT": reads an image
/// file and writes its frames. mapproof starts it; it is not meant for direct use.
int main(int argc, char** argv) {
  mapproof::end_with_parent();
  try {
    mapproof::run({argv, static_cast<std::size_t>(argc)});
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "%s\n", mapproof::kOutOfMemory);
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
