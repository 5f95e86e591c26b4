#pragma once

#include <span>
#include <vector>

namespace mapproof {

/// Whether paired differences lie to one side of zero.
struct SignedRankTest {
  int pairs = 0;    ///< All.
  int nonzero = 0;  ///< Those that the test is of: pairs without a difference are left out.
  double rank_sum_plus = 0.0;   ///< Of the differences above zero; ties share the mean rank.
  double rank_sum_minus = 0.0;  ///< Of those below.
  double p = 1.0;               ///< Two-sided; 1 if there is no difference at all.
  bool exact = true;            ///< Else by the normal limit.
  /// Matched-pairs rank-biserial correlation [kerby2014]: the share of rank sum that is above zero
  /// less the share below, from -1 to 1; 0 if there is no difference.
  double effect = 0.0;
};

/// Wilcoxon's signed-rank test [wilcoxon1945]. Up to 200 non-zero differences p is that of all 2^n
/// ways to give the ranks a sign, ties as they stand; from there on that of the normal limit,
/// corrected for ties and continuity [conover1999].
///
/// @param differences  Finite; independent of each other.
/// @throws InvalidInput if one is not finite.
/// @note O(n log n), and O(n^3) where it is exact.
SignedRankTest signed_rank_test(std::span<const double> differences);

/// The least p that signed_rank_test() can give of so many pairs.
double least_signed_rank_p(int pairs);

/// p of several tests corrected for their number, in the order given [holm1979]: comparing with a
/// level keeps the chance of any false alarm below it, however the tests depend on each
/// other. At most 1.
/// @throws InvalidInput if one is not in [0, 1].
std::vector<double> holm(std::span<const double> p);

}  // namespace mapproof
