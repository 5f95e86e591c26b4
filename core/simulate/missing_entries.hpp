#pragma once

#include "core/base/random.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/world.hpp"

namespace mapproof {

/// How likely each entry of a history is lost: M x N, the higher the sooner.
using Losses = Eigen::MatrixXd;

/// Entries lost at random: uniform.
Losses random_losses(Eigen::Index landmarks, Eigen::Index steps, Random& random);

/// A sensor of limited range: the distance of landmark and robot, m.
Losses range_losses(const World& world, const Path& path);

/// Landmarks hidden by others: less the radius, m, that cylinders would need for one of those
/// nearer to the robot to cut the ray to the landmark's centre; -inf for the nearest landmark.
/// @note O(N M^2) time.
Losses occlusion_losses(const World& world, const Path& path);

/// The history without the entries of the highest losses, ties by step and row: a sensor of such a
/// range, or landmarks of such a width, that this share is missing.
/// @param share  In [0, 1); rounded to whole entries.
/// @throws InvalidInput if it is not, or the sizes differ.
ObservationHistory with_missing(ObservationHistory history, const Losses& losses, double share);

}  // namespace mapproof
