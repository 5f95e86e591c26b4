#pragma once

#include <vector>

#include "core/embed/embedder.hpp"
#include "core/model/observation_history.hpp"

namespace mapproof {

/// What one sensor gives to a map of several.
struct MixedSensor {
  Sensor sensor = Sensor::kVisibility;
  MethodSetting setting;      ///< Of its own map, with its parameter.
  Embedding own;              ///< Of its observations alone, M x 2.
  Embedding by_order;         ///< The same by the joint map's way; empty if `own` is not a map.
  Eigen::MatrixXd distances;  ///< M x M; infinite: not known to this sensor.
  double reliability = 0.0;   ///< See reliability().
  double weight = 0.0;        ///< In the mean distances that the joint map starts from; sum 1.
  double share = 0.0;         ///< In the weights of all pairs of the joint map; sum 1.
};

/// A joint map and what it was made of.
struct MixedMap {
  Embedding joint;        ///< M x 2; NaN rows: unseen by every sensor.
  Embedding mean;         ///< The map of the mean distances, likewise; `joint` starts from it too.
  MethodSetting setting;  ///< Of `mean`, with its parameter.
  std::vector<MixedSensor> sensors;
};

/// One map of the same landmarks as several sensors observed them, and each sensor's own: mean
/// distances weighted by reliability are mapped, and joint_map() begins from there and from each
/// sensor's own map by order; the one of the least order_misfit() is taken.
///
/// Steps need not be the same: each sensor's distances are over its own. A landmark that one sensor
/// never saw is placed by the others.
/// @param histories  Of the same landmarks in the same order, of different sensors.
/// @param steps      The first so many of each are used; 0: all.
/// @param setting    Without a parameter: the usual one of each map.
/// @param own        Settings of the sensors' own maps, one each; empty: `setting` of all.
/// @return `joint` is kFailed if the mean distances give no map, and has the statuses of that map.
/// @throws InvalidInput if landmarks differ, sensors repeat, `own` is of another number of sensors,
///         or `steps` is out of bounds.
/// @note S + 1 maps by the method and 2 S + 1 of joint_map() for S sensors.
MixedMap mixed_map(const std::vector<ObservationHistory>& histories, Eigen::Index steps,
                   const MethodSetting& setting, const EmbedderOptions& options = {},
                   const std::vector<MethodSetting>& own = {});

}  // namespace mapproof
