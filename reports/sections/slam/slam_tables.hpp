#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/model/slam/slam_study.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// Errors of every method on every run under the method's own alignment, which is named in a
/// column; methods without an error have a row all the same. The least mean of a run among rigidly
/// aligned rows is marked.
Table slam_error_table(std::string id, std::string caption, std::span<const SlamRun* const> runs);

/// Mean and RMSE under every other alignment that was tried; empty if there is none.
std::optional<Table> slam_alignment_table(std::span<const SlamRun* const> runs);

/// What was recorded, compared with what the paper prints of it.
Table slam_drive_table(std::span<const SlamRun* const> runs);

/// Landmarks of the record that mapped_record() picks; empty if there is none.
std::optional<Table> slam_landmark_table(const SlamRun& run);

/// The numbers of the convergence figures.
Table slam_convergence_table(std::span<const ConvergenceCurve> curves);

/// Each mapping method on ranges and on squared ranges, and the spectral map.
Table slam_history_table(const RangeHistoryStudy& study);

/// Errors of a flight in space, with landmarks known and with none.
Table slam_space_table(const SpaceRun& run);

/// Seconds of methods and of the factorisation; vary from run to run.
std::optional<Table> slam_seconds_table(const SlamStudy& study,
                                        std::span<const SlamTiming> timings);

}  // namespace mapproof
