#include "core/base/files/output_folder.hpp"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/descriptor.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/files/paths.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kFileMode = 0644, kFolderMode = 0777;
constexpr std::size_t kLongestStem = 200;  ///< Bytes: a name on Linux has 255 at most.

[[noreturn]] void refuse_change(const fs::path& path, const char* what) {
  throw IoError(path.string(), fmt::format("{}: {}", what, std::strerror(errno)));
}

[[noreturn]] void refuse_link(const fs::path& path) {
  throw IoError(path.string(), "is a symbolic link, and nothing is written through it");
}

void require_relative(const fs::path& path) {
  if (path.is_absolute() || std::ranges::find(path, "..") != path.end())
    throw InvalidInput("not a path below a folder: " + path.string());
}

/// The folder above a file: an open descriptor, and the path for messages.
struct Parent {
  Descriptor folder;
  fs::path path;
};

/// What is there under the name; the type 0 if nothing is.
mode_t type_of(const Parent& parent, const std::string& name) {
  struct stat facts {};
  if (::fstatat(parent.folder.get(), name.c_str(), &facts, AT_SYMLINK_NOFOLLOW) == 0)
    return facts.st_mode & S_IFMT;
  if (errno != ENOENT) refuse_change(parent.path / name, "cannot be read");
  return 0;
}

