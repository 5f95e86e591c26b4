#include "reports/sections/results/results_comparison.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "core/evaluate/evaluation_rows.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/results/results_conventions.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

std::vector<MethodRuns> methods_at(const ResultsView& view, const ResultsBlock& block,
                                   const Quantity& quantity, const Condition& at) {
  std::vector<MethodRuns> all;
  for (const ResultsLine& line : view.lines(block, quantity))
    if (ValuesByRun values = view.numbers(at, line, quantity).values; !values.empty())
      all.push_back({line.index, std::move(values)});
  return all;
}

}  // namespace

std::optional<MethodComparison> compare_at(const ResultsView& view, const ResultsBlock& block,
                                           const Quantity& quantity, const Condition& at) {
  auto compared = compare_runs(methods_at(view, block, quantity, at), view.run_groups(),
                               quantity.better == Better::kLower);
  if (!compared) return std::nullopt;
  MethodComparison comparison{*std::move(compared)};
  comparison.block = &block;
  comparison.quantity = &quantity;
  comparison.at = at;
  for (const std::size_t method : comparison.not_compared)
    comparison.left_out.push_back(view.study().methods[method].label);
  return comparison;
}

namespace {

/// At each level: texts have no last one.
std::vector<MethodComparison> compare_at_all(const ResultsView& view, const ResultsBlock& block,
                                             const Quantity& quantity) {
  std::vector<MethodComparison> comparisons;
  std::set<std::string> ids;
  for (std::size_t i = 0; i < block.conditions.size(); ++i) {
    std::string id = block.id + "-" + level_slug(block.levels[i]);
    if (id.back() == '-' || !ids.insert(id).second) id += fmt::format("-level-{}", i + 1);
    auto comparison = compare_at(view, block, quantity, block.conditions[i]);
    if (!comparison) continue;
    comparison->id = std::move(id);
    comparison->level = view.level_words(block.levels[i]);
    comparisons.push_back(*std::move(comparison));
  }
  return comparisons;
}

/// At the last level where that can be.
std::vector<MethodComparison> compare_at_last(const ResultsView& view, const ResultsBlock& block,
                                              const Quantity& quantity) {
  std::vector<std::string> passed_over;
  for (std::size_t i = block.conditions.size(); i-- > 0;) {
    const std::string level = block.factor.empty() ? "" : view.level_words(block.levels[i]);
    if (auto comparison = compare_at(view, block, quantity, block.conditions[i])) {
      comparison->id = block.id;
      comparison->level = level;
      comparison->passed_over.assign(passed_over.rbegin(), passed_over.rend());
      return {*std::move(comparison)};
    }
    passed_over.push_back(level);
  }
  return {};
}

std::string label_of(const ComparedMethod& method, const ResultsView& view) {
  return view.study().methods[method.method].label;
}

const char* best_word(const Quantity& quantity) {
  return quantity.better == Better::kLower ? "lowest" : "highest";
}

/// Labels of methods that some of the comparisons left out, each once.
std::vector<std::string> left_out_of(const std::vector<const MethodComparison*>& comparisons) {
  std::vector<std::string> labels;
  for (const MethodComparison* comparison : comparisons)
    for (const std::string& label : comparison->left_out)
      if (std::ranges::find(labels, label) == labels.end()) labels.push_back(label);
  return labels;
}

/// How often each method is the best by one quantity, and which are worse everywhere.
std::string tally_of(const ResultsView& view, const Quantity& quantity,
                     const std::vector<const MethodComparison*>& comparisons) {
  std::map<std::size_t, std::pair<int, int>> best;      // By method: how often, and clearly.
  std::map<std::size_t, std::pair<int, int>> compared;  // How often, and significantly worse.
  for (const MethodComparison* comparison : comparisons) {
    auto& [wins, clear] = best[comparison->methods[0].method];
    ++wins;
    clear += is_significant(comparison->methods[1]);
    for (const ComparedMethod& method : comparison->methods) {
      auto& [times, worse] = compared[method.method];
      ++times;
      worse += is_significant(method);
    }
  }
  std::vector<std::pair<std::size_t, std::pair<int, int>>> order(best.begin(), best.end());
  std::ranges::stable_sort(order, std::greater(),
                           [](const auto& entry) { return entry.second.first; });
  std::vector<std::string> names;
  for (const auto& [method, wins] : order)
    names.push_back(
        fmt::format("{} in {}{}", view.study().methods[method].label, wins.first,
                    wins.second == 0 ? "" : fmt::format(" ({} significantly)", wins.second)));
  constexpr std::size_t kMostNamed = 4;
  std::string text = fmt::format("{}: of {} compared, the {} mean is that of {}", quantity.label,
                                 counted(std::ssize(comparisons), "condition"), best_word(quantity),
                                 listed(names, kMostNamed));
  std::vector<std::string> worse;
  for (const auto& [method, times] : compared)
    if (times.first == times.second) worse.push_back(view.study().methods[method].label);
  if (!worse.empty())
    text += fmt::format("; significantly worse than the best wherever compared: {}",
                        listed(worse, kMostNamed));
  if (const auto left_out = left_out_of(comparisons); !left_out.empty())
    text +=
        fmt::format("; not compared wherever values are missing: {}", listed(left_out, kMostNamed));
  return text + ".";
}

}  // namespace

