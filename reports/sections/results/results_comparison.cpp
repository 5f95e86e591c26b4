#include "reports/sections/results/results_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "core/statistics/nemenyi.hpp"
#include "core/statistics/signed_rank.hpp"
#include "render/figures/number_text.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/method_ranks.hpp"

namespace mapproof {
namespace {

/// More methods than these have no legend that a reader could follow.
constexpr std::size_t kMostRanked = 30;

/// One method's value in each run.
struct MethodRuns {
  std::size_t method;
  ValuesByRun values;
};

std::vector<MethodRuns> methods_at(const ResultsView& view, const ResultsBlock& block,
                                   const Quantity& quantity, const Condition& at) {
  std::vector<MethodRuns> all;
  for (const ResultsLine& line : view.lines(block, quantity))
    if (ValuesByRun values = view.numbers(at, line, quantity).values; !values.empty())
      all.push_back({line.index, std::move(values)});
  return all;
}

/// The runs that all of them have, ascending.
std::vector<Name> common_runs(const std::vector<MethodRuns>& methods) {
  std::vector<Name> runs;
  for (const auto& [run, value] : methods.front().values)
    if (std::ranges::all_of(methods, [&run = run](const MethodRuns& method) {
          return method.values.contains(run);
        }))
      runs.push_back(run);
  return runs;
}

/// Takes away the methods that would take groups, or half of the runs, from all others; none where
/// fewer than two would stay. @return Those taken away.
std::vector<std::size_t> leave_out(const ResultsView& view, std::vector<MethodRuns>& methods) {
  ValuesByRun all;
  for (const MethodRuns& method : methods) all.merge(method.values);
  const std::size_t groups = view.group_means(all).size();
  const auto stays = [&](const MethodRuns& method) {
    return view.group_means(method.values).size() == groups &&
           2 * method.values.size() >= all.size();
  };
  std::vector<std::size_t> left_out;
  for (const MethodRuns& method : methods)
    if (!stays(method)) left_out.push_back(method.method);
  if (methods.size() < left_out.size() + 2) return {};
  std::erase_if(methods, [&](const MethodRuns& method) {
    return std::ranges::find(left_out, method.method) != left_out.end();
  });
  return left_out;
}

double mean_of(const ValuesByRun& values) {
  double sum = 0.0;
  for (const auto& [run, value] : values) sum += value;
  return sum / static_cast<double>(values.size());
}

std::vector<double> group_differences(const ResultsView& view, const MethodRuns& a,
                                      const MethodRuns& b) {
  ValuesByRun differences;
  differences.reserve(a.values.size());
  for (const auto& [run, value] : a.values) differences[run] = value - *b.values.find(run);
  std::vector<double> all;
  for (const auto& [group, value] : view.group_means(differences)) all.push_back(value);
  return all;
}

FriedmanTest ranks_of(const ResultsView& view, const std::vector<MethodRuns>& methods, int groups,
                      bool lower_is_better) {
  Eigen::MatrixXd values(groups, std::ssize(methods));
  for (Eigen::Index j = 0; j < values.cols(); ++j) {
    Eigen::Index i = 0;
    for (const auto& [group, value] : view.group_means(methods[static_cast<std::size_t>(j)].values))
      values(i++, j) = lower_is_better ? value : -value;
  }
  return friedman(values);
}

/// Compares at one condition; empty where no two methods have a run in common.
std::optional<MethodComparison> compare_at(const ResultsView& view, const ResultsBlock& block,
                                           const Quantity& quantity, const Condition& at) {
  std::vector<MethodRuns> methods = methods_at(view, block, quantity, at);
  if (methods.size() < 2) return std::nullopt;
  MethodComparison comparison;
  comparison.block = &block;
  comparison.quantity = &quantity;
  comparison.at = at;
  for (const std::size_t method : leave_out(view, methods))
    comparison.left_out.push_back(view.study().methods[method].label);
  const std::vector<Name> runs = common_runs(methods);
  if (runs.empty()) return std::nullopt;
  for (MethodRuns& method : methods) {
    comparison.has_all_runs &= method.values.size() == runs.size();
    method.values.keep(runs);
  }
  comparison.runs = static_cast<int>(runs.size());
  comparison.groups = static_cast<int>(view.group_means(methods.front().values).size());

  const bool lower = quantity.better == Better::kLower;
  std::ranges::stable_sort(methods, [&](const MethodRuns& a, const MethodRuns& b) {
    return lower ? mean_of(a.values) < mean_of(b.values) : mean_of(a.values) > mean_of(b.values);
  });
  std::vector<double> p;
  for (const MethodRuns& method : methods) {
    comparison.methods.push_back(
        {.method = method.method, .mean = mean_of(method.values), .change = std::nullopt});
    if (&method == &methods.front() || comparison.groups < 2) continue;
    comparison.methods.back().change =
        paired_change(group_differences(view, method, methods.front()));
    p.push_back(comparison.methods.back().change->p);
  }
  const std::vector<double> corrected = holm(p);
  for (std::size_t i = 0; i < corrected.size(); ++i)
    comparison.methods[i + 1].corrected_p = corrected[i];
  if (comparison.groups > 1) comparison.ranks = ranks_of(view, methods, comparison.groups, lower);
  return comparison;
}

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

std::string value_words(double value, const Quantity& quantity, const ResultsView& view) {
  if (view.has_great_errors(quantity) && value > kGreatestError_m) return kGreatErrorText;
  const std::string digits = fmt::format("{:.3g}", value);
  const bool has_power = digits.find('e') != std::string::npos;
  return with_unit(has_power ? significant(value) : digits, quantity.unit);
}

std::string label_of(const ComparedMethod& method, const ResultsView& view) {
  return view.study().methods[method.method].label;
}

const char* best_word(const Quantity& quantity) {
  return quantity.better == Better::kLower ? "lowest" : "highest";
}

/// Whether mean ranks tell a method from the best one.
bool is_apart_by_ranks(const MethodComparison& comparison, std::size_t i) {
  const std::vector<double>& ranks = comparison.ranks->mean_ranks;
  return std::abs(ranks[i] - ranks[0]) >= critical_difference(comparison);
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
  for (const auto& [count, label] : lost) names.push_back(fmt::format("{} {}", label, count));
  return fmt::format("{} of {} results have no value: {}.", all, view.study().results.rows.size(),
                     listed(names, kMostNamed));
}

bool is_significant(const ComparedMethod& method) {
  return method.change && method.corrected_p < kSignificanceOfMethods;
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

std::string where_of(const MethodComparison& comparison) {
  std::string text = comparison.block->title;
  if (!comparison.level.empty()) text += ", " + comparison.level;
  if (comparison.passed_over.empty()) return text;
  constexpr std::size_t kMostNamed = 3;
  return text +
         fmt::format(" (nothing to compare at {})", listed(comparison.passed_over, kMostNamed));
}

std::string sentence_of(const MethodComparison& comparison, const ResultsView& view) {
  const Quantity& quantity = *comparison.quantity;
  const ComparedMethod &best = comparison.methods[0], &next = comparison.methods[1];
  std::string text = fmt::format("{}: {} has the {} mean {}, {}; {} follows with {}",
                                 where_of(comparison), label_of(best, view), best_word(quantity),
                                 quantity.label, value_words(best.mean, quantity, view),
                                 label_of(next, view), value_words(next.mean, quantity, view));
  if (!comparison.has_all_runs)
    text += fmt::format(", over the {} that all of these methods have",
                        counted(comparison.runs, "run"));
  if (!next.change) return text + ".";
  text +=
      fmt::format(" ({}, {} over {}",
                  is_significant(next) ? "a significant difference" : "no significant difference",
                  p_words(next.corrected_p), counted(comparison.groups, "group"));
  if (has_rank_diagram(comparison) && is_apart_by_ranks(comparison, 1) != is_significant(next))
    text +=
        fmt::format("; their mean ranks {}",
                    is_significant(next) ? "do not differ significantly" : "differ significantly");
  return text + ").";
}

bool has_rank_diagram(const MethodComparison& comparison) {
  return comparison.ranks && comparison.methods.size() > 2 &&
         comparison.methods.size() <= kMostRanked;
}

double critical_difference(const MethodComparison& comparison) {
  if (!comparison.ranks) throw InvalidInput("a comparison without ranks");
  return nemenyi_critical_difference(comparison.ranks->methods, comparison.ranks->units,
                                     kSignificanceOfMethods);
}

std::string disagreement_of(const MethodComparison& comparison, const ResultsView& view) {
  if (!has_rank_diagram(comparison)) return "";
  std::vector<std::string> by_pairs, by_ranks;
  for (std::size_t i = 1; i < comparison.methods.size(); ++i) {
    const bool paired = is_significant(comparison.methods[i]);
    if (paired != is_apart_by_ranks(comparison, i))
      (paired ? by_pairs : by_ranks).push_back(label_of(comparison.methods[i], view));
  }
  if (by_pairs.empty() && by_ranks.empty()) return "";
  constexpr std::size_t kMostNamed = 5;
  const std::string best = label_of(comparison.methods[0], view);
  std::string text;
  if (!by_pairs.empty())
    text = fmt::format("The paired test distinguishes {} from {}, mean ranks do not. ",
                       listed(by_pairs, kMostNamed), best);
  if (!by_ranks.empty())
    text += fmt::format("Mean ranks distinguish {} from {}, the paired test does not. ",
                        listed(by_ranks, kMostNamed), best);
  return text +
         "Both can be: the paired test weighs how large the differences are and is corrected for "
         "the comparisons with the best method; mean ranks (Nemenyi) see the order within each "
         "group alone and are corrected for all pairs of methods.";
}

std::vector<std::string> headlines_of(const ResultsView& view,
                                      const std::vector<MethodComparison>& comparisons) {
  std::vector<std::string> headlines;
  if (comparisons.size() <= kFewComparisons) {
    for (const MethodComparison& comparison : comparisons)
      headlines.push_back(sentence_of(comparison, view));
  } else {
    for (const std::string& id : view.study().quantities) {
      std::vector<const MethodComparison*> of_quantity;
      for (const MethodComparison& comparison : comparisons)
        if (comparison.quantity->id == id) of_quantity.push_back(&comparison);
      if (of_quantity.size() == 1) headlines.push_back(sentence_of(*of_quantity.front(), view));
      if (of_quantity.size() > 1)
        headlines.push_back(tally_of(view, *of_quantity.front()->quantity, of_quantity));
    }
  }
  return headlines;
}

}  // namespace mapproof
