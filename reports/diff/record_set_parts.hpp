#pragma once

#include <filesystem>
#include <string>

#include "core/model/slam_study.hpp"
#include "core/records/study_files.hpp"
#include "reports/diff/record_set.hpp"

namespace mapproof {

/// What read_records() is made of.

/// All of a JSON value as text by its pointers; arrays of plain values are one value.
void add_settings(RecordSet& set, const std::string& text, const std::string& source);

/// "bearing/isomap-K9/2000", with its family.
std::string add_subject(RecordSet& set, Sensor sensor, const MethodSetting& setting,
                        const std::string& place);

void add_value(RecordSet& set, const std::string& subject, std::string_view quantity,
               const std::string& run, double value);
void add_score(RecordSet& set, const std::string& subject, const std::string& run,
               const std::optional<Score>& score);
void add_map(RecordSet& set, const std::string& id, const MapRecord& map);
void add_statuses(RecordSet& set, const std::string& id, const std::vector<Status>& statuses);
void add_slam_run(RecordSet& set, const SlamRun& run);

/// Whether both files are there and hold the same bytes.
bool same_bytes(const std::filesystem::path& a, const std::filesystem::path& b);

RecordSet read_study_records(const std::filesystem::path& folder,
                             const std::filesystem::path& beside);
RecordSet read_slam_records(const std::filesystem::path& folder);
/// Of trials: quantities other than those of a map's score are `loss` or `gain`, their name in the
/// subject.
RecordSet read_trial_records(const std::filesystem::path& folder,
                             const std::filesystem::path& beside);

/// Lists the files that are others than those of the other side.
void add_others(RecordSet& set, const std::filesystem::path& folder,
                const std::filesystem::path& beside);

}  // namespace mapproof
