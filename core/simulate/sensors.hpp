#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/random.hpp"
#include "core/model/experiment.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/study.hpp"
#include "core/model/world.hpp"
#include "core/simulate/landmark_grid.hpp"

namespace mapproof {

/// The sensor's measurement of each landmark along the path: M x N.
///
/// Visibility: 1 if the cylinder looks wider than the visual angle [yairi2007, section 4.3.1] and
/// no other cylinder cuts the ray to its centre. Bearing: direction to the centre relative to the
/// heading, in (-pi, pi]. Range: distance to the centre. Noise and dropout come after that; a
/// noisy bearing is wrapped again, a noisy range is at least 0. Bearings and ranges of landmarks
/// beyond the sensor's reach are missing; what is drawn does not depend on the reach.
/// @note Without noise and dropout `random` is not drawn from.
ObservationHistory observe(const World& world, const Path& path, const SensorOptions& options,
                           Random& random);

/// How far a landmark's centre may be and still be seen, m: its cylinder looks 2 asin(r / d) wide.
double visibility_reach(const World& world, const SensorOptions& options);

/// The visibility of each landmark from `position`, without noise: M. Of many positions, see Sight.
std::vector<View> views_from(const World& world, const Eigen::RowVector2d& position,
                             const SensorOptions& options);

/// What a sensor of visibility sees, without noise, without going through all landmarks.
class Sight {
 public:
  /// @param world  Has to outlive the object.
  Sight(const World& world, const SensorOptions& options);

  /// The landmarks seen from `position`, ascending.
  std::vector<Eigen::Index> visible(const Eigen::RowVector2d& position) const;

  /// The views of those within reach, ascending by landmark.
  std::vector<std::pair<Eigen::Index, View>> views(const Eigen::RowVector2d& position) const;

 private:
  const World& world_;
  bool occlusion_;
  double reach_m_;
  LandmarkGrid grid_;
};

/// How often one landmark hid another along the path.
/// @note As costly as observe().
Occlusion count_occlusion(const World& world, const Path& path, const SensorOptions& options);

/// "L1", "L2", ...: the names of simulated landmarks.
std::vector<std::string> landmark_names(Eigen::Index count);

}  // namespace mapproof
