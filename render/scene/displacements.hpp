#pragma once

#include <vector>

#include "core/model/map_record.hpp"
#include "render/scene/room.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

/// Where a map puts its landmarks, as against where they are.
struct Displacements {
  Rods arrows;                      ///< On the floor, from ground truth to estimate.
  std::vector<Eigen::Index> drawn;  ///< Their rows.
  std::vector<double> errors_m;     ///< As many as `drawn`.
  std::size_t far = 0;              ///< Estimates too far outside the ground for an arrow.
  std::size_t missing = 0;          ///< Landmarks without an estimate.
};

/// Arrows of a map in the frame of the ground truth; those of estimates more than .75 sides outside
/// the ground are counted instead. Landmarks without a true position have none.
Displacements displacements(const Points& ground_truth_m, const Points& estimate_m,
                            const Ground& ground);

/// "3 estimates are far outside the room and 2 landmarks have no position.", or nothing.
/// @param of  What they are outside of: "room".
std::string words_of_missing(const Displacements& found, const std::string& of = "room");

}  // namespace mapproof
