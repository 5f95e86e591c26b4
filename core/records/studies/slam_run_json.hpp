#pragma once

#include <string>
#include <string_view>

#include "core/model/slam_experiment.hpp"
#include "core/model/slam_study.hpp"
#include "core/model/space_slam.hpp"

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

/// What study.json of a range-only study holds.
struct SlamOrder {
  SlamExperiment experiment;
  Provenance provenance;
};

/// study.json (mapproof.slam_study).
std::string slam_study_json(const SlamExperiment& experiment, const Provenance& provenance);
SlamOrder parse_slam_study(std::string_view text, const std::string& source);

}  // namespace mapproof
