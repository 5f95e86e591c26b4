#include "core/records/study_folder.hpp"

#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/records/folder_lock.hpp"
#include "core/records/study_files.hpp"
#include "core/records/study_store.hpp"
#include "core/records/timings_jsonl.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// "/seed is 2007 there and 2008 here": the first of the differences.
std::string difference(const nlohmann::json& there, const nlohmann::json& here) {
  const nlohmann::json patch = nlohmann::json::diff(there, here);
  const nlohmann::json::json_pointer place(patch.at(0).at("path").get<std::string>());
  const auto shown = [&](const nlohmann::json& value) {
    return value.contains(place) ? printable(value[place].dump(), 60) : "missing";
  };
  return fmt::format("{} is {} there and {} here", place.to_string(), shown(there), shown(here));
}

void remove_tree(const fs::path& path) {
  std::error_code error;
  fs::remove_all(path, error);
  if (error) throw IoError(path.string(), "cannot be removed: " + error.message());
}

void check_is_new(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (!is_leftover(entry->path()))
      throw IoError(folder.string(), "is not empty and holds no study; choose another folder");
  if (error) throw IoError(folder.string(), "cannot be listed: " + error.message());
}

}  // namespace

bool take_up_study(const fs::path& folder, const std::string& text, const HeadReader& read_head,
                   const std::vector<fs::path>& parts) {
  const StudyFiles files{folder};
  if (!is_study(folder)) {
    check_is_new(folder);
    remove_leftovers(folder);
    write_file(files.study(), text);
    start_lines(files.timings());
    return false;
  }
  remove_leftovers(folder);
  const std::string old_text = read_file(files.study());
  const StudyHead there = read_head(old_text, files.study().string());
  const StudyHead here = read_head(text, files.study().string());
  if (there.experiment != here.experiment)
    throw IoError(folder.string(),
                  fmt::format("holds another experiment ({}); choose another folder or remove it",
                              difference(there.experiment, here.experiment)));
  const bool is_redone = there.solver_digest != here.solver_digest;
  // The records first: until study.json is replaced, a kill in between leaves the old study's
  // start.
  if (is_redone)
    for (const fs::path& part : parts) remove_tree(part);
  if (old_text != text) write_file(files.study(), text);
  mend_lines(files.timings());
  start_lines(files.timings());
  return is_redone;
}

}  // namespace mapproof
