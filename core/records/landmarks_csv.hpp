#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/model/points.hpp"

namespace mapproof {

/// Landmarks with known positions: anchors, or the truth.
struct NamedPoints {
  std::vector<std::string> names;   ///< M, all different.
  Points positions_m;               ///< M x 2, finite.
  std::vector<std::string> places;  ///< M; where a landmark stands: "line 7".
};

/// Reads CSV (name, x, y; header optional) or MRCLAM's Landmark_Groundtruth.dat.
/// @throws IoError naming file and line.
NamedPoints read_landmarks(const std::filesystem::path& path);

}  // namespace mapproof
