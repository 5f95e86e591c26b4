#include "core/records/ranges/range_log_forms.hpp"

#include <array>
#include <string_view>
#include <system_error>

#include "core/base/files/input_file.hpp"
#include "core/records/ranges/range_log_assembly.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 2> kTextEnds = {"_DR.txt", "_TD.txt"};

/// NAME_TD.txt or NAME_DR.txt, packed or not.
fs::path file_of(const fs::path& stem, const char* end) {
  return plain_or_packed(stem.string() + end);
}

bool is_odometry(const fs::path& path) {
  return unpacked_name(path).filename().string().ends_with("_DR.txt");
}

NumberTable read_ranges(ByteSource& source) {
  if (!is_odometry(source.path())) return read_number_table(source, 4);
  ByteSource ranges(file_of(text_stem(source.path()), "_TD.txt"));
  return read_number_table(ranges, 4);
}

}  // namespace

RangeLog read_range_log_text(ByteSource& source, const RangeLogOptions& options) {
  const fs::path stem = text_stem(source.path());
  const NumberTable ranges = read_ranges(source);
  RangeLogParts parts{.source = ranges.source, .name = options.name};
  check_one_sender(ranges, 1);
  parts.measurements = measurements_in(selected(ranges, {0, 3}, 2));
  const fs::path odometry_path = stem.empty() ? fs::path() : file_of(stem, "_DR.txt");
  std::error_code error;
  if (fs::exists(odometry_path, error)) {
    ByteSource odometry(odometry_path);
    parts.odometry = motions_in(read_number_table(odometry, 3));
    parts.remarks.push_back(
        "The odometry is DR as it stands; whether its heading changes are the robot's own "
        "cannot be determined without the ground truth.");
  }
  return assemble(std::move(parts), options);
}

fs::path text_stem(const fs::path& path) {
  const fs::path plain = unpacked_name(path);
  const std::string whole = plain.string();
  for (const std::string_view end : kTextEnds)
    if (plain.filename().string().ends_with(end)) return whole.substr(0, whole.size() - end.size());
  return {};
}

}  // namespace mapproof
