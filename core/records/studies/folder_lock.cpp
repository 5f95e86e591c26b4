#include "core/records/studies/folder_lock.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// The process that was writing NAME.part-PID-RANDOM (earlier versions: NAME.part-PID); empty for
/// any other name.
std::optional<pid_t> writer(const fs::path& file) {
  constexpr std::string_view kMark = ".part-";
  const std::string name = file.filename().string();
  const std::size_t mark = name.rfind(kMark);
  if (mark == std::string::npos) return std::nullopt;
  pid_t process = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + mark + kMark.size(), end, process);
  const std::string_view random(stop, end);
  const bool is_part =
      random.empty() || (random.starts_with('-') &&
                         random.find_first_not_of("0123456789abcdef", 1) == std::string_view::npos);
  if (error != std::errc() || !is_part || process <= 0) return std::nullopt;
  return process;
}

Descriptor opened(const fs::path& folder) {
  Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.get() < 0)
    throw IoError(folder.string(), std::string("cannot be opened: ") + std::strerror(errno));
  return descriptor;
}

/// Whether the lock was taken, or the file system has no locks.
bool locked(const Descriptor& folder, int how) {
  int result = 0;
  do result = ::flock(folder.get(), how);
  while (result != 0 && errno == EINTR);
  return result == 0 || errno != EWOULDBLOCK;
}

/// Whether the folder still has the path: it may have been replaced before it was locked.
bool is_at(const Descriptor& folder, const fs::path& path) {
  struct stat held {
  }, there{};
  return ::fstat(folder.get(), &held) == 0 && ::stat(path.c_str(), &there) == 0 &&
         held.st_dev == there.st_dev && held.st_ino == there.st_ino;
}

bool is_running(pid_t process) {
  return process != ::getpid() && (::kill(process, 0) == 0 || errno == EPERM);
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) : folder_(-1) {
  do {
    folder_ = opened(folder);
    if (!locked(folder_, LOCK_EX | LOCK_NB))
      throw IoError(folder.string(),
                    "is in use by another mapproof; wait for it, or choose another folder");
  } while (!is_at(folder_, folder));
}

FolderLock::FolderLock(const fs::path& folder, const std::function<void()>& busy) : folder_(-1) {
  bool reported = false;
  do {
    folder_ = opened(folder);
    if (locked(folder_, LOCK_EX | LOCK_NB)) continue;
    if (!std::exchange(reported, true)) busy();
    locked(folder_, LOCK_EX);
  } while (!is_at(folder_, folder));
}

bool is_leftover(const fs::path& file) { return writer(file).has_value(); }

void remove_leftovers(const fs::path& folder) {
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::optional<pid_t> process = writer(entry->path());
    if (process && !is_running(*process)) ::unlink(entry->path().c_str());
  }
  if (error) throw IoError(folder.string(), "cannot be searched: " + error.message());
}

}  // namespace mapproof
