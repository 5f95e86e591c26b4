#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/points.hpp"
#include "core/model/sighting_log.hpp"

namespace mapproof {

/// What looks showed, with what is needed to talk about the file that it came from.
struct SightingSource {
  SightingLog log;
  std::optional<Points> truth_m;     ///< M x 2, if the source holds it; NaN rows: unknown.
  std::vector<std::string> remarks;  ///< What was dropped or assumed, a sentence each.
  std::vector<std::string> places;   ///< M; where a landmark stands: "line 7".
  std::string path;                  ///< For errors: the file or folder that was read.
};

}  // namespace mapproof
