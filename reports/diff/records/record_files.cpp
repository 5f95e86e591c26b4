#include "reports/diff/records/record_files.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/input_file.hpp"
#include "reports/diff/records/record_set.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::array kParts = {"study.json",    "parts",    "runs",        "maps",
                               "details",       "paths",    "convergence", "histories.json",
                               "space.json",    "map.json", "map.csv",     "slam.json",
                               "landmarks.csv", "path.csv", "path.tum",    "results.csv"};

bool is_kept_in(const fs::path& file) {
  const fs::path extension = file.extension();
  return extension == ".json" || extension == ".csv" || extension == ".tum";
}

/// Up to `to.size()` bytes, fewer at the end alone.
std::size_t read_block(const Descriptor& file, std::string& to, const std::string& name) {
  std::size_t count = 0;
  while (const std::size_t got = read_some(file, std::span(to).subspan(count), name)) count += got;
  return count;
}

}  // namespace

std::optional<fs::path> folder_of_record(const fs::path& root, const fs::path& file) {
  for (fs::path folder = file.parent_path();; folder = folder.parent_path()) {
    const fs::path inner = folder.empty() ? file : file.lexically_relative(folder);
    if (std::ranges::find(kParts, *inner.begin()) != kParts.end() && holds_records(root / folder))
      return folder;
    if (folder.empty()) return std::nullopt;
  }
}

std::vector<fs::path> record_files(const fs::path& place) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const char* part : kParts) {
    const fs::path path = place / part;
    if (!fs::is_directory(path, error)) {
      if (fs::exists(fs::symlink_status(path, error))) files.emplace_back(part);
      continue;
    }
    for (fs::recursive_directory_iterator entry(path, error), end; !error && entry != end;
         entry.increment(error)) {
      std::error_code unknown;
      if (!entry->is_directory(unknown) && is_kept_in(entry->path()))
        files.push_back(entry->path().lexically_relative(place));
    }
  }
  std::ranges::sort(files);
  return files;
}

bool same_bytes(const fs::path& a, const fs::path& b) {
  std::error_code error;
  const auto size = fs::file_size(a, error);
  if (error || size != fs::file_size(b, error) || error) return false;
  try {
    const Descriptor first = open_input(a), second = open_input(b);
    std::string block(1 << 16, '\0'), other(1 << 16, '\0');
    for (std::size_t count = block.size(); count == block.size();) {
      count = read_block(first, block, a.string());
      if (read_block(second, other, b.string()) != count ||
          block.compare(0, count, other, 0, count) != 0)
        return false;
    }
    return true;
  } catch (const IoError&) {
    return false;  // Whoever reads it says why.
  }
}

}  // namespace mapproof
