#include "core/records/studies/study_folder.hpp"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/files/paths.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_document.hpp"

namespace mapproof {

namespace fs = std::filesystem;

bool is_study(const fs::path& folder) { return is_there(folder / kStudyFile); }

void require_study(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) throw IoError(folder.string(), "does not exist");
  refuse_links_out(folder);
  if (is_study(folder)) return;
  if (!fs::exists(folder / "results.csv", error))
    throw IoError(folder.string(), "holds no study: study.json is missing");
  throw IoError(folder.string(),
                "holds results.csv without study.json; write one beside it, at least "
                R"({"schema": {"name": "mapproof.results_study", "version": 1}, "title": "..."})");
}

std::string study_schema(const fs::path& folder) {
  if (!is_study(folder)) return "";
  const fs::path path = folder / kStudyFile;
  return schema_of(parse_json(read_file(path), path.string()).cursor()).name;
}

std::optional<RunId> run_of_file(const fs::path& file) {
  const std::string name = file.filename().string();
  RunId run;
  const char* end = name.data() + name.size();
  constexpr std::string_view kLayout = "layout-";
  constexpr std::string_view kPose = "-pose-";
  if (!name.starts_with(kLayout)) return std::nullopt;
  const char* at = std::from_chars(name.data() + kLayout.size(), end, run.layout).ptr;
  if (!std::string_view(at, end).starts_with(kPose)) return std::nullopt;
  std::from_chars(at + kPose.size(), end, run.pose);
  if (name != slug(run) + ".json") return std::nullopt;
  return run;
}

bool contains(const Experiment& experiment, const RunId& run) {
  return run.layout >= 1 && run.layout <= experiment.layouts && run.pose >= 1 &&
         run.pose <= experiment.poses;
}

std::vector<RunId> StudyFiles::listed_runs() const {
  std::vector<RunId> listed;
  std::error_code error;
  if (!fs::exists(runs(), error)) return listed;
  for (fs::directory_iterator entry(runs(), error), end; !error && entry != end;
       entry.increment(error))
    if (const auto run = run_of_file(entry->path())) listed.push_back(*run);
  if (error) throw IoError(runs().string(), "cannot be listed: " + error.message());
  std::ranges::sort(listed);
  return listed;
}

}  // namespace mapproof
