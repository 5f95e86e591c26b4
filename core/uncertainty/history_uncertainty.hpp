#pragma once

#include <cstdint>
#include <vector>

#include "core/embed/embedder.hpp"
#include "core/model/experiment.hpp"
#include "core/model/map_uncertainty.hpp"
#include "core/model/observation_history.hpp"

namespace mapproof {

/// What the confidence ellipses of a map refer to, and how they are computed.
struct HistoryUncertaintyOptions {
  MethodSetting setting;  ///< With its parameter.
  EmbedderOptions embedder = {};
  ProximityRule rule = {};  ///< See HistoryEmbedder.
  int replicates = 200;     ///< 10 to 10,000.
  Eigen::Index block = 0;   ///< Consecutive steps drawn together; 0: map_block_length().
  std::uint64_t seed = 1;
  AffineFit fit = AffineFit::kLeastDistances;
};

/// How the maps of bootstrap resamples are brought to the frame of the estimate: fitted to the
/// anchors if there are any, else aligned to the estimate by the similarity, with or without
/// reflection, that fits best, since the freedom of such a map is not uncertainty.
struct UncertaintyFrame {
  Points positions_m;                 ///< M x 2: the anchors' rows are read; or the estimate.
  std::vector<Eigen::Index> anchors;  ///< Empty: align to `positions_m`.
  bool keeps_scale = false;           ///< Maps are metric: they are aligned rigidly in either case.
};

/// A map in that frame; empty if it cannot be aligned.
std::optional<Points> in_frame(const Points& coordinates, const UncertaintyFrame& frame,
                               AffineFit fit);

/// The uncertainty of the map of the first `steps` observations, see bootstrap_map.
/// @throws InvalidInput if a bound is broken.
/// @note As costly as `replicates` maps, O(M^2 N) each and the method's own time.
MapUncertainty history_uncertainty(const ObservationHistory& history, Eigen::Index steps,
                                   const UncertaintyFrame& frame,
                                   const HistoryUncertaintyOptions& options);

}  // namespace mapproof
