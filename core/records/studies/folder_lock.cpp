#include "core/records/studies/folder_lock.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "core/base/errors.hpp"
#include "core/records/studies/study_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// The process that was writing NAME.part-PID-RANDOM, see part_name(); empty for any other name.
std::optional<pid_t> writer(const fs::path& file) {
  constexpr std::string_view kMark = ".part-";
  constexpr std::size_t kDigits = 16;
  const std::string name = file.filename().string();
  const std::size_t mark = name.rfind(kMark);
  if (mark == std::string::npos) return std::nullopt;
  pid_t process = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + mark + kMark.size(), end, process);
  const std::string_view random(stop, end);
  const bool is_part = random.size() == 1 + kDigits && random.starts_with('-') &&
                       random.find_first_not_of("0123456789abcdef", 1) == std::string_view::npos;
  if (error != std::errc() || !is_part || process <= 0) return std::nullopt;
  return process;
}

/// Whether the program writes to a folder of that name, and those below it, in a folder of records.
bool is_written(const fs::path& folder) {
  constexpr std::array<std::string_view, 16> kNames = {
      "runs",         "maps",   "details", "paths",  "convergence",   "parts",
      "errors",       "pages",  "figures", "tables", "figures-paper", "figures-styled",
      "nightly_runs", "trends", "objects", "compare"};
  std::error_code error;  // Where nothing may be searched, nothing of the program's is.
  return std::ranges::find(kNames, folder.filename().string()) != kNames.end() ||
         fs::is_regular_file(folder / kStudyFile, error);
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

const fs::path& made(const fs::path& folder) {
  make_folder(folder);
  return folder;
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
    std::error_code unknown;
    const fs::file_type type = entry->symlink_status(unknown).type();
    if (type == fs::file_type::directory &&
        (entry.depth() == 0 || is_study(entry->path().parent_path())) && !is_written(entry->path()))
      entry.disable_recursion_pending();
    if (type != fs::file_type::regular) continue;
    const std::optional<pid_t> process = writer(entry->path());
    if (process && !is_running(*process)) ::unlink(entry->path().c_str());
  }
  if (error) throw IoError(folder.string(), "cannot be searched: " + error.message());
}

LockedFolder::LockedFolder(const fs::path& folder) : files_(folder), lock_(made(folder)) {
  remove_leftovers(folder);
}

}  // namespace mapproof