Parent inner_folder(const Parent& parent, const std::string& name) {
  const fs::path path = parent.path / name;
  Descriptor inner(
      ::openat(parent.folder.get(), name.c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (inner.get() < 0) {
    const int why = errno;
    if (type_of(parent, name) == S_IFLNK) refuse_link(path);
    errno = why;
    refuse_change(path, "cannot be opened");
  }
  return {std::move(inner), path};
}

/// Opens the folders of `inner` one after the other. @param makes  Makes those that are missing.
Parent opened_below(const fs::path& named, const fs::path& inner, bool makes) {
  require_relative(inner);
  if (makes && !named.empty()) make_folder(named);
  const char* start = named.empty() ? "." : named.c_str();
  Parent parent{Descriptor(::open(start, O_PATH | O_DIRECTORY | O_CLOEXEC)), named};
  if (parent.folder.get() < 0) refuse_change(named, "cannot be opened");
  for (const fs::path& part : inner) {
    const std::string name = part.string();
    if (name.empty() || name == ".") continue;
    if (makes && ::mkdirat(parent.folder.get(), name.c_str(), kFolderMode) != 0 && errno != EEXIST)
      refuse_change(parent.path / name, "folder cannot be made");
    parent = inner_folder(parent, name);
  }
  return parent;
}

void require_replaceable(const Parent& parent, const std::string& name) {
  const mode_t type = type_of(parent, name);
  const fs::path path = parent.path / name;
  if (type == 0 || S_ISREG(type)) return;
  if (S_ISLNK(type)) refuse_link(path);
  if (S_ISDIR(type)) throw IoError(path.string(), "is a folder, no file to be replaced");
  throw IoError(path.string(),
                std::string("is ") + endless_kind(type) + ", no file to be replaced");
}

/// Whether the entries of the folder are on the disk; errno holds the reason if not.
bool synced(int folder, const char* path) {
  const Descriptor opened(::openat(folder, path, O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return opened.get() >= 0 && (::fsync(opened.get()) == 0 || errno == EINVAL || errno == ENOSYS);
}

/// The bytes of a regular file of the folder.
std::string bytes_of(const Parent& parent, const std::string& name) {
  const Descriptor file(
      ::openat(parent.folder.get(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (file.get() < 0) refuse_change(parent.path / name, "cannot be read");
  std::string bytes, block(std::size_t{1} << 16, '\0');
  while (const std::size_t count = read_some(file, block, (parent.path / name).string()))
    bytes.append(block, 0, count);
  return bytes;
}

void write_into(const Parent& parent, const std::string& name, std::string_view bytes,
                bool durably) {
  require_replaceable(parent, name);
  const fs::path path = parent.path / name;
  const int folder = parent.folder.get();
  const std::string beside = part_name(name);
  try {
    Descriptor file(::openat(folder, beside.c_str(),
                             O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kFileMode));
    if (file.get() < 0 || !write_all(file, bytes) || (durably && ::fsync(file.get()) != 0) ||
        !file.close())
      refuse_change(path, "cannot be written");
    if (::renameat(folder, beside.c_str(), folder, name.c_str()) != 0)
      refuse_change(path, "cannot be put in place");
  } catch (...) {
    ::unlinkat(folder, beside.c_str(), 0);
    throw;
  }
  if (durably && !synced(folder, ".")) refuse_change(path, "cannot be put on the disk");
}

/// Where a link leads; if nothing is there, where a file would be made through it.
fs::path end_of_link(const fs::path& link) {
  std::error_code error;
  const fs::path there = fs::canonical(link, error);
  return error ? real_path(link.parent_path() / fs::read_symlink(link, error)) : there;
}

}  // namespace

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw IoError(path.string(), "folder cannot be made: " + error.message());
  if (!fs::is_directory(path, error)) throw IoError(path.string(), "is not a folder");
}

OutputFolder OutputFolder::operator/(const fs::path& inner) const {
  OutputFolder folder = *this;
  folder.inner_ /= inner;
  return folder;
}

std::optional<std::string> OutputFolder::read(const fs::path& file) const {
  const fs::path inner = inner_ / file;
  std::error_code error;
  if (!fs::exists(fs::symlink_status((named_ / inner).parent_path(), error))) return std::nullopt;
  const Parent parent = opened_below(named_, inner.parent_path(), false);
  const std::string name = inner.filename();
  require_replaceable(parent, name);
  if (type_of(parent, name) == 0) return std::nullopt;
  return bytes_of(parent, name);
}

void OutputFolder::write(const fs::path& file, std::string_view bytes) const {
  const fs::path inner = inner_ / file;
  write_into(opened_below(named_, inner.parent_path(), true), inner.filename(), bytes, false);
}

void OutputFolder::write_durably(const fs::path& file, std::string_view bytes) const {
  const fs::path inner = inner_ / file;
  write_into(opened_below(named_, inner.parent_path(), true), inner.filename(), bytes, true);
}

void OutputFolder::append(const fs::path& file, std::string_view bytes) const {
  if (bytes.empty()) return;
  const fs::path inner = inner_ / file;
  const Parent parent = opened_below(named_, inner.parent_path(), false);
  const std::string name = inner.filename();
  require_replaceable(parent, name);
  Descriptor opened(::openat(parent.folder.get(), name.c_str(),
                             O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, kFileMode));
  struct stat facts {};
  if (opened.get() >= 0 && ::fstat(opened.get(), &facts) == 0 && facts.st_nlink > 1)
    return write_into(parent, name, bytes_of(parent, name).append(bytes), false);
  const off_t size = opened.get() < 0 ? -1 : ::lseek(opened.get(), 0, SEEK_END);
  if (size >= 0 && write_all(opened, bytes) && opened.close()) return;
  const int why = errno;
  // Where that fails too, a part of the bytes stays.
  if (size >= 0) static_cast<void>(::ftruncate(opened.get(), size) == 0);
  errno = why;
  refuse_change(parent.path / name, "cannot be appended to");
}

void OutputFolder::remove(const fs::path& file) const {
  const fs::path inner = inner_ / file;
  std::error_code error;
  if (!fs::exists(fs::symlink_status((named_ / inner).parent_path(), error))) return;
  const Parent parent = opened_below(named_, inner.parent_path(), false);
  // The path through the descriptor: a folder above cannot become a link on the way.
  fs::remove_all(fs::path(path_of(parent.folder)) / inner.filename(), error);
  if (error)
    throw IoError((parent.path / inner.filename()).string(),
                  "cannot be removed: " + error.message());
}

std::string part_name(const std::string& name) {
  std::uint64_t random = 0;
  if (::getrandom(&random, sizeof random, 0) != static_cast<ssize_t>(sizeof random))
    refuse_change(name, "no random name can be made for it");
  return fmt::format("{}.part-{}-{:016x}", name.substr(0, kLongestStem), ::getpid(), random);
}

void sync_folder(const fs::path& folder) {
  if (!synced(AT_FDCWD, folder.empty() ? "." : folder.c_str()))
    refuse_change(folder, "cannot be put on the disk");
}

void refuse_links_out(const fs::path& folder) {
  const fs::path real = real_path(folder);
  std::error_code error;
  if (!fs::is_directory(real, error)) return;
  constexpr auto kReadable = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator entry(real, kReadable, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code unknown;
    if (!entry->is_symlink(unknown)) continue;
    const fs::path target = end_of_link(entry->path());
    if (lies_in(target, real)) continue;
    // Devices and pipes are refused where they are read.
    if (fs::exists(target, unknown) && !fs::is_regular_file(target, unknown) &&
        !fs::is_directory(target, unknown))
      continue;
    throw IoError((folder / entry->path().lexically_relative(real)).string(),
                  "is a link that leads out of the folder; put the file itself there");
  }
  if (error) throw IoError(folder.string(), "cannot be searched: " + error.message());
}

}  // namespace mapproof
