#pragma once

#include "core/model/detection_log.hpp"

namespace mapproof {

/// How well maps of a log and of the same log under other landmark IDs predict scans that neither
/// is made of.
struct HeldOutFit {
  double given = 0.0;     ///< Mean log-likelihood of a pair of detections, nats per pair,
  double repaired = 0.0;  ///< by the map of the given IDs and of the repaired ones.
  int pairs = 0;          ///< That both maps can predict.

  /// Whether the repaired IDs give a map that is as good or better; true without any pair.
  bool is_better() const { return pairs == 0 || repaired >= given; }
};

/// Compares two logs of the same scans. The steps are cut into 20 blocks; from the even ones a map
/// of each log is made, which predicts the distances of the odd ones under the given IDs, and the
/// other way round. A residual is normal, with a deviation common to both maps, or with a share of
/// its own for each map anything up to the greatest distance: pairs whose given IDs are wrong then
/// cost both maps the same.
/// @throws InvalidInput as scan_pairs.
/// @note Four maps by pair_map_of.
HeldOutFit held_out_fit(const DetectionLog& given, const DetectionLog& repaired);

}  // namespace mapproof
