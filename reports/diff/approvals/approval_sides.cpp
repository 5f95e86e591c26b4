#include "reports/diff/approvals/approval_sides.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/base/paths.hpp"
#include "core/json/json_cursor.hpp"
#include "core/topics/study_kind.hpp"
#include "reports/diff/item_files.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// Records that are not a study.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kOtherRecords = {
    {{"mapproof.map", "one map"}, {"mapproof.slam_run", "the result of one range log"}}};

/// The file that has the schema of a folder's records.
constexpr std::array kHeads = {"study.json", "map.json", "slam.json"};

/// The title of a schema of records; empty if it is of none.
std::string_view title_of(std::string_view schema) {
  for (const StudyKind* kind : all_study_kinds())
    if (kind->study == schema) return kind->title;
  for (const auto& [known, title] : kOtherRecords)
    if (known == schema) return title;
  return "";
}

/// The kind of a folder's records, in words; empty if they cannot be read, which other functions
/// report.
std::string_view kind_of_records(const fs::path& folder) {
  std::error_code error;
  for (const char* name : kHeads) {
    const fs::path file = folder / name;
    if (!fs::is_regular_file(file, error)) continue;
    try {
      const JsonDocument document = parse_json(read_file(file), file.string());
      return title_of(schema_of(document.cursor()).name);
    } catch (const IoError&) {
      return "";
    }
  }
  return "";
}

bool is_drawn(const fs::path& file) {
  const std::string kind = item_name(file, file.parent_path()).kind;
  return !kind.empty() && kind != "csv" && kind != "md" && kind != "tex" && kind != "html";
}

/// What a side holds, in words; empty if that is not known.
std::string_view kind_of(const ApprovalSide& side) {
  if (side.files.contains(kRecordsItem)) return kind_of_records(side.root);
  const auto several = side.files.lower_bound(std::string(kRecordsItem) + "/");
  if (several != side.files.end() && several->first.starts_with(std::string(kRecordsItem) + "/"))
    return "several folders of records";
  for (const auto& [id, paths] : side.files)
    if (std::ranges::any_of(paths, is_drawn)) return "figures or pictures without records";
  return "";
}

void require_apart(const fs::path& baseline, const fs::path& current) {
  if (overlap(baseline, current))
    throw InvalidInput(fmt::format("BASELINE {} and CURRENT {}: one is the other or lies in it",
                                   baseline.string(), current.string()));
}

void require_same_kind(std::string_view before, std::string_view after, const fs::path& baseline,
                       const fs::path& current) {
  if (before != after)
    throw InvalidInput(fmt::format("BASELINE {} holds {}, CURRENT {} holds {}: not approved",
                                   baseline.string(), before, current.string(), after));
}

/// The kind of an item, as "png", or else the extension.
std::string format_of(const fs::path& file) {
  std::error_code error;
  if (fs::is_directory(file, error)) return "a folder";
  const std::string kind = item_name(file, file.parent_path()).kind;
  if (!kind.empty()) return kind;
  const std::string extension = file.extension().string();
  return extension.size() < 2 ? "a file without an extension" : extension.substr(1);
}

/// @throws IoError if the first file of the folder's records has no schema.
void require_records(const fs::path& folder) {
  std::error_code error;
  for (const char* name : kHeads)
    if (const fs::path file = folder / name; fs::is_regular_file(file, error)) {
      schema_of(parse_json(read_file(file), file.string()).cursor());
      return;
    }
}

}  // namespace

void require_comparable(const ApprovalSide& baseline, const ApprovalSide& current) {
  require_apart(baseline.root, current.root);
  if (current.files.empty())
    throw InvalidInput(fmt::format("CURRENT {} holds no records, figures, pictures or tables",
                                   current.root.string()));
  for (const auto& [id, paths] : current.files)
    if (id == kRecordsItem)
      require_records(current.root);
    else if (id.starts_with(std::string(kRecordsItem) + "/"))
      require_records(current.root / fs::path(id).filename());
  const std::string_view before = kind_of(baseline), after = kind_of(current);
  if (!before.empty() && !after.empty())
    require_same_kind(before, after, baseline.root, current.root);
  for (const auto& [id, paths] : baseline.files) {
    if (!id.starts_with(std::string(kRecordsItem) + "/") || !current.files.contains(id)) continue;
    const fs::path name = fs::path(id).filename();
    const auto was = kind_of_records(baseline.root / name),
               is = kind_of_records(current.root / name);
    if (!was.empty() && !is.empty())
      require_same_kind(was, is, baseline.root / name, current.root / name);
  }
}

void require_comparable_files(const fs::path& baseline, const fs::path& current) {
  require_apart(baseline, current);
  std::error_code error;
  if (!fs::is_regular_file(current, error))
    throw InvalidInput(fmt::format("CURRENT {} is not a file", current.string()));
  if (fs::file_size(current, error) == 0 && !error)
    throw InvalidInput(fmt::format("CURRENT {} is empty", current.string()));
  require_same_kind(format_of(baseline), format_of(current), baseline, current);
}

}  // namespace mapproof
