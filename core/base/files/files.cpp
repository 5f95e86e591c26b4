#include "core/base/files/files.hpp"

#include <sys/stat.h>

#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/files/descriptor.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/files/output_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// Where the file itself is that a path names: behind links, so that these stay.
/// @throws IoError for what is there and no regular file: it cannot be replaced.
fs::path replaceable_path(const fs::path& path) {
  if (handed_in(path))
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
  const std::string name = input_name(path);
  const Descriptor file = open_input(path);
  std::string bytes;
  struct stat facts {};
  if (::fstat(file.get(), &facts) == 0 && facts.st_size > 0 &&
      static_cast<std::size_t>(facts.st_size) <= limit)
    bytes.reserve(static_cast<std::size_t>(facts.st_size) + 1);
  std::string block(std::size_t{1} << 16, '\0');
  while (const std::size_t count = read_some(file, block, name)) {
    bytes.append(block, 0, count);
    if (bytes.size() > limit)
      throw IoError(name, "is larger than " + std::to_string(limit) + " bytes");
  }
  return bytes;
}

void require_file(const fs::path& path) { open_input(path); }

void write_file(const fs::path& path, std::string_view bytes) {
  const fs::path location = replaceable_path(path);
  OutputFolder(location.parent_path()).write(location.filename(), bytes);
}

}  // namespace mapproof
