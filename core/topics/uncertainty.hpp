#pragma once

#include <vector>

#include "core/model/experiment.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/world.hpp"
#include "core/uncertainty/history_uncertainty.hpp"

namespace mapproof {

/// One sensor on many walks.
struct WalkedSensor {
  Sensor sensor;
  int steps;  ///< Of each walk.
  int walks;
};

/// Histories of one sensor from many walks in the same world, each from a pose of its own.
std::vector<ObservationHistory> walked_histories(const World& world, const WalkOptions& walk,
                                                 const WalkedSensor& walked, std::uint64_t seed);

/// The distribution of the maps of many walks, and how well the ellipses of single ones cover it.
struct Coverage {
  double mean_percent = 0.0;          ///< Of landmarks whose mean is in the ellipse.
  double ground_truth_percent = 0.0;  ///< Of those whose true position is.
  double bias_m = 0.0;                ///< Mean distance of the mean map from the ground truth.
  double spread_m = 0.0;              ///< Root mean square distance of a map from the mean map.
  double predicted_m = 0.0;           ///< The same by the ellipses' covariances.
};

/// The maps of all histories in the frame of the anchors; those that cannot be aligned to it are
/// left out.
/// @param steps  How many observations of each.
std::vector<Points> walked_maps(const std::vector<ObservationHistory>& histories,
                                Eigen::Index steps, const UncertaintyFrame& frame,
                                const HistoryUncertaintyOptions& options);

/// The coverage of the ellipses over all landmarks that are not anchors.
/// @param maps         Of all walks, the first of them those that ellipses were drawn for.
/// @param uncertainties  Of the first maps, as many or fewer.
/// @return NaN without maps or ellipses.
Coverage coverage(const std::vector<Points>& maps, const std::vector<MapUncertainty>& uncertainties,
                  const UncertaintyFrame& frame);

}  // namespace mapproof
