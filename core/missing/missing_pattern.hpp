#pragma once

#include <string_view>

#include "core/model/histories/history_blocks.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {

/// The pattern of a history's missing data, without ground truth.
struct MissingPattern {
  double missing_share = 0.0;  ///< Of all entries.
  double apart_share = 0.0;    ///< Of pairs of landmarks: those without a common step,
  double few_share = 0.0;      ///< and with fewer than five.
  /// Root mean square, over the pairs, of how many standard deviations their shared steps are from
  /// those of data missing at random: about 1 at random; more in patterns or in bursts.
  double dispersion = 0.0;
  /// Rank correlation, over the pairs that have shared steps, of their number with the pair's
  /// distance: near -1 where near landmarks are observed together and distant ones are not; about 0
  /// at random.
  double nearness = 0.0;
};

/// @param history  Of landmarks that were all observed.
/// @throws InvalidInput if `steps` is out of bounds.
/// @note As costly as proximities().
MissingPattern missing_pattern(const HistoryBlocks& history, Eigen::Index steps);

/// The best strategy for such missing data.
enum class MissingStrategy { kPairwiseComplete, kPpca, kCovisible };

/// "pairwise-complete", "ppca", "covisible": as on the command line.
std::string_view name(MissingStrategy strategy);

/// Why a strategy is best for the missing data.
enum class StrategyReason {
  kNothingMissing,
  kOfVisibility,  ///< Visibility: its entries are not filled in.
  kHardlyEver,    ///< Many pairs are hardly ever observed together; near ones are.
  kByDistance,
  kByAPattern,  ///< That can be filled in.
  kAtRandom,
};

struct StrategyAdvice {
  MissingStrategy strategy = MissingStrategy::kPairwiseComplete;
  StrategyReason why = StrategyReason::kNothingMissing;
};

/// The strategy that made the best maps of such data in the study of missing entries: bearings with
/// distant landmarks missing, pairwise-complete; ranges of which many pairs were hardly ever
/// observed together, covisible pairs; visibility, or no missing data, pairwise-complete; else
/// PPCA.
StrategyAdvice advised_strategy(const MissingPattern& pattern, Sensor sensor);

/// The deviation of distances over filled entries from pairwise-complete ones, where those exist:
/// the median over the pairs of the difference, as a share of the latter; NaN without any.
double median_disagreement(const Proximities& filled, const Proximities& common);

}  // namespace mapproof
