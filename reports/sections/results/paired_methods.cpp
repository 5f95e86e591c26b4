#include "reports/sections/results/paired_methods.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Core>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/statistics/nemenyi.hpp"
#include "core/statistics/signed_rank.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

/// More methods than these have no legend that a reader could follow.
constexpr std::size_t kMostRanked = 30;

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
std::vector<std::size_t> leave_out(const GroupsByRun& run_groups,
                                   std::vector<MethodRuns>& methods) {
  NameSet runs, groups;
  std::vector<std::size_t> groups_of;
  for (const MethodRuns& method : methods) {
    NameSet of_method;
    for (const auto& [run, value] : method.values) {
      const Name group = run_groups.find(run).value_or(run);
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

std::optional<PairedMethods> compare_runs(std::vector<MethodRuns> by_run, const GroupsByRun& groups,
                                          bool lower_is_better) {
  if (by_run.size() < 2) return std::nullopt;
  PairedMethods comparison;
  comparison.not_compared = leave_out(groups, by_run);
  std::vector<std::size_t> all_runs;
  for (const MethodRuns& method : by_run) all_runs.push_back(method.values.size());
  keep_common_runs(by_run);
  const std::size_t runs = by_run.front().values.size();
  if (runs == 0) return std::nullopt;
  comparison.has_all_runs = std::ranges::all_of(all_runs, [&](std::size_t n) { return n == runs; });
  const RunsByGroup by_group(by_run.front().values, groups);
  comparison.runs = static_cast<int>(runs);
  comparison.groups = static_cast<int>(by_group.groups());
  std::vector<MethodValues> methods;
  for (MethodRuns& method : by_run) methods.push_back(values_of(std::move(method)));

  std::ranges::stable_sort(methods, [&](const MethodValues& a, const MethodValues& b) {
    return lower_is_better ? a.mean < b.mean : a.mean > b.mean;
  });
  std::vector<double> p;
  for (const MethodValues& method : methods) {
    comparison.methods.push_back(
        {.method = method.method, .mean = method.mean, .change = std::nullopt});
    if (&method == &methods.front() || !has_groups_for_tests(comparison)) continue;
    comparison.methods.back().change =
        paired_change(group_differences(by_group, method, methods.front()));
    p.push_back(comparison.methods.back().change->p);
  }
  const std::vector<double> corrected = holm(p);
  for (std::size_t i = 0; i < corrected.size(); ++i)
    comparison.methods[i + 1].corrected_p = corrected[i];
  if (has_groups_for_tests(comparison))
    comparison.ranks = ranks_of(by_group, std::move(methods), lower_is_better);
  return comparison;
}

bool has_groups_for_tests(const PairedMethods& comparison) {
  return std::cmp_greater_equal(comparison.groups, kFewestGroups);
}

bool is_significant(const ComparedMethod& method) {
  return method.change && method.corrected_p < kSignificanceOfMethods;
}

PairedWithBest judgement_of(const PairedMethods& comparison, std::size_t method) {
  const auto found = std::ranges::find(comparison.methods, method, &ComparedMethod::method);
  if (found == comparison.methods.end() || !has_groups_for_tests(comparison))
    return PairedWithBest::kUntested;
  if (found == comparison.methods.begin()) return PairedWithBest::kBest;
  return is_significant(*found) ? PairedWithBest::kWorse : PairedWithBest::kAlike;
}

std::string difference_words(const PairedMethods& comparison, const std::string& group) {
  const ComparedMethod& next = comparison.methods[1];
  if (!next.change) throw InvalidInput("a comparison without tests");
  return fmt::format(
      "{}, {} over {}",
      is_significant(next) ? "a significant difference" : "no significant difference",
      p_words(next.corrected_p), counted(comparison.groups, group));
}

bool has_rank_diagram(const PairedMethods& comparison) {
  return comparison.ranks && comparison.methods.size() > 2 &&
         comparison.methods.size() <= kMostRanked;
}

double critical_difference(const PairedMethods& comparison) {
  if (!comparison.ranks) throw InvalidInput("a comparison without ranks");
  return nemenyi_critical_difference(comparison.ranks->methods, comparison.ranks->units,
                                     kSignificanceOfMethods);
}

bool is_apart_by_ranks(const PairedMethods& comparison, std::size_t i) {
  const std::vector<double>& ranks = comparison.ranks->mean_ranks;
  return std::abs(ranks[i] - ranks[0]) >= critical_difference(comparison);
}

std::string disagreement_of(const PairedMethods& comparison,
                            const std::function<std::string(std::size_t)>& label_of,
                            const std::string& group) {
  if (!has_rank_diagram(comparison)) return "";
  std::vector<std::string> by_pairs, by_ranks;
  for (std::size_t i = 1; i < comparison.methods.size(); ++i) {
    const bool paired = is_significant(comparison.methods[i]);
    if (paired != is_apart_by_ranks(comparison, i))
      (paired ? by_pairs : by_ranks).push_back(label_of(comparison.methods[i].method));
  }
  if (by_pairs.empty() && by_ranks.empty()) return "";
  constexpr std::size_t kMostNamed = 5;
  const std::string best = label_of(comparison.methods[0].method);
  std::string text;
  if (!by_pairs.empty())
    text = fmt::format("The paired test distinguishes {} from {}, mean ranks do not. ",
                       listed(by_pairs, kMostNamed), best);
  if (!by_ranks.empty())
    text += fmt::format("Mean ranks distinguish {} from {}, the paired test does not. ",
                        listed(by_ranks, kMostNamed), best);
  return text +
         fmt::format(
             "Both can be: the paired test weighs how large the differences are and is corrected "
             "for the comparisons with the best method; mean ranks (Nemenyi) see the order within "
             "each {} alone and are corrected for all pairs of methods.",
             group);
}

}  // namespace mapproof
