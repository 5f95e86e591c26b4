#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/model/range_log.hpp"
#include "core/records/observations/input_summary.hpp"
#include "core/records/ranges/range_companions.hpp"

namespace mapproof {

/// What was understood of an input, in one line: landmarks and time steps, sensor and unit, the
/// share that is missing, columns and separator.
std::string understood_line(const std::string& name, const InputSummary& summary);

/// Of odometry, a path or positions: how many, how long, how far, and the columns.
std::string understood_line(const std::string& name, const CompanionSummary& summary);

/// Of a range log: landmarks, ranges, odometry and ground truth, and the columns and separator of
/// its table of ranges.
std::string understood_line(const RangeLog& log);

/// The same for --json.
nlohmann::ordered_json understood_json(const InputSummary& summary);
nlohmann::ordered_json understood_json(const CompanionSummary& summary);

}  // namespace mapproof
