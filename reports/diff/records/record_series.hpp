#pragma once

#include <string>
#include <vector>

#include "reports/diff/records/record_comparison.hpp"

namespace mapproof {

/// Whether the runs on both sides are of equal seeds: the same seed and the same true places.
bool have_same_seeds(const RecordSet& baseline, const RecordSet& current,
                     const Tolerances& tolerances);

/// Every quantity that is not equal throughout, its outcome decided.
/// @param values  Set to the number of values that were compared.
std::vector<Comparison> compare_series(const RecordSet& baseline, const RecordSet& current,
                                       bool same_seeds, const RecordOptions& options, long& values);

/// Which subject of the current one of the baseline is compared with: itself, or the one that
/// differs from it in its parameter alone.
std::map<std::string, std::string> matched_subjects(const RecordSet& baseline,
                                                    const RecordSet& current);

}  // namespace mapproof
