#include "reports/sections/results/results_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "core/evaluate/evaluation_rows.hpp"
#include "core/statistics/nemenyi.hpp"
#include "core/statistics/signed_rank.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/method_ranks.hpp"
#include "reports/sections/results/results_conventions.hpp"
#include "reports/sections/wording.hpp"

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
  runs.reserve(methods.front().values.size());
  for (const auto& [run, value] : methods.front().values)
    if (std::ranges::all_of(methods, [&run = run](const MethodRuns& method) {
          return method.values.contains(run);
        }))
      runs.push_back(run);
  return runs;
}

/// Leaves the runs that all methods have.
void keep_common_runs(std::vector<MethodRuns>& methods) {
  const auto has_runs_of_first = [&](const MethodRuns& method) {
    return std::ranges::equal(method.values, methods.front().values, {},
                              &ValuesByRun::value_type::first, &ValuesByRun::value_type::first);
  };
  if (std::ranges::all_of(methods, has_runs_of_first)) return;
  const std::vector<Name> runs = common_runs(methods);
  for (MethodRuns& method : methods) method.values.keep(runs);
}

/// Different names, by their numbers: a bit per name of the process.
class NameSet {
 public:
  void insert(const Name& name) {
    if (name.id() >= is_in_.size()) is_in_.resize(name.id() + std::size_t{1});
    size_ += !is_in_[name.id()];
    is_in_[name.id()] = true;
  }
  std::size_t size() const { return size_; }

 private:
  std::vector<bool> is_in_;
  std::size_t size_ = 0;
};

/// Takes away the methods that would take groups, or half of the runs, from all others; none where
/// fewer than two would stay. @return Those taken away.
std::vector<std::size_t> leave_out(const ResultsView& view, std::vector<MethodRuns>& methods) {
  NameSet runs, groups;
  std::vector<std::size_t> groups_of;
  for (const MethodRuns& method : methods) {
    NameSet of_method;
    for (const auto& [run, value] : method.values) {
      const Name group = view.run_groups().find(run).value_or(run);
      runs.insert(run);
      of_method.insert(group);
      groups.insert(group);
    }
    groups_of.push_back(of_method.size());
  }
  std::vector<std::size_t> left_out;
  for (std::size_t i = 0; i < methods.size(); ++i)
    if (groups_of[i] != groups.size() || 2 * methods[i].values.size() < runs.size())
      left_out.push_back(methods[i].method);
  if (methods.size() < left_out.size() + 2) return {};
  std::erase_if(methods, [&](const MethodRuns& method) {
    return std::ranges::find(left_out, method.method) != left_out.end();
  });
  return left_out;
}

/// One method's values in the runs that all have.
struct MethodValues {
  std::size_t method;
  std::vector<double> values;
  double mean = 0.0;
};

/// The values without the runs' names.
MethodValues values_of(MethodRuns method) {
  MethodValues all{method.method, {}};
  all.values.reserve(method.values.size());
  double sum = 0.0;
  for (const auto& [run, value] : method.values) {
    all.values.push_back(value);
    sum += value;
  }
  all.mean = sum / static_cast<double>(all.values.size());
  return all;
}

std::vector<double> group_differences(const RunsByGroup& groups, const MethodValues& a,
                                      const MethodValues& b) {
  return groups.means([&](std::size_t run) { return a.values[run] - b.values[run]; });
}

/// @param methods  Whose values are let go one after the other.
FriedmanTest ranks_of(const RunsByGroup& groups, std::vector<MethodValues> methods,
                      bool lower_is_better) {
  Eigen::MatrixXd values(static_cast<Eigen::Index>(groups.groups()), std::ssize(methods));
  for (Eigen::Index j = 0; j < values.cols(); ++j) {
    const std::vector<double> of_runs =
        std::exchange(methods[static_cast<std::size_t>(j)].values, {});
    const std::vector<double> means = groups.means([&](std::size_t run) { return of_runs[run]; });
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      const double value = means[static_cast<std::size_t>(i)];
      values(i, j) = lower_is_better ? value : -value;
    }
  }
  return friedman(std::move(values));
}

}  // namespace

std::optional<MethodComparison> compare_at(const ResultsView& view, const ResultsBlock& block,
                                           const Quantity& quantity, const Condition& at) {
  std::vector<MethodRuns> by_run = methods_at(view, block, quantity, at);
  if (by_run.size() < 2) return std::nullopt;
  MethodComparison comparison;
  comparison.block = &block;
  comparison.quantity = &quantity;
  comparison.at = at;
  for (const std::size_t method : leave_out(view, by_run))
    comparison.left_out.push_back(view.study().methods[method].label);
  std::vector<std::size_t> all_runs;
  for (const MethodRuns& method : by_run) all_runs.push_back(method.values.size());
  keep_common_runs(by_run);
  const std::size_t runs = by_run.front().values.size();
  if (runs == 0) return std::nullopt;
  comparison.has_all_runs = std::ranges::all_of(all_runs, [&](std::size_t n) { return n == runs; });
  const RunsByGroup groups(by_run.front().values, view.run_groups());
  comparison.runs = static_cast<int>(runs);
  comparison.groups = static_cast<int>(groups.groups());
  std::vector<MethodValues> methods;
  for (MethodRuns& method : by_run) methods.push_back(values_of(std::move(method)));

  const bool lower = quantity.better == Better::kLower;
  std::ranges::stable_sort(methods, [&](const MethodValues& a, const MethodValues& b) {
    return lower ? a.mean < b.mean : a.mean > b.mean;
  });
  std::vector<double> p;
  for (const MethodValues& method : methods) {
    comparison.methods.push_back(
        {.method = method.method, .mean = method.mean, .change = std::nullopt});
    if (&method == &methods.front() || !has_groups_for_tests(comparison)) continue;
    comparison.methods.back().change =
        paired_change(group_differences(groups, method, methods.front()));
    p.push_back(comparison.methods.back().change->p);
  }
  const std::vector<double> corrected = holm(p);
  for (std::size_t i = 0; i < corrected.size(); ++i)
    comparison.methods[i + 1].corrected_p = corrected[i];
  if (has_groups_for_tests(comparison))
    comparison.ranks = ranks_of(groups, std::move(methods), lower);
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

/// Whether mean ranks tell a method from the best one.
bool is_apart_by_ranks(const MethodComparison& comparison, std::size_t i) {
  const std::vector<double>& ranks = comparison.ranks->mean_ranks;
  return std::abs(ranks[i] - ranks[0]) >= critical_difference(comparison);
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

bool has_groups_for_tests(const MethodComparison& comparison) {
  return std::cmp_greater_equal(comparison.groups, kFewestGroups);
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
    return value_words(mean, quantity.unit, view.has_great_errors(quantity));
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
  text +=
      fmt::format(" ({}, {} over {}",
                  is_significant(next) ? "a significant difference" : "no significant difference",
                  p_words(next.corrected_p), counted(comparison.groups, "group"));
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
