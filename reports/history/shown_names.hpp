#pragma once

#include <string>

#include "reports/history/night.hpp"

namespace mapproof {

/// The method's name without its parameter: "smacof-knn" of "smacof-knn-K6"; what is no method of
/// the mapping ones as it is.
std::string base_method(const std::string& method);

/// As tables and figures have it: "ISOMAP, K = 6" of "isomap-K6", "ISOMAP, K = 6, anchor-count=5"
/// of a variation; what is no method as it is.
std::string shown_method(const std::string& method);

/// Likewise of what a finding is about: "bearing, ISOMAP, K = 6, 2000 steps" of
/// "bearing, isomap-K6, 2000 steps".
std::string shown_subject(const std::string& subject);

/// subject_of() as shown.
std::string shown_subject(const SeriesId& series);

}  // namespace mapproof
