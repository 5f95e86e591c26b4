#pragma once

#include <string>
#include <vector>

#include "core/model/fit.hpp"

namespace mapproof {

// The sentences on the fit of a map to its data: for the console, pages and figures. Names of
// landmarks are made printable.

/// "The data fit the map.", "The data do not fit the map: all ranges are 3.02 m too long."
std::string verdict_text(const Fit& fit);

/// A few words: "fits", "does not fit".
std::string verdict_words(FitVerdict verdict);

/// A sentence: "Ranges are stamped 5.0 s late (statistic 310, bound 20)."
std::string cause_text(const FitCause& cause);

/// A sentence on the least effect that would have been seen; empty if there is none: "An offset of
/// all ranges below 0.31 m could not be seen in these data."
std::string limit_text(const FitTest& test);

/// A sentence on what is missing for a test.
std::string why_text(FitMissing missing);

/// A sentence on groups of landmarks that are open relative to each other; empty without parts.
std::string parts_text(const Fit& fit);

/// What is tested, as the label of a row: "offset of all ranges", "offset of 7".
std::string test_label(FitCode code, const std::vector<std::string>& landmarks);

/// A sentence that explains the label, if it does not speak for itself; else empty: "Connection:
/// whether only few measurements connect some landmarks with the others."
std::string test_meaning(const FitTest& test);

}  // namespace mapproof
