#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/model/slam/slam_study.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// "plaza-1/refined": which record of a study a number comes from.
std::string record_id(const SlamRun& run, const SlamRecord& record);

/// The method's error under its own alignment; null if it has none.
const TrajectoryError* error_of(const SlamRun& run, SlamMethod method);

/// The record whose landmarks are shown: the refined one, or else the first that has any; null if
/// none has.
const SlamRecord* mapped_record(const SlamRun& run);

/// Whether the study is the paper's, so that it can be compared with the paper.
bool is_of_paper(const SlamStudy& study);

/// What the experiment simulates, {"Simulated area", "20 m x 20 m"}; empty if it simulates nothing.
std::vector<std::pair<std::string, std::string>> simulation_facts(const SlamExperiment& experiment);

/// The names of the logs of the experiment that are not there.
std::vector<std::string> missing_titles(const SlamStudy& study);

/// A sentence on each log of the experiment that is not there: its name and how to get it.
std::vector<std::string> missing_logs(const SlamStudy& study);

/// "Plaza 1", or the id where the log has no name.
std::string title_of(const SlamRun& run);

/// Id of the figure of the run's paths.
std::string path_figure_id(const SlamRun& run);

/// Length of the true path, or else of the odometry, m; empty with neither.
std::optional<double> length_m(const RangeLog& log);

/// The power of the number of measurements with which the error of the observation model changes;
/// NaN if it has less than two errors.
double convergence_slope(const ConvergenceCurve& curve);

/// "a line through 3 means": what that power rests on. Its points are means over the same pairs of
/// world and path, which allow it no interval.
std::string slope_basis(const ConvergenceCurve& curve);

/// Sentences, each with a blank before it, on what the slope of a paper's convergence rests on: the
/// exactly known variance of the noise is taken off, the slope of the plain SVD if it was made, and
/// worlds that were drawn again. Empty for other studies.
std::string variant_words(const SlamStudy& study);

/// The same for a tile: "; as in the paper, with the noise’s variance left in, −0.20".
std::string brief_variant_words(const SlamStudy& study);

}  // namespace mapproof
