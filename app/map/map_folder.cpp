#include "app/map/map_folder.hpp"

#include <optional>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/records/maps/map_json.hpp"
#include "core/records/studies/study_store.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

const fs::path& checked_map_folder(const fs::path& folder) {
  check_map_folder(folder);
  return folder;
}

/// Whether there is anything but what a killed process left among its files.
bool holds_files(const fs::path& folder) {
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (!is_leftover(entry->path())) return true;
  if (error) throw IoError(folder.string(), "cannot be listed: " + error.message());
  return false;
}

/// Equal where both are numbers, and missing in the same rows.
bool same_positions(const std::optional<Points>& a, const std::optional<Points>& b) {
  if (a.has_value() != b.has_value()) return false;
  if (!a) return true;
  return a->rows() == b->rows() &&
         ((a->array() == b->array()) || (a->array().isNaN() && b->array().isNaN())).all();
}

/// How two maps differ that are not the same map made twice; empty if they do not.
std::string difference(const MapRecord& there, const MapRecord& here) {
  if (sensor_label(there) != sensor_label(here))
    return fmt::format("of {} there, of {} here", sensor_label(there), sensor_label(here));
  if (there.origin != here.origin)
    return fmt::format("{} there, {} here", method_label(there), method_label(here));
  if (there.step != here.step) return fmt::format("{} steps there, {} here", there.step, here.step);
  if (there.names != here.names) return "of other landmarks";
  if (there.anchors != here.anchors) return "with other anchors";
  if (!same_positions(there.ground_truth_m, here.ground_truth_m))
    return "with other known positions";
  return "";
}

void refuse_other(const fs::path& folder, const MapRecord& there, const MapRecord& here) {
  const std::string what = difference(there, here);
  if (!what.empty())
    throw IoError(
        folder.string(),
        fmt::format("holds another map ({}); choose another --out, or replace it by --force",
                    what));
}

}  // namespace

void check_result_folder(const fs::path& folder, const char* file, const char* kind) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (status.type() == fs::file_type::not_found) return;
  if (error) throw IoError(folder.string(), error.message());
  if (status.type() != fs::file_type::directory) throw IoError(folder.string(), "is not a folder");
  refuse_links_out(folder);
  if (is_study(folder))
    throw IoError(folder.string(),
                  fmt::format("holds a study; choose another --out for the {}", kind));
  if (!fs::exists(folder / file, error) && holds_files(folder))
    throw IoError(
        folder.string(),
        fmt::format("holds files that are not a{} {}; choose another --out",
                    std::string_view("aeiou").find(*kind) == std::string_view::npos ? "" : "n",
                    kind));
}

void check_map_folder(const fs::path& folder) { check_result_folder(folder, kMapFile, "map"); }

void check_same_map(const fs::path& folder, const MapRecord& map) {
  const fs::path file = folder / kMapFile;
  std::error_code error;
  if (!fs::exists(file, error)) return;
  refuse_other(folder, parse_map(read_file(file), file.string()), map);
}

void check_may_become(const fs::path& folder, const MapRecord& map, bool any_method) {
  const fs::path file = folder / kMapFile;
  std::error_code error;
  if (!fs::exists(file, error)) return;
  const MapRecord there = parse_map(read_file(file), file.string());
  MapRecord here = map;
  const MethodSetting *made = setting_of(there), *asked = setting_of(here);
  if (made != nullptr && asked != nullptr &&
      (any_method || (made->method == asked->method && !asked->parameter)))
    std::visit(
        [&](auto& origin) {
          if constexpr (requires { origin.setting; }) origin.setting = *made;
        },
        here.origin);
  refuse_other(folder, there, here);
}

MapFolder::MapFolder(const fs::path& folder) : folder_(checked_map_folder(folder)) {
  refuse_links_out(folder);
}

MapFolder::MapFolder(const fs::path& folder, const MapRecord& map)
    : folder_(checked_map_folder(folder)) {
  refuse_links_out(folder);
  check_same_map(folder, map);
}

}  // namespace mapproof
