#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/sighting_log.hpp"
#include "core/records/sightings.hpp"

namespace mapproof::test {

/// A set of the folder that MAPPROOF_MRCLAM names; empty if it names none.
std::optional<SightingSource> real_looks(const std::string& set);

/// The robot of each step of pooled logs, from 0: times fall back where the next begins.
std::vector<int> robots_of(const SightingLog& log);

/// The time before which half of the looks were.
double middle_time_s(const SightingLog& log);

/// Sightings of a landmark by one robot in looks that show others too.
int shared_sightings(const SightingLog& log, const std::vector<int>& robots, int robot,
                     int landmark);

}  // namespace mapproof::test
