#include "core/records/studies/folder_replacement.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/descriptor.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/files/paths.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kModeBits = 07777;
constexpr const char* kWaiting = "old";

[[noreturn]] void fail_at(const fs::path& path, const char* what) {
  throw IoError(path.string(), std::string(what) + ": " + std::strerror(errno));
}

/// The path ".NAME.mapproof-MORE" next to the folder.
fs::path beside(const fs::path& folder, const std::string& more) {
  return folder.parent_path() / ("." + folder.filename().string() + ".mapproof-" + more);
}

/// The path of the old folder between two renames.
fs::path waiting_path(const fs::path& folder) { return beside(folder, kWaiting); }

struct stat facts_of(const fs::path& path) {
  struct stat facts {};
  if (::lstat(path.c_str(), &facts) != 0) fail_at(path, "cannot be read");
  return facts;
}

/// Makes a folder with a new name next to the folder.
fs::path make_beside(const fs::path& folder, mode_t mode) {
  for (int i = 0;; ++i) {
    const fs::path made = beside(folder, std::to_string(::getpid()) + "-" + std::to_string(i));
    if (::mkdir(made.c_str(), mode) == 0) return made;
    if (errno != EEXIST) fail_at(folder, "cannot be replaced: no folder can be made beside it");
  }
}

/// Only root may change the owner; others at least keep the group, if they belong to it.
void keep_owner(const struct stat& old, const fs::path& to) {
  const struct stat made = facts_of(to);
  if ((old.st_uid != made.st_uid || old.st_gid != made.st_gid) &&
      ::lchown(to.c_str(), old.st_uid, old.st_gid) != 0)
    static_cast<void>(::lchown(to.c_str(), static_cast<uid_t>(-1), old.st_gid));
}

/// @throws fs::filesystem_error.
void copy_whole(const fs::path& from, const fs::path& to) {
  const struct stat old = facts_of(from);
  if (S_ISLNK(old.st_mode)) {
    fs::copy_symlink(from, to);
  } else {
    fs::copy_file(from, to);
    fs::last_write_time(to, fs::last_write_time(from));
  }
  keep_owner(old, to);
}

/// Makes a hard link to the file, or a copy where the file system or the kernel allows no link.
void take_over(const fs::path& from, const fs::path& to) {
  if (::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), 0) == 0) return;
  if (errno == EXDEV) fail_at(from, "is mounted from elsewhere, and cannot be replaced");
  if (errno != EPERM && errno != EMLINK && errno != EOPNOTSUPP && errno != ENOSYS)
    fail_at(from, "cannot be taken over");
  try {
    copy_whole(from, to);
  } catch (const fs::filesystem_error& error) {
    throw IoError(from.string(), "cannot be taken over: " + error.code().message());
  }
}

/// Takes over all files of a folder. The new folders are writable until finish_folders().
void take_over_all(const fs::path& from, const fs::path& to, dev_t device) {
  std::error_code error;
  for (fs::directory_iterator entry(from, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& inner = entry->path();
    const fs::path copy = to / inner.filename();
    const struct stat facts = facts_of(inner);
    if (!S_ISDIR(facts.st_mode)) {
      take_over(inner, copy);
      continue;
    }
    if (facts.st_dev != device)
      throw IoError(inner.string(), "is mounted from elsewhere, and cannot be replaced");
    if (::mkdir(copy.c_str(), S_IRWXU) != 0) fail_at(copy, "cannot be made");
    take_over_all(inner, copy, device);
  }
  if (error) throw IoError(from.string(), "cannot be listed: " + error.message());
}

/// Waits until the entries of the folder and of those below it are on the disk.
void sync_folders(const fs::path& folder) {
  sync_folder(folder);
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->symlink_status(error).type() == fs::file_type::directory)
      sync_folders(entry->path());
  if (error) throw IoError(folder.string(), "cannot be listed: " + error.message());
}

/// Gives the folders of the copy the owners and modes of the old ones. New folders keep their own.
void finish_folders(const fs::path& from, const fs::path& to) {
  std::error_code error;
  for (fs::directory_iterator entry(from, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->symlink_status(error).type() == fs::file_type::directory)
      finish_folders(entry->path(), to / entry->path().filename());
  if (error) throw IoError(from.string(), "cannot be listed: " + error.message());
  const struct stat old = facts_of(from);
  keep_owner(old, to);
  if (::chmod(to.c_str(), old.st_mode & kModeBits) != 0) fail_at(to, "cannot get its mode");
}

/// Whether a name that begins as those of beside() ends as make_beside() or waiting_path() do.
bool is_ending(std::string_view text) {
  if (text == kWaiting) return true;
  const std::size_t dash = text.find('-');
  const auto is_number = [](std::string_view part) {
    return !part.empty() && part.find_first_not_of("0123456789") == std::string_view::npos;
  };
  return dash != std::string_view::npos && is_number(text.substr(0, dash)) &&
         is_number(text.substr(dash + 1));
}

void open_folders(const fs::path& folder) {
  ::chmod(folder.c_str(), S_IRWXU);
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->symlink_status(error).type() == fs::file_type::directory)
      open_folders(entry->path());
}

/// Ignores errors: what is left does no harm, and the next recover_folder() tries again.
void remove_all_of(const fs::path& folder) noexcept {
  try {
    open_folders(folder);
    std::error_code error;
    fs::remove_all(folder, error);
  } catch (const std::bad_alloc&) {  // The next recover_folder() tries again.
  }
}

bool is_missing_call(int error) {
  return error == EINVAL || error == ENOSYS || error == EOPNOTSUPP;
}

