#pragma once

#include <optional>
#include <string_view>

namespace mapproof {

/// Which landmarks are anchors.
enum class AnchorPlacement {
  kWalls,    ///< Those nearest the corners; beyond four, nearest points spread along the walls.
  kRandom,   ///< Any, drawn for each layout.
  kCluster,  ///< Those nearest one corner.
};

/// The name used in files: "walls", "random", "cluster".
std::string_view name(AnchorPlacement placement);

}  // namespace mapproof
