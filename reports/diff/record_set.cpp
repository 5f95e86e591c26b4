#include "reports/diff/record_set.hpp"

#include <span>
#include <system_error>

#include <fmt/format.h>

#include "core/base/byte_source.hpp"
#include "core/base/errors.hpp"
#include "core/base/input_file.hpp"
#include "core/base/not_finite.hpp"
#include "core/json/json_cursor.hpp"
#include "core/records/input_kind.hpp"
#include "core/records/map_files.hpp"
#include "core/records/slam_run_json.hpp"
#include "core/records/slam_store.hpp"
#include "core/records/study_store.hpp"
#include "core/records/trial_store.hpp"
#include "reports/diff/record_files.hpp"
#include "reports/diff/record_set_parts.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

bool is_plain(const nlohmann::json& value) {
  if (!value.is_array()) return value.is_primitive();
  return std::ranges::all_of(value, [](const auto& item) { return item.is_primitive(); });
}

void flatten(const nlohmann::json& value, const std::string& pointer,
             std::map<std::string, std::string>& out) {
  if (is_plain(value)) {
    out[pointer] = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return;
  }
  if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      flatten(value[i], fmt::format("{}/{}", pointer, i), out);
    return;
  }
  for (const auto& [key, item] : value.items()) flatten(item, pointer + "/" + key, out);
}

/// Whether a study.json is there, be it readable or not.
bool has_study(const fs::path& folder) {
  std::error_code error;
  return fs::exists(fs::symlink_status(folder / "study.json", error));
}

/// The JSON file of a map or of one log's result: the path itself, or the file in its folder.
fs::path single_file(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return path;
  for (const char* name : {"map.json", "slam.json"})
    if (fs::is_regular_file(path / name, error)) return path / name;
  return {};
}

/// Whether a file is the JSON of a map or of one log's result, by what it says it is.
bool is_single(const fs::path& file) {
  try {
    ByteSource source(file);
    const std::string schema = is_json(source) ? json_schema(source) : "";
    return schema == "mapproof.map" || schema == "mapproof.slam_run";
  } catch (const IoError&) {
    return false;
  }
}

/// Up to `to.size()` bytes, fewer at the end alone.
std::size_t read_block(const Descriptor& file, std::string& to, const std::string& name) {
  std::size_t count = 0;
  while (const std::size_t got = read_some(file, std::span(to).subspan(count), name)) count += got;
  return count;
}

RecordSet read_single(const fs::path& file) {
  const std::string text = read_input(file);
  const std::string source = file.string();
  const std::string schema = schema_of(parse_json(text, source).cursor()).name;
  RecordSet set;
  set.kind = schema;
  if (schema == "mapproof.map") {
    const MapRecord map = parse_map(text, source);
    const std::string subject = add_subject(set, map.sensor, map.setting, std::to_string(map.step));
    set.called[map.id] = subject;
    set.settings["/method"] = label(map.setting);
    set.runs[""] = "";
    add_score(set, subject, "", map.score);
    add_statuses(set, map.id, map.statuses);
    add_map(set, map.id, map);
    return set;
  }
  if (schema != "mapproof.slam_run") throw IoError(source, "holds no records but " + schema);
  const SlamRun run = parse_slam_run(text, source);
  add_slam_run(set, run);
  return set;
}

}  // namespace

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

void add_settings(RecordSet& set, const std::string& text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  if (document.root.contains("experiment")) flatten(document.root["experiment"], "", set.settings);
  const auto seed = set.settings.find("/seed");
  if (seed != set.settings.end()) set.seed = seed->second;
}

std::string add_subject(RecordSet& set, Sensor sensor, const MethodSetting& setting,
                        const std::string& place) {
  const std::string subject = fmt::format("{}/{}/{}", name(sensor), slug(setting), place);
  if (setting.parameter)
    set.families[subject] = {
        fmt::format("{}/{}/{}", name(sensor), info(setting.method).name, place),
        parameter_text(setting)};
  return subject;
}

void add_value(RecordSet& set, const std::string& subject, std::string_view quantity,
               const std::string& run, double value) {
  set.values[{subject, std::string(quantity)}][run] = value;
}

void add_score(RecordSet& set, const std::string& subject, const std::string& run,
               const std::optional<Score>& score) {
  add_value(set, subject, "mpe_m", run, score ? score->mpe_m : kNaN);
  add_value(set, subject, "moe_percent", run, score ? score->moe_percent : kNaN);
  add_value(set, subject, "mpe_all_fitted_m", run, score ? score->mpe_all_fitted_m : kNaN);
  add_value(set, subject, "moe_unmirrored_percent", run,
            score ? score->moe_unmirrored_percent : kNaN);
}

void add_map(RecordSet& set, const std::string& id, const MapRecord& map) {
  set.points[id] = {.quantity = map.frame == Frame::kTruth ? "landmark_m" : "landmark_shape",
                    .frame = map.frame,
                    .names = map.names,
                    .points = map.estimate,
                    .truth = map.truth_m};
}

void add_statuses(RecordSet& set, const std::string& id, const std::vector<Status>& statuses) {
  std::string codes;
  for (const Status& status : statuses)
    codes += (codes.empty() ? "" : ", ") + std::string(name(status.code));
  set.statuses[id] = codes;
}

bool holds_records(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return has_study(path) || !single_file(path).empty();
  return is_single(path);
}

void add_others(RecordSet& set, const fs::path& folder, const fs::path& beside) {
  for (const fs::path& file : record_files(folder))
    if (file != "study.json" && !same_bytes(folder / file, beside / file))
      set.others[file.generic_string()] = folder / file;
}

RecordSet read_records(const fs::path& path, const fs::path& beside) {
  std::error_code error;
  RecordSet set;
  if (has_study(path)) {
    set = is_slam_study(path)    ? read_slam_records(path)
          : is_trial_study(path) ? read_trial_records(path, beside)
                                 : read_study_records(path, beside);
  } else {
    const fs::path file = single_file(path);
    if (file.empty()) throw IoError(path.string(), "holds no records");
    set = read_single(file);
  }
  if (fs::is_directory(path, error))
    add_others(set, path, beside);
  else if (!same_bytes(path, beside))
    set.others[""] = path;
  return set;
}

}  // namespace mapproof
