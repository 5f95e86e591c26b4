#pragma once

#include <optional>
#include <string>

#include "core/model/range_log.hpp"
#include "core/model/slam/slam.hpp"

namespace mapproof {

/// A path that another program made.
struct GivenPath {
  std::string id;
  Trajectory path;
  std::optional<Trajectory> ground_truth = {};
  Alignment alignment = Alignment::kNone;  ///< To the ground truth, before it is drawn.
  std::optional<double> rms_m = {};        ///< Distance from the ground truth once that is done.
};

}  // namespace mapproof
