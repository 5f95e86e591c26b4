#pragma once

#include <cstdint>

namespace mapproof {

/// What the parts of a run draw their random numbers for: the first key of derive_seed().
enum Purpose : std::uint64_t {
  kLayout = 1,
  kWalk = 2,
  kNoise = 3,
  kVariationNoise = 4,
  kPlacement = 5,
  kSlamExample = 6,
  kSlamPair = 7,
  kSlamHistories = 8,
  kSlamCost = 9,
  kSlamStart = 10,
  kSlamBootstrap = 11,
  kSlamSpace = 12,
  kTopic = 13,
  kExternalMap = 0x65787465726e616c  ///< Of methods of others.
};

}  // namespace mapproof
