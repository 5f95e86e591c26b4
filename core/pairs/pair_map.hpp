#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/embed/smacof.hpp"
#include "core/model/embedding.hpp"
#include "core/pairs/orientation.hpp"
#include "core/pairs/pair_distances.hpp"
#include "core/pairs/pair_solution.hpp"

namespace mapproof {

/// A map of measured pairs.
struct PairMap {
  Embedding embedding;  ///< In metres, defined up to translation and rotation, and reflection for
                        ///< pair_map.
  std::vector<MeasuredPair> pairs;  ///< The pairs it was made of, with their final precisions.
};

/// A metric map of landmarks some of whose distances were measured: classical scaling of the
/// shortest paths over the measured pairs [tenenbaum2000], without those that violate triangle
/// inequalities (see contradicted_pairs), then least stress over the measured pairs alone
/// [deleeuw1977], each weighted by its precision and, iteratively, by how well it fits [geman1985].
///
/// @param pairs  first < second < landmarks, none twice; distances >= 0, precisions > 0, finite.
/// @param names  Of the landmarks, M, for the statuses.
/// @return M rows. The largest group of landmarks that pairs hold together is mapped; the others
///         get NaN rows, and kLandmarkUnseen (not in any pair) or kTooFewObservations (in another
///         group). kUndetermined names landmarks with too few pairs for one position. kFailed if no
///         three hold together. From SMACOF: kNotConverged, kRankDeficient. Scale is kept.
/// @throws InvalidInput if the bounds above are broken.
/// @note O(M^3) time for the start, and reweightings + 1 runs of SMACOF.
PairMap pair_map(const std::vector<MeasuredPair>& pairs, const std::vector<std::string>& names,
                 const PairMapOptions& options = {},
                 const std::vector<SeenOrientation>& turns = {});

/// The pair map of the scans, reflected so that its landmarks have the orientation that the scans
/// show, bearings being counter-clockwise.
PairMap pair_map_of(const DetectionLog& log, const PairNoise& noise = {},
                    const PairMapOptions& options = {});

}  // namespace mapproof
