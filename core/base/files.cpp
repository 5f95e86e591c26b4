#include "core/base/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/base/descriptor.hpp"
#include "core/base/errors.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

std::string reason() { return std::strerror(errno); }

/// What has no end, or none that can be waited for; empty for files.
const char* endless_kind(mode_t mode) {
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return S_ISCHR(mode) || S_ISBLK(mode) ? "a device" : "";
}

/// Whether the path is a stream that this process was handed, as by a shell's <(...).
bool is_handed_in(const fs::path& path) {
  const std::string text = path.string();
  return text == "/dev/stdin" || text == "/dev/stdout" || text == "/dev/stderr" ||
         text.starts_with("/dev/fd/") || text.starts_with("/proc/self/fd/");
}

/// Refuses what is no file, without waiting for anybody to write to it.
Descriptor open_file(const fs::path& path, struct stat& facts) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) throw IoError(path.string(), "cannot be opened: " + reason());
  if (::fstat(file.get(), &facts) != 0) throw IoError(path.string(), reason());
  if (S_ISDIR(facts.st_mode)) throw IoError(path.string(), "is a folder, a file was expected");
  if (S_ISREG(facts.st_mode)) return file;
  if (!is_handed_in(path))
    throw IoError(path.string(),
                  std::string("is ") + endless_kind(facts.st_mode) + ", a file was expected");
  const int flags = ::fcntl(file.get(), F_GETFL);
  if (flags < 0 || ::fcntl(file.get(), F_SETFL, flags & ~O_NONBLOCK) < 0)
    throw IoError(path.string(), reason());
  return file;
}

/// Where the file itself is that a path names: behind links, so that these stay.
/// @throws IoError for what is there and no regular file: it cannot be replaced.
fs::path replaceable_place(const fs::path& path) {
  if (is_handed_in(path))
    throw IoError(path.string(), "is a stream, no file that can be written at once");
  struct stat facts {};
  if (::stat(path.c_str(), &facts) != 0) return path;
  if (S_ISDIR(facts.st_mode)) throw IoError(path.string(), "is a folder, no file to be replaced");
  if (!S_ISREG(facts.st_mode))
    throw IoError(path.string(),
                  std::string("is ") + endless_kind(facts.st_mode) + ", no file to be replaced");
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::canonical(path, error);
  if (error) throw IoError(path.string(), "cannot be followed: " + error.message());
  return target;
}

}  // namespace

std::string read_file(const fs::path& path, std::size_t limit) {
  struct stat facts {};
  const Descriptor file = open_file(path, facts);
  std::string bytes;
  if (facts.st_size > 0 && static_cast<std::size_t>(facts.st_size) <= limit)
    bytes.reserve(static_cast<std::size_t>(facts.st_size) + 1);
  std::string block(std::size_t{1} << 16, '\0');
  for (;;) {
    const ssize_t count = ::read(file.get(), block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw IoError(path.string(), "cannot be read: " + reason());
    if (count == 0) return bytes;
    bytes.append(block, 0, static_cast<std::size_t>(count));
    if (bytes.size() > limit)
      throw IoError(path.string(), "is larger than " + std::to_string(limit) + " bytes");
  }
}

void require_file(const fs::path& path) {
  struct stat facts {};
  open_file(path, facts);
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw IoError(path.string(), "folder cannot be made: " + error.message());
  if (!fs::is_directory(path, error)) throw IoError(path.string(), "is not a folder");
}

void write_file(const fs::path& path, std::string_view bytes) {
  if (path.has_parent_path()) make_folder(path.parent_path());
  const fs::path place = replaceable_place(path);
  fs::path beside = place;
  beside += ".part-" + std::to_string(::getpid());
  try {
    Descriptor file(::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
    if (file.get() < 0) throw IoError(path.string(), "cannot be written: " + reason());
    if (!write_all(file, bytes) || !file.close())
      throw IoError(path.string(), "cannot be written: " + reason());
    if (::rename(beside.c_str(), place.c_str()) != 0)
      throw IoError(path.string(), "cannot be put in place: " + reason());
  } catch (...) {
    ::unlink(beside.c_str());
    throw;
  }
}

void append_file(const fs::path& path, std::string_view bytes) {
  if (bytes.empty()) return;
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  const off_t size = file.get() < 0 ? -1 : ::lseek(file.get(), 0, SEEK_END);
  if (size >= 0 && write_all(file, bytes) && file.close()) return;
  const std::string why = reason();
  // Where that fails too, a part of the bytes stays.
  if (size >= 0) static_cast<void>(::ftruncate(file.get(), size) == 0);
  throw IoError(path.string(), "cannot be appended to: " + why);
}

}  // namespace mapproof
