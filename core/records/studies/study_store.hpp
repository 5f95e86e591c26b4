#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/model/experiment.hpp"
#include "core/model/map_record.hpp"
#include "core/model/study.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/records/studies/study_writer.hpp"

namespace mapproof {

/// Everything that one run leaves behind.
struct RunResult {
  Run run;
  RunDetails details;
  std::vector<MapRecord> maps;
  std::vector<Timing> timings;
};

/// What the folder of a study of the mapping methods begins with.
StudyStart study_start(const Experiment& experiment, const Provenance& provenance);

/// A run as it is written: the maps, the details, then the record.
StudyPart part_of(const RunResult& result);

/// Whether the run's files are all there, whole, and of that run.
bool holds_run(const std::filesystem::path& folder, const RunId& id);

/// The study in a folder: the runs finished so far, ascending, each as it was written.
/// @throws IoError if there is no study or a file of it is damaged.
Study read_study(const std::filesystem::path& folder);

/// What figures show of one run beyond its maps; empty in a study of an older version.
/// @throws IoError.
std::optional<RunDetails> read_details(const std::filesystem::path& folder, const RunId& run);

/// The maps of one run, in the order they were written. @throws IoError.
std::vector<MapRecord> read_maps(const std::filesystem::path& folder, const RunId& run);

/// Sorted by run, sensor, method, parameter, step; of a piece timed twice the later one. Empty
/// without a timings.jsonl; a last line torn by a kill is left out. @throws IoError.
std::vector<Timing> read_timings(const std::filesystem::path& folder);

/// In the order they were written; otherwise as read_timings(). @throws IoError.
std::vector<Session> read_sessions(const std::filesystem::path& folder);

}  // namespace mapproof
