#include "core/base/files/paths.hpp"

#include <algorithm>
#include <system_error>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// Whether the path or a folder above it is the same file as `other`, under whatever name.
bool is_at_or_below(fs::path path, const fs::path& other) {
  std::error_code error;
  for (;; path = path.parent_path()) {
    if (fs::equivalent(path, other, error)) return true;
    if (!path.has_relative_path()) return false;
  }
}

}  // namespace

bool is_there(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::status_known(status)) throw IoError(path.string(), "cannot be read: " + error.message());
  return fs::exists(status);
}

fs::path real_path(const fs::path& path) {
  std::error_code error;
  fs::path real = fs::weakly_canonical(fs::absolute(path, error), error);
  if (error) real = fs::absolute(path, error).lexically_normal();
  return real.has_filename() ? real : real.parent_path();
}

bool lies_in(const fs::path& path, const fs::path& folder) {
  return std::ranges::mismatch(folder, path).in1 == folder.end();
}

bool overlap(const fs::path& a, const fs::path& b) {
  const fs::path first = real_path(a), second = real_path(b);
  return lies_in(first, second) || lies_in(second, first) || is_at_or_below(first, second) ||
         is_at_or_below(second, first);
}

}  // namespace mapproof
