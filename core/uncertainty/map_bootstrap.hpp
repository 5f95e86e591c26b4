#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/random.hpp"
#include "core/model/map_uncertainty.hpp"
#include "core/model/points.hpp"

namespace mapproof {

struct MapBootstrapOptions {
  int replicates = 200;    ///< 10 to 10,000.
  Eigen::Index block = 1;  ///< Consecutive steps drawn together, 1 to the number of steps.
  std::uint64_t seed = 1;
};

/// The map that some steps make, in the frame of the estimate: M x 2, NaN rows where a landmark has
/// no position; empty if there is none.
using MapOfSteps = std::function<std::optional<Points>(const std::vector<Eigen::Index>& steps)>;

/// The uncertainty of each landmark: covariances over the maps of bootstrap resamples of the steps
/// [kuensch1989] [politis1992], and the radius of their 95 % confidence ellipses.
///
/// A covariance from N steps in blocks of b is about as good as one of 3 N / 2 b independent maps,
/// and no better than that of the replicates, so the radius is that of Hotelling's T^2 with so many
/// degrees of freedom, not that of a known covariance.
/// @param landmarks  M, the rows of every map.
/// @param steps      N, >= 1.
/// @throws InvalidInput if a bound is broken or a map has other rows.
/// @note Each replicate draws from a seed of its own.
MapUncertainty bootstrap_map(Eigen::Index landmarks, Eigen::Index steps, const MapOfSteps& map_of,
                             const MapBootstrapOptions& options);

/// Squared radius of the ellipse that holds the mean of a normal distribution in the plane with
/// `confidence`, if its covariance was estimated with `freedom` degrees of freedom.
/// @throws InvalidInput unless 0 < confidence < 1 and freedom > 1.
double squared_radius(double confidence, double freedom);

/// Degrees of freedom of a covariance from N steps in blocks of b, and of so many maps: above 1.
double bootstrap_freedom(Eigen::Index steps, Eigen::Index block, int maps);

}  // namespace mapproof
