#pragma once

#include <string_view>
#include <vector>

#include "core/model/trial_study.hpp"

namespace mapproof {

/// What all parts of a study came to for one quantity, over them all: for conclusions.
///
/// @return Of the finite values alone, in the order of the parts.
/// @throws InvalidInput if the design has no such quantity.
std::vector<double> trial_values(const TrialStudy& study, std::string_view setup,
                                 std::string_view series, double level, std::string_view quantity);

/// Their mean; NaN without any.
double trial_mean(const TrialStudy& study, std::string_view setup, std::string_view series,
                  double level, std::string_view quantity);

/// Adds to what a series took on a part: one entry a series.
void add_seconds(TrialPart& part, std::string_view series, double seconds);

}  // namespace mapproof
