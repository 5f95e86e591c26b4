#pragma once

#include <vector>

#include "core/labels/labelled_scans.hpp"
#include "core/labels/robust_map.hpp"

namespace mapproof {

/// Two labels whose detections are of the same two places, in turn, whenever.
struct SharedPlaces {
  int first = 0;  ///< first < second.
  int second = 0;
  RobustMap map;      ///< Of the others alone, with both labels' likeliest places.
  double gain = 0.0;  ///< Over one place each, m^2 a detection of those asked.
};

/// The labels whose distances from each other one have two values, the plainest first: what tells
/// of mixed labels without any map.
/// @note O(P log P) time for P pairs.
std::vector<int> labels_of_two_distances(const LabelledScans& scans, const std::vector<int>& labels,
                                         int landmarks, double width_m, std::size_t most);

/// Of each two of those labels the two places that explain both labels' detections best, each
/// detection being of either, in a map of the other landmarks.
/// @return Descending by gain.
/// @note Of each two labels a map from nothing, and some 5e7 comparisons.
std::vector<SharedPlaces> shared_places(const LabelledScans& scans, const std::vector<int>& labels,
                                        const RobustMap& map, std::size_t most);

}  // namespace mapproof
