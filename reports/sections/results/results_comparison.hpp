#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/sections/results/paired_methods.hpp"
#include "reports/sections/results/results_view.hpp"

namespace mapproof {

/// The methods of a block by one quantity under one condition. Their numbers are indices into
/// ResultsStudy::methods.
struct MethodComparison : PairedMethods {
  const ResultsBlock* block = nullptr;
  const Quantity* quantity = nullptr;
  std::string id = {};  ///< Of figures and tables: the block's, and of a text its level.
  Condition at = {};
  std::string level = {};  ///< "noise 0.4 m"; empty: the block has one.
  /// Levels after that one, at which no two methods could be compared.
  std::vector<std::string> passed_over = {};
  std::vector<std::string> left_out = {};  ///< Labels of those not compared.
};

/// Compares the methods of a block at one of its conditions; empty where no two methods have a run
/// in common.
std::optional<MethodComparison> compare_at(const ResultsView& view, const ResultsBlock& block,
                                           const Quantity& quantity, const Condition& at);

/// Compares methods at the last level of each block at which two of them can be, or where levels
/// are texts at each, by each quantity that has a direction. Where runs are not repeats of each
/// other nothing is compared.
std::vector<MethodComparison> compare_methods(const ResultsView& view);

/// Why a block's methods are not tested by a quantity: a clause; empty if they can be.
std::string why_not_compared(const ResultsView& view, const ResultsBlock& block,
                             const Quantity& quantity);

/// "Indoors, noise 0.4 m (no two methods have values in the same runs at noise 0.8 m)".
std::string where_of(const MethodComparison& comparison);

/// "EKF has the lowest error, 0.12 m (...)": what a comparison came to, in a sentence.
std::string sentence_of(const MethodComparison& comparison, const ResultsView& view);

/// "not compared, since values are missing: EKF"; empty if no method is left out.
std::string left_out_words(const MethodComparison& comparison);

/// See paired_methods.hpp.
std::string disagreement_of(const MethodComparison& comparison, const ResultsView& view);

/// As many comparisons open a report with a sentence each.
inline constexpr std::size_t kFewComparisons = 4;

/// "4 of 720 results have no value: 3 of EKF and 1 of Scan matching", the most first; empty if
/// nothing is lost.
std::string losses_of(const ResultsView& view);

/// Whether the best method by the quantity is named in the opening. How many poses could be
/// associated says how much of a path was judged, not how good it is.
bool is_crowned(const Quantity& quantity);

/// What to know first of all comparisons and of what was lost: each by a sentence while they are
/// few, else what they come to, quantity by quantity.
std::vector<std::string> headlines_of(const ResultsView& view,
                                      const std::vector<MethodComparison>& comparisons);

}  // namespace mapproof
