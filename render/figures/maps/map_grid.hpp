#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "core/model/map_record.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// A map of a grid and what stands above it; its score follows.
struct TitledMap {
  std::string title;  ///< "500 steps".
  MapRecord map;
};

struct MapGridSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::vector<TitledMap> maps;  ///< All in the frame of the ground truth, or none.
  /// The limits are those of the first so many, 1 or more, but for maps with estimates far off;
  /// arrows of others' estimates may end at them.
  std::size_t framing = std::numeric_limits<std::size_t>::max();
};

/// One run's map at each checkpoint, at most ten of them, all with the same limits.
/// @throws InvalidInput if there is no map, frames differ, or a record's parts disagree in size.
Figure film_strip_figure(const MapGridSpec& spec);

/// Two maps or a few side by side with the same limits, such as the run nearest to a paper's
/// example and the median run; the worst landmarks named as in map_figure.
/// @throws InvalidInput as film_strip_figure.
Figure map_pair_figure(const MapGridSpec& spec);

/// Any number of maps with the same limits, such as those of all methods, without names.
/// @throws InvalidInput as film_strip_figure.
Figure map_wall_figure(const MapGridSpec& spec);

}  // namespace mapproof
