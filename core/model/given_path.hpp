#pragma once

#include <optional>
#include <string>

#include "core/model/range_log.hpp"

namespace mapproof {

/// A path that another program made.
struct GivenPath {
  std::string id;
  Trajectory path;
  std::optional<Trajectory> truth;
};

}  // namespace mapproof
