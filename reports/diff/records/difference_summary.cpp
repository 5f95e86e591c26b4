#include "reports/diff/records/difference_summary.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

/// The value below which a share of the ascending values lies, interpolated; NaN of none.
double quantile(const std::vector<double>& ascending, double share) {
  if (ascending.empty()) return kNaN;
  const double at = share * static_cast<double>(ascending.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, ascending.size() - 1);
  return std::lerp(ascending[low], ascending[high], at - static_cast<double>(low));
}

QuantityDifferences differences_of(const std::vector<const Comparison*>& comparisons) {
  QuantityDifferences found{.quantity = comparisons.front()->quantity};
  std::vector<double> ratios;
  const Better better = found.quantity.better;
  for (const Comparison* comparison : comparisons) {
    ++found.records;
    const double before = comparison->baseline_mean, after = comparison->current_mean;
    if (before > 0.0 && after > 0.0) ratios.push_back(after / before);
    if (better == Better::kNeither || before == after) continue;
    const bool rises = after > before;
    ++(rises == (better == Better::kLower) ? found.worse : found.better);
  }
  std::ranges::sort(ratios);
  found.low = quantile(ratios, 0.1);
  found.median = quantile(ratios, 0.5);
  found.high = quantile(ratios, 0.9);
  return found;
}

}  // namespace

std::vector<QuantityDifferences> difference_summary(const RecordDiff& diff) {
  std::vector<const Comparison*> beyond;
  for (const Comparison& comparison : diff.comparisons)
    if (verdict_of(comparison.outcome) > Verdict::kWithinTolerance) beyond.push_back(&comparison);
  std::ranges::stable_sort(beyond, {}, [](const Comparison* comparison) {
    return dictionary_rank(comparison->quantity);
  });
  std::vector<QuantityDifferences> summary;
  while (!beyond.empty()) {
    const std::string id = beyond.front()->quantity.id;
    const auto others = std::ranges::stable_partition(
        beyond, [&](const Comparison* comparison) { return comparison->quantity.id == id; });
    summary.push_back(differences_of({beyond.begin(), others.begin()}));
    beyond.erase(beyond.begin(), others.begin());
  }
  return summary;
}

std::string differences_text(const QuantityDifferences& differences) {
  std::string text =
      fmt::format("{}: {} {}", differences.quantity.label, counted(differences.records, "record"),
                  differences.records == 1 ? "differs" : "differ");
  if (differences.worse + differences.better > 0)
    text += fmt::format(", {} worse, {} better", differences.worse, differences.better);
  if (std::isfinite(differences.median))
    text += fmt::format("; current / baseline {:.3g} (10 to 90 % of them: {:.3g} to {:.3g})",
                        differences.median, differences.low, differences.high);
  return text;
}

}  // namespace mapproof
