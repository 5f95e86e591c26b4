#pragma once

#include <vector>

#include "core/model/map_record.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

/// Where a map puts its landmarks, as against where they are.
struct Displacements {
  Rods arrows;                      ///< On the floor, from ground truth to estimate.
  std::vector<Eigen::Index> drawn;  ///< Their rows.
  std::vector<double> errors_m;     ///< As many as `drawn`.
  std::size_t far = 0;              ///< Estimates too far outside the room for an arrow.
  std::size_t missing = 0;          ///< Landmarks without an estimate.
};

/// Arrows of a map in the frame of the ground truth; those of estimates more than .75 sides outside
/// [0, side] x [0, side] are counted instead.
Displacements displacements(const Points& ground_truth_m, const Points& estimate_m, double side_m);

/// "3 estimates are far outside the room and 2 landmarks have no position.", or nothing.
std::string words_of_missing(const Displacements& found);

}  // namespace mapproof
