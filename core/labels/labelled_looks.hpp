#pragma once

#include <cstddef>
#include <vector>

#include "core/labels/log_blocks.hpp"
#include "core/labels/stretch_search.hpp"
#include "core/model/sighting_log.hpp"

namespace mapproof {

/// A log in the form that the search for wrong labels needs.
struct LabelledLooks {
  const SightingLog& log;  ///< Has to outlive it.
  std::vector<LookPair> pairs;
  LogBlocks blocks;
  std::vector<std::vector<std::size_t>> places;  ///< Of each step in each of the blocks' orders.
};

/// @param most_blocks  The log is cut into about so many.
/// @throws InvalidInput if most_blocks < 1, or as look_pairs and cut_in_blocks do.
LabelledLooks labelled_looks(const SightingLog& log, int most_blocks);

/// Steps of one order that a fault holds in: [begin, end) places.
struct StepStretch {
  std::size_t order = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The stretch of the greatest sum, in one pass. @param gains  Of each place of that order.
StepStretch greatest_sum(std::size_t order, const Eigen::VectorXd& gains);

/// Whose a sighting under `label` is where the fault holds.
int other_label(const LabelHypothesis& one, int label);

/// The labels with the fault mended over the stretch; a landmark is seen once in a look.
std::vector<int> mended_labels(const LabelledLooks& looks, std::vector<int> labels,
                               const LabelHypothesis& one, const StepStretch& stretch);

/// The log with other labels, a landmark once a look.
/// @param left_out  Nonzero: sightings that are not taken over; empty for none.
SightingLog relabelled(const SightingLog& log, const std::vector<int>& labels,
                       const std::vector<char>& left_out = {});

}  // namespace mapproof
