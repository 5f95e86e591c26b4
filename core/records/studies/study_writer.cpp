#include "core/records/studies/study_writer.hpp"

#include <algorithm>
#include <mutex>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/records/studies/timings_jsonl.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

void check_is_new(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (!is_leftover(entry->path()))
      throw IoError(folder.string(), "is not empty and holds no study; choose another folder");
  if (error) throw IoError(folder.string(), "cannot be listed: " + error.message());
}

/// What other than the experiment made records different; empty: nothing did.
std::string other_maker(const StudyHead& there, const StudyHead& here) {
  if (there.solver_digest != here.solver_digest) return "another solver";
  if (there.method_files == here.method_files) return "";
  for (const MethodFiles& files : here.method_files)
    if (std::ranges::find(there.method_files, files) == there.method_files.end())
      return "other files of the method " + files.method;
  return "other files of a method";
}

/// Brings a locked folder to where a study goes on.
/// @return What had made the records that were removed; empty: none were.
std::string take_up_study(const fs::path& folder, const StudyStart& start) {
  const fs::path study = folder / kStudyFile;
  const OutputFolder outputs(folder);
  if (!is_study(folder)) {
    check_is_new(folder);
    remove_leftovers(folder);
    outputs.write(kStudyFile, start.text);
    start_lines(folder);
    return "";
  }
  remove_leftovers(folder);
  const std::string old_text = read_file(study);
  const StudyHead there = start.read_head(old_text, study.string());
  const StudyHead here = start.read_head(start.text, study.string());
  if (there.experiment != here.experiment)
    throw IoError(folder.string(),
                  fmt::format("holds another experiment ({}); choose another folder or remove it",
                              first_difference(there.experiment, here.experiment)));
  const std::string redone = other_maker(there, here);
  // The records first: until study.json is replaced, a kill in between leaves the old study's
  // start.
  if (!redone.empty()) {
    for (const fs::path& record : start.records) outputs.remove(record);
    for (const char* file : {kTimingsFile, kResultsFile}) outputs.remove(file);
  }
  if (old_text != start.text) outputs.write(kStudyFile, start.text);
  mend_lines(folder);
  start_lines(folder);
  return redone;
}

}  // namespace

std::string first_difference(const std::string& there_text, const std::string& here_text) {
  const auto there = nlohmann::json::parse(there_text);
  const auto here = nlohmann::json::parse(here_text);
  const nlohmann::json patch = nlohmann::json::diff(there, here);
  const nlohmann::json::json_pointer location(patch.at(0).at("path").get<std::string>());
  const auto shown = [&](const nlohmann::json& value) {
    return value.contains(location) ? printable(value[location].dump(), 60) : "missing";
  };
  return fmt::format("{} is {} there and {} here", location.to_string(), shown(there), shown(here));
}

struct StudyWriter::State {
  State(const fs::path& study, const std::function<void()>& busy)
      : folder(study), lock(busy ? FolderLock(study, busy) : FolderLock(study)) {}

  void append(const std::string& lines) {
    const std::lock_guard guard(mutex);
    OutputFolder(folder).append(kTimingsFile, lines);
  }

  fs::path folder;
  FolderLock lock;
  std::string redone = {};
  std::mutex mutex;
};

StudyWriter::StudyWriter(const fs::path& folder, const StudyStart& start,
                         const std::function<void()>& busy) {
  make_folder(folder);
  state_ = std::make_unique<State>(folder, busy);
  refuse_links_out(folder);
  state_->redone = take_up_study(folder, start);
}

StudyWriter::StudyWriter(StudyWriter&&) noexcept = default;
StudyWriter& StudyWriter::operator=(StudyWriter&&) noexcept = default;
StudyWriter::~StudyWriter() = default;

const fs::path& StudyWriter::folder() const { return state_->folder; }

const std::string& StudyWriter::redone() const { return state_->redone; }

void StudyWriter::write(const StudyPart& part) {
  const OutputFolder outputs(state_->folder);
  if (!part.emptied.empty()) outputs.remove(part.emptied);
  for (const PartFile& file : part.files) outputs.write(file.file, file.text);
  if (!part.timings.empty()) state_->append(part.timings);
}

void StudyWriter::write_session(const Session& session) { state_->append(session_line(session)); }

}  // namespace mapproof
