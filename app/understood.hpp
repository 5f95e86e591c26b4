#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/records/observations/input_summary.hpp"

namespace mapproof {

/// What was understood of an input, in one line: landmarks and time steps, sensor and unit, the
/// share that is missing, columns and separator.
std::string understood_line(const std::string& name, const InputSummary& summary);

/// The same for --json.
nlohmann::ordered_json understood_json(const InputSummary& summary);

}  // namespace mapproof
