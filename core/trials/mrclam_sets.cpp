#include "core/trials/mrclam_sets.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "core/base/byte_source.hpp"
#include "core/base/errors.hpp"
#include "core/base/input_file.hpp"
#include "core/base/sha256.hpp"
#include "core/records/observations/mrclam.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// Files and folders in a folder, sorted. @throws IoError.
std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    paths.push_back(entry->path());
  if (error) throw IoError(folder.string(), "cannot be listed: " + error.message());
  std::ranges::sort(paths);
  return paths;
}

bool is_read(const std::string& name) {
  return name == "Barcodes.dat" || name == "Landmark_Groundtruth.dat" ||
         (name.starts_with("Robot") && name.ends_with("_Measurement.dat"));
}

/// Of the files that are read, in the order of their names.
std::string digest_of(const fs::path& folder) {
  std::string digests;
  for (const fs::path& path : entries_of(folder)) {
    const std::string name = unpacked_name(path.filename()).string();
    if (is_read(name)) digests += name + ' ' + sha256_hex(read_input(path)) + '\n';
  }
  return sha256_hex(digests);
}

/// A name as [a-z0-9-]+.
std::string id_of(const std::string& name) {
  std::string id;
  for (char c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (is_plain)
      id += c;
    else if (!id.empty() && id.back() != '-')
      id += '-';
  }
  while (id.ends_with('-')) id.pop_back();
  return id.empty() ? "set" : id;
}

TrialData set_of(const fs::path& folder, const std::vector<TrialData>& others) {
  const std::string name = fs::weakly_canonical(folder).filename().string();
  std::string id = id_of(name);
  for (int number = 2;
       std::ranges::any_of(others, [&](const TrialData& other) { return other.set.id == id; });
       ++number)
    id = fmt::format("{}-{}", id_of(name), number);
  read_mrclam_detections(folder);  // A set that cannot be read is told before anything is made.
  return {.set = {.id = id, .title = printable(name), .digest = digest_of(folder)},
          .folder = folder};
}

}  // namespace

std::vector<TrialData> mrclam_sets(const fs::path& folder) {
  if (is_mrclam(folder)) return {set_of(folder, {})};
  std::vector<TrialData> sets;
  for (const fs::path& path : entries_of(folder)) {
    std::error_code error;
    if (fs::is_directory(path, error) && is_mrclam(path)) sets.push_back(set_of(path, sets));
  }
  std::ranges::sort(sets, {}, [](const TrialData& data) { return data.set.id; });
  return sets;
}

}  // namespace mapproof
