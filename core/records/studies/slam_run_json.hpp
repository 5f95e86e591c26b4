#pragma once

#include <string>
#include <string_view>

#include "core/model/slam.hpp"
#include "core/model/slam_experiment.hpp"
#include "core/model/slam_study.hpp"

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

}  // namespace mapproof
