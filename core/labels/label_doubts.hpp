#pragma once

#include <vector>

#include "core/labels/labelled_scans.hpp"
#include "core/labels/robust_map.hpp"

namespace mapproof {

/// How far the scans fit one map.
struct LabelDoubts {
  double residual_m = 0.0;  ///< Root mean square of the pairs' residuals, those beyond .25 of the
                            ///< median distance counted as that.
  double spread_m = 0.0;    ///< What the pairs' own spread over the log makes them expect.
  std::vector<int> landmarks;  ///< Whose pairs fit worst, at most 4, the worst first.

  /// Whether the residuals are far above what the measurements' own spread explains.
  bool grave() const { return residual_m > kGrave * spread_m; }

  static constexpr double kGrave = 1.12;
};

/// @param map  Of the pairs under these labels.
/// @note O(P log P) time for P pairs.
LabelDoubts label_doubts(const LabelledScans& scans, const std::vector<int>& labels,
                         const RobustMap& map);

}  // namespace mapproof
