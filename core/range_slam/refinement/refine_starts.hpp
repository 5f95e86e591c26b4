#pragma once

#include <cstdint>

#include "core/model/range_log.hpp"
#include "core/model/slam.hpp"

namespace mapproof {

/// Dead reckoning, and the landmarks that its path gives.
SlamEstimate dead_reckoning_start(const RangeLog& log);

/// Dead reckoning, and landmarks anywhere within reach of its path.
SlamEstimate random_start(const RangeLog& log, std::uint64_t seed);

}  // namespace mapproof
