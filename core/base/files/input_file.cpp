#include "core/base/files/input_file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 2> kPackedEndings = {".gz", ".xz"};

[[noreturn]] void refuse_opening(const std::string& name) {
  throw IoError(name, std::string("cannot be opened: ") + std::strerror(errno));
}

struct stat facts_of(const fs::path& path, std::optional<int> number, const std::string& name) {
  struct stat facts {};
  if ((number ? ::fstat(*number, &facts) : ::stat(path.c_str(), &facts)) != 0) refuse_opening(name);
  if (S_ISDIR(facts.st_mode)) throw IoError(name, "is a folder, a file was expected");
  return facts;
}

[[noreturn]] void refuse_endless(mode_t mode, const std::string& name) {
  throw IoError(name, std::string("is ") + endless_kind(mode) + ", a file was expected");
}

/// Whether an inherited stream comes to an end.
bool ends(int number, const struct stat& facts) {
  const bool is_null = S_ISCHR(facts.st_mode) && facts.st_rdev == ::makedev(1, 3);
  return S_ISFIFO(facts.st_mode) || S_ISSOCK(facts.st_mode) || is_null || ::isatty(number) == 1;
}

/// Opens the path again: a duplicate of the descriptor would share its offset with others.
Descriptor opened(const fs::path& path, const std::string& name) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (file.get() < 0) refuse_opening(name);
  return file;
}

Descriptor duplicate(int number, const std::string& name) {
  Descriptor file(::fcntl(number, F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
  if (file.get() < 0) refuse_opening(name);
  return file;
}

}  // namespace

std::optional<int> handed_in(const fs::path& path) {
  const std::string text = path.string();
  if (text == "-" || text == "/dev/stdin") return STDIN_FILENO;
  if (text == "/dev/stdout") return STDOUT_FILENO;
  if (text == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!text.starts_with(folder)) continue;
    int number = -1;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + folder.size(), end, number);
    if (error == std::errc() && stop == end && number >= 0) return number;
  }
  return std::nullopt;
}

std::string input_name(const fs::path& path) {
  return path == "-" ? "standard input" : path.string();
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  return path != "-" && fs::is_directory(path, error);
}

const char* endless_kind(mode_t mode) {
  if (S_ISFIFO(mode)) return "a named pipe";
  return S_ISSOCK(mode) ? "a socket" : "a device";
}

Descriptor open_input(const fs::path& path) {
  const std::string name = input_name(path);
  const std::optional<int> number = handed_in(path);
  // Opening a pipe or a device has effects: it wakes the pipe's writer, or winds a tape.
  const struct stat facts = facts_of(path, number, name);
  if (!S_ISREG(facts.st_mode)) {
    if (!number || !ends(*number, facts)) refuse_endless(facts.st_mode, name);
    return duplicate(*number, name);
  }
  if (path == "-") return duplicate(*number, name);
  Descriptor file = opened(path, name);
  // The path may have got another file since stat().
  if (const struct stat now = facts_of(path, file.get(), name); !S_ISREG(now.st_mode))
    refuse_endless(now.st_mode, name);
  return file;
}

Descriptor open_streamed(const fs::path& path) {
  const std::string name = input_name(path);
  const std::optional<int> number = handed_in(path);
  const struct stat facts = facts_of(path, number, name);
  if (number && (!S_ISREG(facts.st_mode) || path == "-")) return duplicate(*number, name);
  return opened(path, name);
}

std::size_t read_some(const Descriptor& file, std::span<char> to, const std::string& name) {
  for (;;) {
    const ssize_t count = ::read(file.get(), to.data(), to.size());
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno == EAGAIN) {  // Another process that shares the stream set O_NONBLOCK.
      pollfd wait{.fd = file.get(), .events = POLLIN, .revents = 0};
      ::poll(&wait, 1, -1);
    } else if (errno != EINTR) {
      throw IoError(name, std::string("cannot be read: ") + std::strerror(errno));
    }
  }
}

Descriptor anonymous_file(std::string_view bytes, const std::string& name) {
  Descriptor file(::memfd_create("mapproof-input", MFD_CLOEXEC));
  if (file.get() < 0 || !write_all(file, bytes))
    throw IoError(name, std::string("cannot be held in memory: ") + std::strerror(errno));
  return file;
}

std::string path_of(const Descriptor& file) {
  return "/proc/self/fd/" + std::to_string(file.get());
}

fs::path plain_or_packed(const fs::path& path) {
  std::error_code error;
  if (fs::exists(path, error)) return path;
  for (const std::string_view ending : kPackedEndings) {
    fs::path packed = path;
    packed += ending;
    if (fs::exists(packed, error)) return packed;
  }
  return path;
}

fs::path unpacked_name(const fs::path& path) {
  for (const std::string_view ending : kPackedEndings)
    if (path.extension() == ending) return path.parent_path() / path.stem();
  return path;
}

}  // namespace mapproof
