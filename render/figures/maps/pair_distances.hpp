#pragma once

#include <string>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/trial_study.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

struct PairDistancesSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  const MapRecord& map;                    ///< In metres.
  const std::vector<MeasuredPair>& pairs;  ///< Of its rows.
};

/// Measured distances of pairs against those in the map and, where it is known, in the truth; and
/// beside that what they are off, over the distance. Pairs without a place are not shown.
/// @throws InvalidInput if a pair's row is none.
Figure pair_distances_figure(const PairDistancesSpec& spec);

}  // namespace mapproof
