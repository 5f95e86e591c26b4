#pragma once

#include <span>

#include "core/statistics/signed_rank.hpp"

namespace mapproof {

/// By how much paired values changed, with an interval.
struct PairedChange {
  int units = 0;
  double shift = 0.0;  ///< Mean difference, or by ranks the Hodges-Lehmann estimate.
  double low = 0.0;    ///< Of the interval; infinite where the units are too few for one.
  double high = 0.0;
  double p = 1.0;         ///< Two-sided, of no change; 1 of a single unit that differs or not.
  bool by_ranks = false;  ///< Wilcoxon's test; else Student's t.
  bool equal = false;     ///< All differences are the same, none 0, but for 0.5 % of the largest.
  SignedRankTest ranks = {};  ///< Of the same differences, whichever test judges them.

  /// Of equal differences Student's t has no p: it would be 0, however few they are.
  bool has_p() const { return by_ranks || !equal; }
};

/// Which test paired differences are judged by.
struct PairedChangeOptions {
  double confidence = 0.95;  ///< Of the interval, in (0, 1).
  /// Ranks are taken where n units can give a p this small: 2^(1 - n) is the least they give.
  double finest_p = 1e-6;
};

/// The least p that the paired test of so many units can give. It is 0 by Student's t from two
/// units on; 1 below.
double least_paired_p(int units, const PairedChangeOptions& options);

/// Judges differences between pairs: by Wilcoxon's signed-rank test (see signed_rank.hpp) with the
/// median of Walsh averages and the interval between two of them [hodges1963], where ranks are fine
/// enough; else by Student's t of the mean. Equal differences other than zero have p = 0 by t.
///
/// @param differences  Finite, independent of each other.
/// @throws InvalidInput if a bound is broken or there is none.
/// @note O(n log n) time, O(n) memory: Walsh averages are counted, not kept.
PairedChange paired_change(std::span<const double> differences,
                           const PairedChangeOptions& options = {});

}  // namespace mapproof
