#pragma once

#include <cstddef>
#include <vector>

#include "core/association/log_blocks.hpp"
#include "core/association/stretch_search.hpp"
#include "core/model/detection_log.hpp"

namespace mapproof {

/// A log in the form that the search for wrong data associations needs.
struct IdentifiedScans {
  const DetectionLog& log;  ///< Has to outlive it.
  std::vector<ScanPair> pairs;
  LogBlocks blocks;
  std::vector<std::vector<std::size_t>>
      positions;  ///< Index of each step in each of the blocks' orders.
};

/// @param most_blocks  The log is cut into about so many.
/// @throws InvalidInput if most_blocks < 1, or as scan_pairs and cut_in_blocks do.
IdentifiedScans identified_scans(const DetectionLog& log, int most_blocks);

/// Steps of one order that a fault holds in: indices [begin, end).
struct StepStretch {
  std::size_t order = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The stretch of the greatest sum, in one pass. @param gains  Of each index of that order.
StepStretch greatest_sum(std::size_t order, const Eigen::VectorXd& gains);

/// The landmark of a detection under `ids` where the fault holds.
int other_id(const AssociationHypothesis& one, int id);

/// The IDs with the fault corrected over the stretch; a landmark is seen at most once in a scan.
std::vector<int> corrected_ids(const IdentifiedScans& scans, std::vector<int> ids,
                               const AssociationHypothesis& one, const StepStretch& stretch);

/// The log with other IDs, each landmark at most once per scan.
/// @param left_out  Nonzero: detections that are dropped; empty for none.
DetectionLog reassigned(const DetectionLog& log, const std::vector<int>& ids,
                        const std::vector<char>& left_out = {});

}  // namespace mapproof
