#pragma once

#include "core/embed/smacof.hpp"
#include "core/graph/neighbours.hpp"
#include "core/model/embedding.hpp"
#include "core/model/observation_history.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {

/// Which pairs of landmarks are trusted where missing data have a structure.
struct CovisibleOptions {
  int neighbours = 8;    ///< K, >= 1; all others if there are fewer.
  int least_common = 5;  ///< Steps that a pair must have in common, >= 1.
};

/// Proximities of the pairs that the missing data imply to be near: for each landmark the K others
/// with which it was most often observed together, relative to its number of observations. All
/// other pairs are infinitely far, so that methods take the shortest paths.
///
/// This serves where distant landmarks are missing: a sensor of short range. Where data are missing
/// for another reason, that reason chooses the neighbours.
/// @param history  Bearings or ranges, of landmarks that were all observed.
/// @return Connected over finite pairs if there are such pairs; distances are pairwise-complete.
/// @throws InvalidInput if options or steps are out of bounds, or for visibility, whose entries are
///         themselves the detections.
/// @note As costly as proximities(), and O(M^2 log M).
Proximities covisible_proximities(const ObservationHistory& history, Eigen::Index steps,
                                  const CovisibleOptions& options = {});

/// The map of that graph: ISOMAP's, then least stress of its shortest paths d with weights d^-2,
/// the stress of relative errors.
///
/// @param proximities  Those of covisible_proximities(), or others with infinite pairs.
/// @return kFailed, with NaN coordinates, if the pairs do not connect the landmarks, or there
///         are fewer than 3.
Embedding relative_stress_map(const Proximities& proximities, const SmacofOptions& options = {});

}  // namespace mapproof
