#pragma once

#include <cstdint>

#include "core/model/detection_log.hpp"
#include "core/model/experiment.hpp"
#include "core/model/map_uncertainty.hpp"
#include "core/uncertainty/history_uncertainty.hpp"

namespace mapproof {

/// How the confidence ellipses of a map of measured pairs are computed.
struct PairUncertaintyOptions {
  int replicates = 200;    ///< 10 to 10,000.
  Eigen::Index block = 0;  ///< Consecutive scans drawn together; 0: pair_block_length().
  std::uint64_t seed = 1;
  AffineFit fit = AffineFit::kLeastDistances;
};

/// The usual length of the blocks: consecutive scans have correlated errors. For up to 60 pairs,
/// those that most scans measured, the series over all scans of whether each measured more or less
/// than the pair's median, or not at all; the mean of their best_block_length().
/// @return 1 to (scans + 2) / 3, or 1 without scans.
/// @throws InvalidInput as measured_pairs().
/// @note Fewer pairs of long logs: some 3e8 multiplications, or those of one pair.
Eigen::Index pair_block_length(const DetectionLog& log);

/// The uncertainty of pair_map_of(log), see bootstrap_map, from bootstrap resamples of the scans.
/// Which pairs are trusted is decided on the original scans: drawn twice, a wrong one would pass.
/// @throws InvalidInput if a bound is broken, the log has no scan or the frame other landmarks.
/// @note As costly as `replicates` maps.
MapUncertainty pair_uncertainty(const DetectionLog& log, const UncertaintyFrame& frame,
                                const PairUncertaintyOptions& options = {});

}  // namespace mapproof
