#pragma once

#include <cstdint>

#include "core/model/detection_log.hpp"
#include "core/model/points.hpp"

namespace mapproof::test {

/// Scans without noise from random places and headings in the landmarks' extent, each at the `seen`
/// nearest landmarks. The names are "A", "B", ... or numbers from the 27th on.
DetectionLog scans_at(const Points& landmarks, int scans, int seen, std::uint64_t seed);

}  // namespace mapproof::test
