#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/results/values_by_run.hpp"
#include "core/statistics/friedman.hpp"
#include "core/statistics/paired_change.hpp"
#include "render/figures/curves/error_lines.hpp"

namespace mapproof {

/// The one judgement of methods, in titles, sentences and tables of all studies: the paired test
/// with the best method over the runs that all have, corrected for the number of methods.

/// The level of significance of comparisons of methods: of their ranks and paired differences.
inline constexpr double kSignificanceOfMethods = 0.05;

/// An interval of a mean over fewer groups of runs is a guess, and nothing is tested.
inline constexpr std::size_t kFewestGroups = 5;

/// One method's value in each run.
struct MethodRuns {
  std::size_t method = 0;  ///< A number that the caller knows it by.
  ValuesByRun values;
};

/// A method compared with the best one.
struct ComparedMethod {
  std::size_t method = 0;  ///< See MethodRuns.
  double mean = 0.0;       ///< Over the runs that all compared methods have.
  /// From the best method, over groups; none of the best, and of too few groups for tests.
  std::optional<PairedChange> change;
  double corrected_p = 1.0;  ///< Of the change, by Holm over the methods.
};

/// Methods on the runs that all of them have.
struct PairedMethods {
  std::vector<ComparedMethod> methods;    ///< The best first; two or more.
  std::vector<std::size_t> not_compared;  ///< Those that lack a group, or half of the runs.
  int runs = 0;                           ///< That all compared methods have.
  int groups = 0;
  bool has_all_runs = true;  ///< None of the methods has another run: means are the tables'.
  std::optional<FriedmanTest> ranks;  ///< In the order of `methods`; with groups for tests.
};

/// Compares methods. Pairs are of the runs that all compared methods have; a group counts by the
/// mean of its pairs.
/// @param methods  Without those that have no value; their values are let go.
/// @return Empty where no two methods have a run in common.
std::optional<PairedMethods> compare_runs(std::vector<MethodRuns> methods,
                                          const GroupsByRun& groups, bool lower_is_better);

/// Whether it has as many groups of runs as an interval needs: of fewer nothing is tested.
bool has_groups_for_tests(const PairedMethods& comparison);

/// Whether the corrected paired test tells a method from the best one.
bool is_significant(const ComparedMethod& method);

/// How a title judges a method; untested without groups for tests, and if it was not compared.
PairedWithBest judgement_of(const PairedMethods& comparison, std::size_t method);

/// "no significant difference, p = 0.12 over 8 groups": of the second one from the best.
/// @param group  What a group is, "layout".
/// @throws InvalidInput if it was not tested.
std::string difference_words(const PairedMethods& comparison, const std::string& group);

/// Whether there is a diagram of its mean ranks.
bool has_rank_diagram(const PairedMethods& comparison);

/// The least difference of mean ranks that tells two methods apart, Nemenyi's at 0.05.
/// @throws InvalidInput without ranks.
double critical_difference(const PairedMethods& comparison);

/// Whether mean ranks tell the i-th of `methods` from the best one.
bool is_apart_by_ranks(const PairedMethods& comparison, std::size_t i);

/// Which methods one of paired test and diagram of mean ranks tells from the best one and the other
/// does not, and why that can be; empty where they agree.
/// @param label_of  Of a method, see MethodRuns.
/// @param group     What a group is, "layout".
std::string disagreement_of(const PairedMethods& comparison,
                            const std::function<std::string(std::size_t)>& label_of,
                            const std::string& group);

}  // namespace mapproof
