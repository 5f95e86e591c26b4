#include "render/animation/animation.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include <fmt/format.h>

#include "core/base/child_process.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/descriptor.hpp"
#include "core/base/out_of_memory.hpp"
#include "render/image/png.hpp"

namespace mapproof {
namespace {

constexpr int kLargestSide = 8192;
constexpr std::size_t kMostPixels = std::size_t{1} << 28;
constexpr int kLongestFrame_ms = 60'000;
constexpr const char* kMemoryName = "mapproof-animation";

void check(std::span<const Image> frames, const AnimationOptions& options) {
  const Image none{0, 0, {}};
  const Image& first = frames.empty() ? none : frames[0];
  require_animation_size(first.width, first.height, frames.size());
  for (const Image& frame : frames)
    if (frame.width != first.width || frame.height != first.height ||
        frame.pixels.size() != first.pixels.size())
      throw InvalidInput("frames of an animation differ in size");
  if (options.frame_ms < 1 || options.frame_ms > kLongestFrame_ms)
    throw InvalidInput("a frame is seen for 1 ms to a minute");
}

[[noreturn]] void fail(const std::filesystem::path& program, const std::string& what) {
  throw AnimationError(printable(
      fmt::format("the animation cannot be made: {}: {}", program.filename().string(), what), 500));
}

/// Runs the program on an input and returns its output.
std::string run(const std::filesystem::path& program, const Descriptor& input) {
  if (!MAPPROOF_HAS_ANIMATION && !is_program(program))
    throw AnimationError(
        "animations are left out: this program was built without them (MAPPROOF_ANIMATION=OFF)");
  ProgramAnswer answer = answer_of({program}, input);
  if (answer.end.is_success()) return std::move(answer.output);
  // The last line of messages is the program's own; those of FFmpeg come before it.
  const std::string said = last_line(answer.messages);
  if (said == kOutOfMemory) throw std::bad_alloc();
  fail(program, said.empty() ? answer.end.text() : said);
}

/// What the program makes of the frames. @throws ProcessError.
std::string encoded(std::span<const Image> frames, const AnimationOptions& options,
                    const std::filesystem::path& program) {
  const Descriptor input = memory_file(kMemoryName);
  bool whole = write_all(input, fmt::format("{} {} {} {} {}\n", frames[0].width, frames[0].height,
                                            frames.size(), options.frame_ms, name(options.format)));
  for (const Image& frame : frames)
    whole = whole && write_all(input, {reinterpret_cast<const char*>(frame.pixels.data()),
                                       sizeof(frame.pixels[0]) * frame.pixels.size()});
  if (!whole) fail(program, std::strerror(errno));
  return run(program, input);
}

}  // namespace

std::string_view name(AnimationFormat format) {
  constexpr std::string_view kNames[] = {"apng", "mp4", "gif"};
  return kNames[static_cast<std::size_t>(format)];
}

void require_animation_size(int width, int height, std::size_t frames) {
  if (frames < 2) throw InvalidInput("an animation needs two frames");
  if (std::min(width, height) < 1 || std::max(width, height) > kLargestSide)
    throw InvalidInput(fmt::format("no animation is {} x {} pixels", width, height));
  const std::size_t most =
      kMostPixels / (static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  if (frames > most)
    throw InvalidInput(fmt::format("an animation of {} x {} pixels has at most {} frames, not {}",
                                   width, height, most, frames));
}

std::filesystem::path animation_program() {
  return program_beside("MAPPROOF_ANIMATION", "mapproof-animation");
}

std::string encode_animation(std::span<const Image> frames, const AnimationOptions& options,
                             const std::filesystem::path& program) {
  check(frames, options);
  std::string file;
  try {
    file = encoded(frames, options, program);
  } catch (const ProcessError& error) {
    fail(program, error.what());
  }
  if (options.format == AnimationFormat::kMp4) {
    if (file.size() < 8 || file.substr(4, 4) != "ftyp") fail(program, "it gave no MP4");
    return file;
  }
  if (options.format == AnimationFormat::kGif) {
    if (!file.starts_with("GIF8")) fail(program, "it gave no GIF");
    return file;
  }
  // After the signature of 8 bytes and the header of 25, where other PNG have their texts too.
  constexpr std::size_t kHeaderEnd = 33;
  if (file.size() < kHeaderEnd || file.substr(1, 3) != "PNG") fail(program, "it gave no PNG");
  file.insert(kHeaderEnd, png_texts(options.texts));
  return file;
}

}  // namespace mapproof
