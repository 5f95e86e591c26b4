#pragma once

#include <string>

#include "core/results/quantity.hpp"

namespace mapproof {

/// Whether a quantity has errors in m, of which those above kGreatestError_m are of maps that
/// diverged: one of mapproof's, or one with an error that is not above it.
/// @param least_m  The least value of the quantity.
bool has_great_errors(const Quantity& quantity, double least_m);

/// Of two errors of maps that diverged: "over 1 km before and after (1.30 times as great)".
std::string great_errors_text(double before_m, double after_m);

}  // namespace mapproof
