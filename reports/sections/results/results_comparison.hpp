#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/statistics/friedman.hpp"
#include "core/statistics/paired_change.hpp"
#include "reports/sections/results/results_view.hpp"

namespace mapproof {

/// A method of a block compared with the best one.
struct ComparedMethod {
  std::size_t method = 0;              ///< Index into ResultsStudy::methods.
  double mean = 0.0;                   ///< Over the groups that all compared methods have.
  std::optional<PairedChange> change;  ///< From the best method, over groups; none of the best.
  double corrected_p = 1.0;            ///< Of the change, by Holm over the methods.
};

/// The methods of a block by one quantity under one condition, on the groups that all of them have.
struct MethodComparison {
  const ResultsBlock* block = nullptr;
  const Quantity* quantity = nullptr;
  Condition at;
  std::string level;                    ///< "noise 0.4 m"; empty: the block has one.
  std::vector<ComparedMethod> methods;  ///< The best first.
  std::vector<std::string> left_out;    ///< Labels of methods without a value in some group.
  int groups = 0;
  std::optional<FriedmanTest> ranks;  ///< In the order of `methods`; with two groups or more.
};

/// Compares methods at the last level of each block, by each quantity that has a direction; a group
/// counts by the mean of its runs. Where runs are no repeats of each other nothing is compared.
std::vector<MethodComparison> compare_methods(const ResultsView& view);

/// "EKF has the lowest error, 0.12 m (...)": what a comparison came to, in a sentence.
std::string sentence_of(const MethodComparison& comparison, const ResultsView& view);

}  // namespace mapproof