/// Exchanges by renames, where the file system cannot do it in one step.
/// @return False if that failed; errno holds the reason.
bool exchange_in_two(const fs::path& folder, const fs::path& copy) {
  const fs::path waiting = waiting_path(folder);
  if (::rename(folder.c_str(), waiting.c_str()) != 0) return false;
  if (::rename(copy.c_str(), folder.c_str()) == 0) {
    ::rename(waiting.c_str(), copy.c_str());
    return true;
  }
  const int why = errno;
  ::rename(waiting.c_str(), folder.c_str());
  errno = why;
  return false;
}

bool exchange(const fs::path& folder, const fs::path& copy) {
  if (::renameat2(AT_FDCWD, copy.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0)
    return true;
  return is_missing_call(errno) && exchange_in_two(folder, copy);
}

}  // namespace

FolderReplacement::FolderReplacement(const fs::path& folder) : folder_(folder) {
  std::error_code error;
  if (lies_in(real_path(fs::current_path(error)), folder))
    throw IoError(folder.string(),
                  "is replaced as a whole, so nobody may work in it: run this from "
                  "a folder outside of it");
  is_new_ = !fs::exists(fs::symlink_status(folder, error));
  if (is_new_) make_folder(folder.parent_path());
  copy_ = make_beside(folder, is_new_ ? S_IRWXU | S_IRWXG | S_IRWXO : S_IRWXU);
  try {
    lock_.emplace(copy_);
    if (!is_new_) take_over_all(folder, copy_, facts_of(folder).st_dev);
  } catch (...) {
    remove_all_of(copy_);
    throw;
  }
}

FolderReplacement::~FolderReplacement() { remove_all_of(copy_); }

void FolderReplacement::require_changeable(const fs::path& file) const {
  fs::path folder = folder_;
  const fs::path inner = file.parent_path();
  for (auto name = inner.begin();; ++name) {
    struct stat facts {};
    if (::lstat(folder.c_str(), &facts) != 0) return;  // It will be made.
    if (!S_ISDIR(facts.st_mode))
      throw IoError(folder.string(), "is not a folder of its own: nothing behind it is replaced");
    if (name == inner.end()) break;
    folder /= *name;
  }
  if (::access(folder.c_str(), W_OK) != 0) fail_at(folder, "may not be changed");
}

void FolderReplacement::write(const fs::path& file, std::string_view bytes) {
  require_changeable(file);
  const fs::path location = copy_ / file;
  make_folder(location.parent_path());
  struct stat old {};
  const bool replaces = ::lstat(location.c_str(), &old) == 0;
  // The file is a hard link to the old folder's, which must not change.
  if (replaces && ::unlink(location.c_str()) != 0) fail_at(folder_ / file, "cannot be replaced");
  Descriptor written(::open(location.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  if (written.get() < 0 || !write_all(written, bytes) ||
      (replaces && S_ISREG(old.st_mode) && ::fchmod(written.get(), old.st_mode & kModeBits) != 0) ||
      ::fsync(written.get()) != 0 || !written.close())
    fail_at(folder_ / file, "cannot be written");
}

void FolderReplacement::remove(const fs::path& file) {
  require_changeable(file);
  if (::unlink((copy_ / file).c_str()) != 0) fail_at(folder_ / file, "cannot be removed");
}

void FolderReplacement::commit() {
  sync_folders(copy_);
  if (is_new_) {
    if (::rename(copy_.c_str(), folder_.c_str()) != 0) fail_at(folder_, "cannot be made");
  } else {
    finish_folders(folder_, copy_);
    if (!exchange(folder_, copy_)) fail_at(folder_, "cannot be replaced in one step");
  }
  try {
    sync_folder(folder_.parent_path());
  } catch (const IoError&) {  // It may be lost: the old one comes back.
    is_new_ ? static_cast<void>(::rename(folder_.c_str(), copy_.c_str()))
            : static_cast<void>(exchange(folder_, copy_));
    throw;
  }
}

void FolderReplacement::remove_old() {
  remove_all_of(copy_);
  std::error_code error, gone;
  if (!fs::exists(fs::symlink_status(copy_, gone))) return;
  fs::remove_all(copy_, error);  // Once more, for the reason.
  if (fs::exists(fs::symlink_status(copy_, gone)))
    throw IoError(folder_.string(),
                  fmt::format("is replaced, but what it held before, {}, cannot be removed; the "
                              "next mapproof approve tries again: {}",
                              copy_.string(), error.message()));
}

void recover_folder(const fs::path& folder) {
  std::error_code error;
  const fs::path waiting = waiting_path(folder);
  if (!fs::exists(fs::symlink_status(folder, error)) && fs::is_directory(waiting, error)) {
    const FolderLock lock(waiting);  // Throws if another process is just replacing it.
    if (::rename(waiting.c_str(), folder.c_str()) != 0) fail_at(folder, "cannot be put back");
  }
  const std::string start = beside(folder, "").filename().string();
  std::vector<fs::path> leftovers;
  for (fs::directory_iterator entry(folder.parent_path(), error), end; !error && entry != end;
       entry.increment(error))
    if (const std::string name = entry->path().filename().string();
        name.starts_with(start) && is_ending(std::string_view(name).substr(start.size())))
      leftovers.push_back(entry->path());
  for (const fs::path& leftover : leftovers) try {
      const FolderLock lock(leftover);
      remove_all_of(leftover);
    } catch (const IoError&) {  // In use.
    }
}

}  // namespace mapproof
