#include "core/records/studies/topic_store.hpp"

#include <algorithm>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/json/record_writer.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/records/studies/timings_jsonl.hpp"
#include "core/records/studies/topic_json.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// Where things stand in the folder of the study of a topic.
struct TopicFiles {
  fs::path folder;  ///< Empty: paths are below the folder.

  fs::path study() const { return folder / kStudyFile; }
  fs::path timings() const { return folder / kTimingsFile; }
  fs::path parts() const { return folder / "parts"; }
  fs::path part(const std::string& id) const { return parts() / (id + ".json"); }
};

StudyHead read_topic_head(const std::string& text, const std::string& source) {
  const TopicStudy study = parse_topic_study(text, source);
  return {.experiment = to_json_value(study.experiment).dump(),
          .solver_digest = study.provenance.solver_digest};
}

/// The parts that there can be, in their order.
std::vector<std::string> part_ids(const TopicExperiment& experiment) {
  std::vector<std::string> ids;
  if (!experiment.data.empty()) {
    for (const DataSet& set : experiment.data) ids.push_back(set.id);
    return ids;
  }
  for (int layout = 1; layout <= experiment.layouts; ++layout)
    for (int pose = 1; pose <= experiment.poses; ++pose)
      ids.push_back(slug(RunId{.layout = layout, .pose = pose}));
  return ids;
}

/// Of a method timed twice on a part the later one.
void add_seconds(const fs::path& path, TopicStudy& study) {
  std::error_code error;
  if (!fs::exists(path, error)) return;
  for (const MethodSeconds& timing : parse_timings(read_file(path), path.string()).outcomes) {
    const auto part = std::ranges::find(study.parts, timing.part, &TopicPart::id);
    if (part == study.parts.end()) continue;
    const auto known = std::ranges::find(part->seconds, timing.method, &MethodSeconds::method);
    if (known == part->seconds.end())
      part->seconds.push_back(timing);
    else
      *known = timing;
  }
}

}  // namespace

StudyStart study_start(const TopicStudy& study) {
  return {.text = topic_study_json(study),
          .read_head = read_topic_head,
          .records = {TopicFiles{}.parts()}};
}

StudyPart part_of(const TopicPart& part, const std::string& digest) {
  StudyPart written{.files = {{TopicFiles{}.part(part.id), topic_part_json(part, digest)}}};
  for (const MethodSeconds& timing : part.seconds) written.timings += timing_line(timing);
  return written;
}

bool holds_part(const fs::path& folder, const TopicDesign& design, const std::string& part,
                const std::string& digest) {
  const fs::path path = TopicFiles{folder}.part(part);
  try {
    const ReadTopicPart read = parse_topic_part(read_file(path), path.string(), &design);
    return read.part.id == part && read.digest == digest;
  } catch (const IoError&) {
    return false;
  }
}

std::vector<fs::path> part_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(TopicFiles{folder}.parts(), error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  std::ranges::sort(files);
  return files;
}

TopicStudy read_topic_study(const fs::path& folder) {
  const TopicFiles files{folder};
  require_study(folder);
  TopicStudy study = parse_topic_study(read_file(files.study()), files.study().string());
  for (const std::string& id : part_ids(study.experiment)) {
    const fs::path path = files.part(id);
    std::error_code error;
    if (!fs::exists(path, error)) continue;
    study.parts.push_back(parse_topic_part(read_file(path), path.string(), &study.design).part);
    if (study.parts.back().id != id)
      throw IoError(path.string(), "/id", "states that it is " + study.parts.back().id);
  }
  add_seconds(files.timings(), study);
  return study;
}

}  // namespace mapproof
