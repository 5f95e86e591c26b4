#pragma once

#include <vector>

#include "core/embed/embedder.hpp"
#include "core/observe/features.hpp"

namespace mapproof {

/// Maps of steps of one history drawn with replacement. Each step's contribution is computed once.
class ResampledMaps {
 public:
  /// @param steps  How many observations are drawn from, 1 <= steps <= history.steps().
  /// @throws InvalidInput if `steps` is out of bounds.
  /// @param rule  See HistoryEmbedder; if given, every resample goes through it as a history.
  ResampledMaps(const ObservationHistory& history, Eigen::Index steps, EmbedderOptions options,
                ProximityRule rule = {});

  /// Coordinates of the maps of the drawn steps by each setting: M x 2 each, NaN rows for landmarks
  /// that none of the steps saw.
  std::vector<Points> maps_of(const std::vector<Eigen::Index>& drawn,
                              const std::vector<MethodSetting>& settings);

  Points map_of(const std::vector<Eigen::Index>& drawn, const MethodSetting& setting) {
    return maps_of(drawn, {setting}).front();
  }

 private:
  /// Fills `drawn_` with the rows of the landmarks that some of the steps saw, and returns which.
  std::vector<Eigen::Index> draw(const std::vector<Eigen::Index>& steps);

  Sensor sensor_;
  Eigen::Index steps_;
  EmbedderOptions options_;
  ProximityRule rule_;
  ObservationHistory history_;  ///< With a rule alone.
  Features rows_;               ///< Of all steps.
  Features drawn_;              ///< Kept between calls for its memory.
};

}  // namespace mapproof
