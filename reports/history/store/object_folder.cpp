#include "reports/history/store/object_folder.hpp"

#include <algorithm>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/sha256.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  if (!fs::exists(folder, error)) return files;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->is_regular_file()) files.push_back(entry->path());
  if (error) throw IoError(folder.string(), "cannot be searched: " + error.message());
  std::ranges::sort(files);
  return files;
}

/// Puts a link to `target` in place of `path` at once; leaves it if there can be no link.
void link_in_place(const fs::path& target, const fs::path& path) {
  std::error_code error;
  if (fs::equivalent(target, path, error)) return;
  const fs::path beside = path.parent_path() / part_name(path.filename());
  fs::create_hard_link(target, beside, error);
  if (!error) fs::rename(beside, path, error);
  if (error) fs::remove(beside, error);
}

}  // namespace

fs::path ObjectFolder::path(const std::string& digest) const {
  return folder_ / digest.substr(0, 2) / digest;
}

std::vector<FigureFile> ObjectFolder::keep(const fs::path& figures) const {
  std::vector<FigureFile> kept;
  for (const fs::path& file : files_in(figures)) {
    const std::string bytes = read_file(file);
    const std::string digest = sha256_hex(bytes);
    const fs::path object = path(digest);
    std::error_code error;
    // A file that a fault of the disk cut short is repaired.
    if (fs::file_size(object, error) != bytes.size() || error)
      OutputFolder(folder_).write(object.lexically_relative(folder_), bytes);
    link_in_place(object, file);
    kept.push_back({file.filename().string(), digest, static_cast<std::int64_t>(bytes.size())});
  }
  return kept;
}

int ObjectFolder::remove_others(const std::vector<std::string>& digests) const {
  int removed = 0;
  std::error_code error;
  if (!fs::exists(folder_, error)) return removed;
  std::vector<fs::path> folders;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->is_directory()) folders.push_back(entry->path());
  if (error) throw IoError(folder_.string(), "cannot be searched: " + error.message());
  for (const fs::path& folder : folders)
    for (const fs::path& file : files_in(folder))
      if (!std::ranges::binary_search(digests, file.filename().string()))
        removed += fs::remove(file, error) ? 1 : 0;
  return removed;
}

std::vector<std::string> ObjectFolder::problems(const std::vector<std::string>& digests) const {
  std::vector<std::string> problems;
  for (const std::string& digest : digests) try {
      if (sha256_hex(read_file(path(digest))) != digest)
        problems.push_back(path(digest).string() +
                           ": its contents do not match the SHA-256 in its name");
    } catch (const IoError& error) {
      problems.emplace_back(error.what());
    }
  return problems;
}

}  // namespace mapproof
