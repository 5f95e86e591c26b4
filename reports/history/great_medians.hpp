#pragma once

#include <string>

#include "core/results/quantity.hpp"
#include "reports/history/nightly_run.hpp"

namespace mapproof {

/// Whether errors of a quantity above kGreatestError_m are of maps that diverged, by the medians of
/// all nightly runs: see has_great_errors(const Quantity&, double).
bool has_great_errors(const StudyTrend& trend, const Quantity& quantity);

/// "0.0985 m"; "over 1 km" of a map that diverged.
/// @param great_errors  See has_great_errors().
std::string median_text(double median, const std::string& unit, bool great_errors);

/// "0.0857 → 0.0985 m", "0.0857 m → over 1 km", "over 1 km before and after (1.30 times as great)".
std::string medians_text(double before, double after, const std::string& unit, bool great_errors);

}  // namespace mapproof
