#include "reports/diff/record_files.hpp"

#include <algorithm>
#include <array>
#include <system_error>

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::array kParts = {"study.json",  "runs",           "maps",       "details",  "paths",
                               "convergence", "histories.json", "space.json", "map.json", "map.csv",
                               "slam.json",   "landmarks.csv",  "path.csv",   "path.tum"};

bool is_kept_in(const fs::path& file) {
  const fs::path extension = file.extension();
  return extension == ".json" || extension == ".csv" || extension == ".tum";
}

}  // namespace

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

}  // namespace mapproof
