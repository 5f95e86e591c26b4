#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/map_uncertainty.hpp"
#include "core/model/topic_study.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

struct MeasuredMapSpec {
  std::string id;     ///< [a-z][a-z0-9-]*.
  std::string title;  ///< Empty: as map_figure.
  const MapRecord& map;
  const std::vector<MeasuredPair>& pairs;        ///< May be empty.
  const std::optional<MapUncertainty>& uncertainty;  ///< Of the map, in its frame.
};

/// A map as map_figure draws it, over thin lines between the landmarks whose distances were
/// measured, and with the confidence ellipses of add_ellipses.
/// @throws InvalidInput if parts disagree in size, or a pair's row is none.
Figure measured_map_figure(const MeasuredMapSpec& spec);

struct PairDistancesSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  const MapRecord& map;                    ///< In metres.
  const std::vector<MeasuredPair>& pairs;  ///< Of its rows.
};

/// Measured distances of pairs against those in the map and, where it is known, in the ground
/// ground truth; and next to that their errors over the distance. Pairs without a position are not
/// shown.
/// @throws InvalidInput if a pair's row is none.
Figure pair_distances_figure(const PairDistancesSpec& spec);

}  // namespace mapproof
