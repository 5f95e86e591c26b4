#pragma once

#include <memory>

#include <Eigen/Core>

#include "core/base/not_finite.hpp"
#include "core/graph/components.hpp"
#include "core/model/detection_log.hpp"
#include "core/model/histories/history_blocks.hpp"

namespace mapproof {

/// The distances of proximities() between M landmarks, a part at a time: no array of M x M is held.
struct HistoryDistances {
  Eigen::Index landmarks = 0;
  /// Square roots of Proximities::squared_distances; 0 for what is rounding alone. Landmarks that
  /// were never seen together may be left out; then `others` is their distance.
  VisitedDistances distances;
  /// The distance of landmarks never seen together, sqrt(2) for visibility; infinite for others.
  double apart = kInfinity;
  int groups = 1;  ///< Of landmarks that were seen together; 1 for other sensors than visibility.
};

/// Of what one sensor observed. Visibility that is sparse is counted over the steps of each
/// landmark; bits are counted in words; all else is multiplied block by block.
///
/// @param history  Of landmarks that were all observed. What it reads from has to outlive the
///                 result.
/// @param rows_at_a_time  Of a block; 0: from 64 to 4096, as memory allows.
/// @throws InvalidInput unless 1 <= steps <= history.steps().
/// @note A visit takes O(M^2 N) time, or O(sum of k^2) over steps with k landmarks where that is
///       less. Besides the history it takes two blocks of rows and their products: 512 MB, or two
///       of 64 rows where these take more (of 2e6 bearings, 4 GB), and as much as one of them while
///       a block is read.
HistoryDistances history_distances(const HistoryBlocks& history, Eigen::Index steps,
                                   Eigen::Index rows_at_a_time = 0);

/// Of the visibility of a log of detections, which need not outlive the result.
///
/// @throws InvalidInput if a detection names no landmark or no step.
/// @note A visit takes O(sum of k^2) time over steps with k landmarks; memory for each detection
///       8 bytes, for each thread 4 M.
HistoryDistances visibility_distances(const DetectionLog& log);

}  // namespace mapproof
