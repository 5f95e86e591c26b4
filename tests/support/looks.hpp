#pragma once

#include <cstdint>

#include "core/model/points.hpp"
#include "core/model/sighting_log.hpp"

namespace mapproof::test {

/// Looks without noise from random places and headings in the landmarks' extent, each at the `seen`
/// nearest landmarks. The names are "A", "B", ... or numbers from the 27th on.
SightingLog looks_at(const Points& landmarks, int looks, int seen, std::uint64_t seed);

}  // namespace mapproof::test
