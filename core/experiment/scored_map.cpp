#include "core/experiment/scored_map.hpp"

#include <utility>

#include "core/score/map_score.hpp"

namespace mapproof {

ScoredMap scored_map(const Embedding& embedding, const Points& ground_truth_m,
                     const std::vector<Eigen::Index>& anchors, AffineFit fit) {
  AlignedMap aligned = align_to_anchors(embedding.coordinates, ground_truth_m, anchors, fit);
  ScoredMap map{.positions_m = std::move(aligned.positions_m),
                .frame = aligned.aligned ? Frame::kGroundTruth : Frame::kSimilarity,
                .statuses = embedding.statuses,
                .score = std::nullopt};
  map.statuses.insert(map.statuses.end(), aligned.statuses.begin(), aligned.statuses.end());
  if (aligned.aligned) map.score = score_map(map.positions_m, ground_truth_m, anchors, fit);
  return map;
}

MapRecord map_record(MapSource source, ScoredMap map) {
  return {.id = std::move(source.id),
          .origin = std::move(source.origin),
          .step = source.step,
          .frame = map.frame,
          .names = std::move(source.names),
          .estimate = std::move(map.positions_m),
          .ground_truth_m = std::move(source.ground_truth_m),
          .anchors = std::move(source.anchors),
          .statuses = std::move(map.statuses),
          .certificate = std::nullopt,
          .score = map.score};
}

EmbedderOptions embedder_options(const SolverOptions& solver) {
  EmbedderOptions options;
  options.only_seen_together = solver.only_seen_together;
  options.smacof.relative_fall = solver.smacof_relative_fall;
  options.smacof_knn.relative_fall = solver.smacof_knn_relative_fall;
  return options;
}

}  // namespace mapproof
