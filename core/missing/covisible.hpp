#pragma once

#include "core/embed/smacof.hpp"
#include "core/graph/neighbours.hpp"
#include "core/model/embedding.hpp"
#include "core/model/observation_history.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {

/// Which pairs of landmarks are trusted where gaps have a structure.
struct CovisibleOptions {
  int neighbours = 8;    ///< K, >= 1; all others if there are fewer.
  int least_common = 5;  ///< Steps that a pair must have in common, >= 1.
};

/// Proximities of the pairs that the gaps themselves say to be near: the K landmarks of each with
/// which it was most often observed together, for its number of observations. All other pairs are
/// infinitely far, so that methods take the shortest paths.
///
/// That serves where gaps hide what is distant: a sensor of short range. Where something else makes
/// them, neighbours are chosen by it.
/// @param history  Bearings or ranges, of landmarks that were all observed.
/// @return Connected over finite pairs if there are such pairs; distances are over common steps.
/// @throws InvalidInput if options or steps are out of bounds, or for visibility, whose entries say
///         themselves what was seen.
/// @note As costly as proximities(), and O(M^2 log M).
Proximities covisible_proximities(const ObservationHistory& history, Eigen::Index steps,
                                  const CovisibleOptions& options = {});

/// The map of that graph: ISOMAP's, then least stress of its shortest paths d with weights d^-2,
/// which is that of relative errors.
///
/// @param proximities  Those of covisible_proximities(), or others with infinite pairs.
/// @return kFailed, with NaN coordinates, if the pairs leave the landmarks in pieces, or there
///         are fewer than 3.
Embedding relative_stress_map(const Proximities& proximities, const SmacofOptions& options = {});

}  // namespace mapproof
