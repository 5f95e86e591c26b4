#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/base/files/output_folder.hpp"
#include "core/model/slam/slam.hpp"
#include "core/model/slam/slam_experiment.hpp"
#include "core/model/slam/slam_study.hpp"
#include "core/records/studies/study_writer.hpp"

namespace mapproof {

/// The files of a range-only study (docs/file-formats.md). All parsers throw IoError with the
/// place.

/// runs/ID.json (mapproof.slam_run): the log and what each method made of it.
std::string slam_run_json(const SlamRun& run);
SlamRun parse_slam_run(std::string_view text, const std::string& source);

/// convergence/ID.json (mapproof.slam_convergence).
std::string convergence_json(const ConvergenceCurve& curve);
ConvergenceCurve parse_convergence(std::string_view text, const std::string& source);

/// histories.json (mapproof.range_histories).
std::string range_histories_json(const RangeHistoryStudy& histories);
RangeHistoryStudy parse_range_histories(std::string_view text, const std::string& source);

/// space.json (mapproof.space_run): a flight and what was made of its ranges.
std::string space_run_json(const SpaceRun& run);
SpaceRun parse_space_run(std::string_view text, const std::string& source);

/// What the folder of a range-only study begins with.
StudyStart study_start(const SlamExperiment& experiment, const Provenance& provenance);

/// Parts as they are written; a run's paths, as TUM and CSV, come before its record.
StudyPart part_of(const SlamRun& run, std::span<const SlamTiming> timings);
StudyPart part_of(const ConvergenceCurve& curve);
StudyPart part_of(const RangeHistoryStudy& histories);
StudyPart part_of(const SpaceRun& space);
StudyPart part_of(std::span<const FactorizationCost> costs);

/// Whether the folder holds a part, whole. A run with a log counts if it was made of that log.
bool holds_run(const std::filesystem::path& folder, const std::string& id, const RangeLog& log);
bool holds_run(const std::filesystem::path& folder, const std::string& id);
bool holds_convergence(const std::filesystem::path& folder, const std::string& id);
bool holds_histories(const std::filesystem::path& folder);
bool holds_space(const std::filesystem::path& folder);

/// Writes each path of a run, the true one among them, as NAME.tum and NAME.csv into a folder of
/// its own, whose earlier files are removed.
/// @param paths  That folder, below `folder`.
/// @throws IoError.
void write_paths(const SlamRun& run, const OutputFolder& folder,
                 const std::filesystem::path& paths);

/// The study in a folder, as far as it was made: the simulated run first, the data sets in the
/// experiment's order, those without a run in `missing`.
/// @throws IoError if there is no such study or a file of it is damaged.
SlamStudy read_slam_study(const std::filesystem::path& folder);

/// Of a piece timed twice the later one, in order of run and method, of landmarks and steps.
/// @throws IoError.
SlamTimings read_slam_timings(const std::filesystem::path& folder);

}  // namespace mapproof
