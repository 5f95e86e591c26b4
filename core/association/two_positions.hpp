#pragma once

#include <vector>

#include "core/association/identified_scans.hpp"
#include "core/association/robust_map.hpp"

namespace mapproof {

/// Two IDs whose detections alternate between the same two positions, at any time.
struct SharedPositions {
  int first = 0;  ///< first < second.
  int second = 0;
  RobustMap map;      ///< Of the others alone, with both IDs' likeliest positions.
  double gain = 0.0;  ///< Over one position each, m^2 per tested detection.
};

/// The IDs whose distances from each other one have two values, the clearest first: evidence of
/// mixed IDs without any map.
/// @note O(P log P) time for P pairs.
std::vector<int> ids_of_two_distances(const IdentifiedScans& scans, const std::vector<int>& ids,
                                      int landmarks, double width_m, std::size_t most);

/// For each pair of those IDs the two positions that explain both IDs' detections best, each
/// detection being at either, in a map of the other landmarks.
/// @return Descending by gain.
/// @note For each pair of IDs a map without a start, and some 5e7 comparisons.
std::vector<SharedPositions> shared_positions(const IdentifiedScans& scans,
                                              const std::vector<int>& ids, const RobustMap& map,
                                              std::size_t most);

}  // namespace mapproof
