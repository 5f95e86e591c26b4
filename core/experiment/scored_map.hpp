#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/embed/embedder.hpp"
#include "core/model/experiment.hpp"
#include "core/model/map_record.hpp"
#include "core/model/score.hpp"

namespace mapproof {

/// A map in the frame of its anchors, with its score if it could be tied to them.
struct ScoredMap {
  Points positions_m;  ///< M x 2; NaN rows: the landmark has no position.
  Frame frame = Frame::kGroundTruth;
  std::vector<Status> statuses;  ///< Of the embedding and of the alignment.
  std::optional<Score> score;
};

/// Aligns an embedding to the anchors and scores it against the ground truth.
/// @param ground_truth_m  M x 2.
ScoredMap scored_map(const Embedding& embedding, const Points& ground_truth_m,
                     const std::vector<Eigen::Index>& anchors, AffineFit fit);

/// What a map was made of; the rest of its record is its ScoredMap.
struct MapSource {
  std::string id;  ///< MapRecord::id.
  MapOrigin origin;
  int step = 0;                          ///< Number of observations used, N.
  std::vector<std::string> names;        ///< M.
  std::optional<Points> ground_truth_m;  ///< M x 2; NaN rows: ground truth unknown.
  std::vector<Eigen::Index> anchors;     ///< Rows of the landmarks with known position.
};

/// The record of a map, without a certificate.
MapRecord map_record(MapSource source, ScoredMap map);

/// The solvers' options as an experiment states them.
EmbedderOptions embedder_options(const SolverOptions& solver);

}  // namespace mapproof
