#include "render/animation/animation.hpp"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>

#include <fmt/format.h>

#include "core/base/descriptor.hpp"
#include "core/base/errors.hpp"
#include "core/base/out_of_memory.hpp"
#include "render/image/png.hpp"

namespace mapproof {
namespace {

constexpr int kLargestSide = 8192;
constexpr std::size_t kMostPixels = std::size_t{1} << 28;
constexpr int kLongestFrame_ms = 60'000;

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

/// A file in memory.
Descriptor memory_file(const std::filesystem::path& program) {
  Descriptor file(::memfd_create("mapproof-animation", MFD_CLOEXEC));
  if (file.get() < 0) fail(program, std::strerror(errno));
  return file;
}

std::string content_of(const Descriptor& file, const std::filesystem::path& program) {
  const off_t size = ::lseek(file.get(), 0, SEEK_END);
  std::string bytes(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t got =
        ::pread(file.get(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail(program, "its answer cannot be read");
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

/// The last line of messages is the program's own; those of FFmpeg come before it.
std::string last_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

/// Runs the program on an input and returns its output.
std::string run(const std::filesystem::path& program, const Descriptor& input) {
  if (::access(program.c_str(), X_OK) != 0 && !MAPPROOF_HAS_ANIMATION)
    throw AnimationError(
        "animations are left out: this program was built without them (MAPPROOF_ANIMATION=OFF)");
  if (::access(program.c_str(), X_OK) != 0)
    fail(program, fmt::format("{} is not a program: {}", program.string(), std::strerror(errno)));
  const Descriptor output = memory_file(program), messages = memory_file(program);
  ::lseek(input.get(), 0, SEEK_SET);
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_adddup2(&files, input.get(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, output.get(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, messages.get(), STDERR_FILENO);
  std::string name = program.string();
  const std::array<char*, 2> arguments{name.data(), nullptr};
  pid_t process = -1;
  const int error =
      ::posix_spawn(&process, program.c_str(), &files, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  if (error != 0) fail(program, std::strerror(error));
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return content_of(output, program);
  const std::string said = last_line(content_of(messages, program));
  if (said == kOutOfMemory) throw std::bad_alloc();
  const std::string end = WIFSIGNALED(status)
                              ? fmt::format("it was ended by signal {}", WTERMSIG(status))
                              : fmt::format("it ended with exit code {}", WEXITSTATUS(status));
  fail(program, said.empty() ? end : said);
}

}  // namespace

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
  if (const char* named = std::getenv("MAPPROOF_ANIMATION"); named != nullptr && *named != '\0')
    return named;
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  return self.parent_path() / "mapproof-animation";
}

std::string encode_animation(std::span<const Image> frames, const AnimationOptions& options,
                             const std::filesystem::path& program) {
  check(frames, options);
  const Descriptor input = memory_file(program);
  bool whole = write_all(input, fmt::format("{} {} {} {}\n", frames[0].width, frames[0].height,
                                            frames.size(), options.frame_ms));
  for (const Image& frame : frames)
    whole = whole && write_all(input, {reinterpret_cast<const char*>(frame.pixels.data()),
                                       sizeof(frame.pixels[0]) * frame.pixels.size()});
  if (!whole) fail(program, std::strerror(errno));
  std::string png = run(program, input);
  // After the signature of 8 bytes and the header of 25, where other PNG have their texts too.
  constexpr std::size_t kHeaderEnd = 33;
  if (png.size() < kHeaderEnd || png.substr(1, 3) != "PNG") fail(program, "it gave no PNG");
  png.insert(kHeaderEnd, png_texts(options.texts));
  return png;
}

}  // namespace mapproof
