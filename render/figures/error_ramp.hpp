#pragma once

#include <string>
#include <vector>

namespace mapproof {

/// The error at the end of a colour ramp that begins at 0: the 95th percentile, by the nearest
/// rank, so that a few outliers leave colours to the others; at least 1e-6 m. Values that are not
/// finite do not count; without any it is that least.
double end_of_error_ramp(std::vector<double> errors_m);

/// "0 to 0.12 m or more".
std::string error_ramp_text(double end_m);

}  // namespace mapproof
