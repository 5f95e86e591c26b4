#pragma once

#include <span>
#include <vector>

namespace mapproof {

/// The middle value, or the mean of the two in the middle. @throws InvalidInput if there is none.
/// @note O(n log n).
double median(std::span<const double> values);

/// The middle value; of two in the middle the larger one. Not NaN, at least one value.
/// @note O(n).
double upper_median(std::vector<double> values);

}  // namespace mapproof
