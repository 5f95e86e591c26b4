#include "core/uncertainty/history_uncertainty.hpp"

#include "core/align/aligned_to.hpp"
#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/score/map_score.hpp"
#include "core/uncertainty/block_length.hpp"
#include "core/uncertainty/map_bootstrap.hpp"
#include "core/uncertainty/resampled_maps.hpp"

namespace mapproof {
std::optional<Points> in_frame(const Points& coordinates, const UncertaintyFrame& frame,
                               AffineFit fit) {
  if (frame.keeps_scale) {
    if (frame.anchors.empty()) return aligned_rigidly_to(coordinates, frame.positions_m);
    Points known = Points::Constant(coordinates.rows(), 2, kNaN);
    known(frame.anchors, Eigen::all) = frame.positions_m(frame.anchors, Eigen::all);
    return aligned_rigidly_to(coordinates, known);
  }
  if (!frame.anchors.empty()) {
    AlignedMap map = align_to_anchors(coordinates, frame.positions_m, frame.anchors, fit);
    if (!map.aligned) return std::nullopt;
    return std::move(map.positions_m);
  }
  return aligned_to(coordinates, frame.positions_m);
}

MapUncertainty history_uncertainty(const ObservationHistory& history, Eigen::Index steps,
                                   const UncertaintyFrame& frame,
                                   const HistoryUncertaintyOptions& options) {
  if (frame.positions_m.rows() != history.landmarks())
    throw InvalidInput("confidence ellipses need a frame of all landmarks");
  const Eigen::Index block = options.block > 0 ? options.block : map_block_length(history, steps);
  ResampledMaps maps(history, steps, options.embedder, options.rule);
  const auto map_of = [&](const std::vector<Eigen::Index>& drawn) {
    return in_frame(maps.map_of(drawn, options.setting), frame, options.fit);
  };
  return bootstrap_map(history.landmarks(), steps, map_of,
                       {.replicates = options.replicates, .block = block, .seed = options.seed});
}

}  // namespace mapproof
