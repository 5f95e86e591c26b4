#pragma once

#include <string>
#include <vector>

#include "app/map/map_result.hpp"
#include "app/map/reference.hpp"
#include "core/model/experiment.hpp"
#include "core/uncertainty/history_uncertainty.hpp"

namespace mapproof {

/// How a map comes into the frame of its anchors.
struct FrameFit {
  AffineFit affine = AffineFit::kLeastDistances;
  bool is_metric = false;  ///< The map is in metres before: its scale is worth keeping.
  bool is_rigid = false;   ///< And it keeps it: rotated, translated and perhaps reflected.
};

/// The steps align and score: brings a map into the frame of its anchors, if there are any that
/// serve, and computes its errors if there is a ground truth. A metric map is in metres without
/// anchors, too; its position and heading are then arbitrary, or those of the ground truth.
/// @param result  `record.estimate` in a frame of its own; names and statuses.
/// @return How other maps of the landmarks are brought to the same frame.
UncertaintyFrame align(MapResult& result, const Reference& reference, const FrameFit& fit);

/// The same for a map that is not metric, without remarks.
void align_and_score(MapRecord& record, const Points& coordinates, const Reference& reference,
                     AffineFit fit);

/// Whether a map in the frame of its anchors is worth anything there.
struct FrameCheck {
  std::vector<std::string> warnings = {};  ///< A sentence each.
  std::vector<FitCause> tests = {};        ///< For with_tests().
};

/// A map is worth little if its errors are as large as if all landmarks were put at the anchors'
/// mean, or, without a ground truth, if its landmarks lie far outside of what the anchors span; or
/// if it misses anchors. A map that was not in metres is met by its anchors but for their
/// redundancy: by how much, compared with their spread, tells whether one is wrong.
FrameCheck check_frame(const MapRecord& record);

}  // namespace mapproof
