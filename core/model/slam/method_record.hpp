#pragma once

#include <algorithm>

#include "core/model/slam/slam_study.hpp"

namespace mapproof {

/// The method's record in that run; null if it has none.
inline const SlamRecord* record_of(const SlamRun& run, SlamMethod method) {
  const auto found = std::ranges::find(run.records, method, &SlamRecord::method);
  return found == run.records.end() ? nullptr : &*found;
}

}  // namespace mapproof
