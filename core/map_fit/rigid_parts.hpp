#pragma once

#include <vector>

#include "core/model/trial_study.hpp"
#include "core/pairs/orientation.hpp"

namespace mapproof {

/// Landmarks that hold together, and how firmly they hang on the others.
struct RigidPart {
  std::vector<int> landmarks;  ///< Ascending.
  int pairs = 0;               ///< Measured pairs with landmarks of other parts,
  int scans = 0;               ///< and in how many scans these were seen.
};

/// What measured pairs and the orientations of triples determine up to translation and rotation.
struct RigidParts {
  std::vector<RigidPart> parts;  ///< The largest first; each landmark in one of them.
};

inline constexpr int kFirmScans = 3;  ///< A pair of fewer may be of wrong landmark IDs.

/// The parts of a map of which each has one shape alone, generically: a part grows from a pair by
/// landmarks with three firm pairs to it, or two and a triple whose orientation was seen. Two parts
/// join if they share three landmarks, or two and a firm pair or triple, or one and two firm pairs,
/// or none and four: with fewer the one may fold over, or turn about, the other. A pair is firm
/// from kFirmScans scans on.
/// @param pairs  first < second < landmarks.
/// @param turns  May be empty.
/// @param is_mapped  Which landmarks to divide; of size `landmarks`.
/// @note O(landmarks pairs) for each part.
RigidParts rigid_parts(const std::vector<MeasuredPair>& pairs,
                       const std::vector<SeenOrientation>& turns,
                       const std::vector<bool>& is_mapped);

}  // namespace mapproof
