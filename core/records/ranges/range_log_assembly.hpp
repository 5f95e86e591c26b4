#pragma once

#include <vector>

#include "core/model/range_log.hpp"
#include "core/records/ranges/gathered_range_log.hpp"
#include "core/records/ranges/range_log_options.hpp"

namespace mapproof {

/// Puts the landmarks in order (of the letters of their names and then of the number behind them if
/// all names end in a number, else as they first come), sorts the measurements by time, turns true
/// headings that are off by 180 degrees, and remarks on all of it and on what is missing or not to
/// be trusted.
/// @param options  Whose files stand in for what was gathered.
/// @throws IoError if there is no measurement, there are more than 5000 landmarks with measurements
/// or
///         with true positions, or the start is not before the first motion.
RangeLog assemble(RangeLogParts parts, const RangeLogOptions& options);

/// Whether the heading changes are the increments of the true heading to the last digit, and not
/// all 0.
bool turns_are_the_ground_truths(const std::vector<Motion>& motions,
                                 const Trajectory& ground_truth);

}  // namespace mapproof