std::string losses_of(const ResultsView& view) {
  std::map<Name, long> of_methods;
  for (const Result& row : view.study().results.rows)
    if (is_lost(row.value)) ++of_methods[row.method];
  std::vector<std::pair<long, std::string>> lost;
  long all = 0;
  for (const Label& method : view.study().methods) {
    const auto count = of_methods.find(method.id);
    if (count == of_methods.end()) continue;
    lost.emplace_back(count->second, method.label);
    all += count->second;
  }
  if (all == 0) return "";
  std::ranges::stable_sort(lost, std::greater(), &decltype(lost)::value_type::first);
  constexpr std::size_t kMostNamed = 4;
  std::vector<std::string> names;
  for (const auto& [count, label] : lost)
    names.push_back(fmt::format("{} of {}", count_text(count), bracketed(label)));
  return fmt::format("{} {} no value: {}",
                     part_text(all, std::ssize(view.study().results.rows), "result"),
                     all == 1 ? "has" : "have", listed(names, kMostNamed));
}

std::vector<MethodComparison> compare_methods(const ResultsView& view) {
  std::vector<MethodComparison> comparisons;
  if (!view.study().results.are_repeats) return comparisons;
  for (const ResultsBlock& block : view.blocks())
    for (const Quantity* quantity : view.quantities(block))
      if (quantity->better != Better::kNeither)
        std::ranges::move(block.factor.empty() || block.has_axis()
                              ? compare_at_last(view, block, *quantity)
                              : compare_at_all(view, block, *quantity),
                          std::back_inserter(comparisons));
  return comparisons;
}

std::string why_not_compared(const ResultsView& view, const ResultsBlock& block,
                             const Quantity& quantity) {
  int most = 0;
  for (const Condition& at : block.conditions) {
    const auto comparison = compare_at(view, block, quantity, at);
    if (!comparison) continue;
    if (has_groups_for_tests(*comparison)) return "";
    most = std::max(most, comparison->groups);
  }
  if (most == 0) return "no two have values in the same runs";
  return most == 1 ? "one group of runs shows nothing about chance"
                   : fmt::format("{} of runs are too few for a test", counted(most, "group"));
}

std::string where_of(const MethodComparison& comparison) {
  std::string text = comparison.block->title;
  if (!comparison.level.empty()) text += ", " + comparison.level;
  if (comparison.passed_over.empty()) return text;
  constexpr std::size_t kMostNamed = 3;
  return text + fmt::format(" (no two methods have values in the same runs at {}{})",
                            listed(comparison.passed_over, kMostNamed),
                            comparison.passed_over.size() > kMostNamed ? " levels" : "");
}

std::string sentence_of(const MethodComparison& comparison, const ResultsView& view) {
  const Quantity& quantity = *comparison.quantity;
  const ComparedMethod &best = comparison.methods[0], &next = comparison.methods[1];
  const auto words = [&](double mean) {
    return lone_value(mean, quantity, view.has_great_errors(quantity));
  };
  std::string text =
      fmt::format("{}: {} has the {} {}{}, {}; {} follows with {}", where_of(comparison),
                  label_of(best, view), best_word(quantity), view.runs() > 1 ? "mean " : "",
                  quantity.label, words(best.mean), label_of(next, view), words(next.mean));
  if (!comparison.has_all_runs)
    text += fmt::format(", over the {} that all of these methods have",
                        counted(comparison.runs, "run"));
  const std::string left_out = left_out_words(comparison);
  const std::string end = left_out.empty() ? "." : "; " + left_out + ".";
  if (!next.change)
    return text +
           (comparison.groups > 1
                ? "; too few runs to test the difference, in " + counted(comparison.groups, "group")
                : "") +
           end;
  text += " (" + difference_words(comparison, "group");
  if (has_rank_diagram(comparison) && is_apart_by_ranks(comparison, 1) != is_significant(next))
    text +=
        fmt::format("; their mean ranks {}",
                    is_significant(next) ? "do not differ significantly" : "differ significantly");
  return text + ")" + end;
}

std::string left_out_words(const MethodComparison& comparison) {
  constexpr std::size_t kMostNamed = 3;
  return comparison.left_out.empty() ? ""
                                     : fmt::format("not compared, since values are missing: {}",
                                                   listed(comparison.left_out, kMostNamed));
}

std::string disagreement_of(const MethodComparison& comparison, const ResultsView& view) {
  return disagreement_of(
      comparison, [&](std::size_t method) { return view.study().methods[method].label; }, "group");
}

bool is_crowned(const Quantity& quantity) { return quantity.id != kAssociatedPercent; }

std::vector<std::string> headlines_of(const ResultsView& view,
                                      const std::vector<MethodComparison>& comparisons) {
  std::vector<std::string> headlines;
  if (comparisons.size() <= kFewComparisons) {
    for (const MethodComparison& comparison : comparisons)
      if (is_crowned(*comparison.quantity)) headlines.push_back(sentence_of(comparison, view));
  } else {
    for (const std::string& id : view.study().quantities) {
      std::vector<const MethodComparison*> of_quantity;
      for (const MethodComparison& comparison : comparisons)
        if (comparison.quantity->id == id && is_crowned(*comparison.quantity))
          of_quantity.push_back(&comparison);
      if (of_quantity.size() == 1) headlines.push_back(sentence_of(*of_quantity.front(), view));
      if (of_quantity.size() > 1)
        headlines.push_back(tally_of(view, *of_quantity.front()->quantity, of_quantity));
    }
  }
  return headlines;
}

}  // namespace mapproof
