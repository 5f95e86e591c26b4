#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/embed/embedder.hpp"
#include "core/model/submaps.hpp"

namespace mapproof {

/// A person's map, and the sub-maps that it was joined from, if it was.
struct MapEmbedding {
  Embedding embedding;
  MethodSetting setting;  ///< With its parameter.
  std::optional<JoinedSubmaps> joined;
  std::vector<std::string> remarks;
};

/// Maps a history as a whole, or in overlapping groups.
/// @param submaps  Most landmarks of a group, 6 or more; 0: as a whole.
/// @param overlap  Share that a group borrows from its neighbours, in [0, 0.8]; empty: the usual.
/// @param rule     See HistoryEmbedder; of each group by itself.
MapEmbedding embed_observations(const ObservationHistory& history, Eigen::Index steps,
                                MethodSetting setting, const EmbedderOptions& options,
                                const ProximityRule& rule, int submaps,
                                std::optional<double> overlap);

}  // namespace mapproof
