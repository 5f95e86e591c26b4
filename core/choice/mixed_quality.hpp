#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"

namespace mapproof {

/// Continuity of a map against the observations of several sensors: the weighted mean of what each
/// sensor's neighbourhoods keep (see neighbourhoods_kept), 1 at best. Neighbourhoods are of 10, or
/// a quarter of the landmarks that the sensor knows and the map has.
///
/// So maps of one sensor and of several can be compared without ground truth.
/// @param distances  Of each sensor, M x M; infinite: not known.
/// @param weights    As many, >= 0.
/// @param map        M x 2; NaN rows: unmapped.
/// @return NaN if no sensor with a weight knows 8 of the map's landmarks.
/// @throws InvalidInput if sizes differ.
double mixed_continuity(const std::vector<Eigen::MatrixXd>& distances,
                        const std::vector<double>& weights, const Points& map);

}  // namespace mapproof
