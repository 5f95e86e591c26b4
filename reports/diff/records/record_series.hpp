#pragma once

#include <string>
#include <vector>

#include "reports/diff/records/record_comparison.hpp"

namespace mapproof {

/// Whether the runs on both sides have equal seeds: the same seed and the same true positions.
bool have_same_seeds(const RecordSet& baseline, const RecordSet& current,
                     const Tolerances& tolerances);

/// "the true position of landmark L7 moved 41 mm in layout-1-pose-1": the first that differs; empty
/// if none does.
std::string moved_ground_truth(const RecordSet& baseline, const RecordSet& current,
                               const Tolerances& tolerances);

/// Compares every quantity; returns those that are not equal in all runs, with their outcomes.
/// @param values  Set to the number of compared values.
std::vector<Comparison> compare_series(const RecordSet& baseline, const RecordSet& current,
                                       bool same_seeds, const RecordOptions& options, long& values);

/// The subject of the current for each subject of the baseline: the same, or the one that differs
/// only in its parameter.
std::map<std::string, std::string> matched_subjects(const RecordSet& baseline,
                                                    const RecordSet& current);

}  // namespace mapproof
