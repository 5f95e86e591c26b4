#include <limits>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/records/run_json.hpp"
#include "reports/diff/record_set_parts.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// Runs `read`; trouble with the file is noted and the rest goes on.
template <typename Read>
void try_file(RecordSet& set, const fs::path& folder, const fs::path& file, Read read) {
  try {
    read();
  } catch (const IoError& error) {
    set.problems.push_back({file.lexically_relative(folder).generic_string(), error.what()});
  }
}

void add_record(RecordSet& set, const std::string& run, const RunRecord& record) {
  const std::string subject =
      add_subject(set, record.sensor, record.setting, std::to_string(record.step));
  add_score(set, subject, run, record.score);
  add_value(set, subject, "iterations", run, record.iterations);
  if (record.stress) add_value(set, subject, "stress", run, *record.stress);
  if (record.certificate)
    add_value(set, subject, "relative_gap", run, record.certificate->relative_gap);
  add_statuses(set, run + "/" + subject, record.statuses);
}

void add_variation(RecordSet& set, const std::string& run, const Experiment& experiment,
                   const VariationRecord& record) {
  for (const Variation& variation : experiment.variations)
    if (variation.id == record.variation) {
      const std::string subject = add_subject(set, variation.sensor, record.setting,
                                              fmt::format("{}-{}", record.variation, record.level));
      add_score(set, subject, run, record.score);
      add_statuses(set, run + "/" + subject, record.statuses);
    }
}

void add_run(RecordSet& set, const Experiment& experiment, const Run& run) {
  const std::string id = slug(run.id);
  set.runs[id] = fmt::format("layout-{}", run.id.layout);
  PlacedPoints& world = set.worlds[id];
  world.points = run.world.landmarks_m;
  for (const RunRecord& record : run.records) add_record(set, id, record);
  for (const VariationRecord& record : run.variations) add_variation(set, id, experiment, record);
  for (const Eigen::Index anchor : run.anchors) set.anchors[id] += fmt::format(" {}", anchor);
}

void add_maps(RecordSet& set, const fs::path& file) {
  for (const MapRecord& map : parse_maps(read_file(file), file.string()).maps)
    add_map(set, map.id, map);
}

}  // namespace

RecordSet read_study_records(const fs::path& folder, const fs::path& beside) {
  const StudyFiles files{folder}, other{beside};
  RecordSet set;
  set.kind = "mapproof.study";
  set.repeats = true;
  const std::string text = read_file(files.study());
  const Study study = parse_study(text, files.study().string());
  add_settings(set, text, files.study().string());
  set.provenance = study.provenance;
  for (const RunId& id : files.listed_runs()) {
    const fs::path file = files.run(id);
    set.runs[slug(id)] = "";
    try_file(set, folder, file, [&] {
      const Run run = parse_run(read_file(file), file.string());
      if (run.id != id) throw IoError(file.string(), "/run", "says that it is " + slug(run.id));
      add_run(set, study.experiment, run);
    });
    std::error_code error;
    if (fs::exists(files.map(id), error) && !same_bytes(files.map(id), other.map(id)))
      try_file(set, folder, files.map(id), [&] { add_maps(set, files.map(id)); });
  }
  return set;
}

}  // namespace mapproof
