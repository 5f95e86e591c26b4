#pragma once

#include <cstdint>
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

/// A log with a fault of two labels: "half" or "tenth" of the looks at random with both swapped,
/// "stretch": swapped from .3 to .6 of the looks' times; "replaced30" or "replaced70": sightings of
/// the first called by the second's name in .3 of the looks at random, or in the last .7 of the
/// time.
SightingLog with_fault(const SightingLog& log, const std::string& kind, int first, int second,
                       std::uint64_t seed);

/// Mean distance from the truth of the map that `mapproof map --kind range-bearing --fit rigid`
/// makes of a log, m.
double map_error_m(const SightingLog& log, const Points& truth_m);

}  // namespace mapproof::test
