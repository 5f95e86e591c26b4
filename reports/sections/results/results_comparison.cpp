#include "reports/sections/results/results_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "core/statistics/signed_rank.hpp"

namespace mapproof {
namespace {

constexpr double kAlpha = 0.05;

/// One method's mean in each group.
struct GroupMeans {
  std::size_t method;
  std::map<std::string, double> means;
};

std::vector<GroupMeans> group_means_of(const ResultsView& view, const ResultsBlock& block,
                                       const Quantity& quantity, const Condition& at) {
  std::vector<GroupMeans> all;
  for (const ResultsLine& line : view.lines(block, quantity))
    all.push_back({line.index, view.group_means(view.numbers(at, line, quantity).values)});
  return all;
}

double mean_of(const std::map<std::string, double>& means) {
  double sum = 0.0;
  for (const auto& [group, value] : means) sum += value;
  return sum / static_cast<double>(means.size());
}

std::vector<double> differences(const GroupMeans& a, const GroupMeans& b) {
  std::vector<double> all;
  for (const auto& [group, value] : a.means) all.push_back(value - b.means.at(group));
  return all;
}

FriedmanTest ranks_of(const std::vector<GroupMeans>& methods, bool lower_is_better) {
  Eigen::MatrixXd values(std::ssize(methods.front().means), std::ssize(methods));
  for (Eigen::Index j = 0; j < values.cols(); ++j) {
    Eigen::Index i = 0;
    for (const auto& [group, value] : methods[static_cast<std::size_t>(j)].means)
      values(i++, j) = lower_is_better ? value : -value;
  }
  return friedman(values);
}

std::optional<MethodComparison> compare(const ResultsView& view, const ResultsBlock& block,
                                        const Quantity& quantity) {
  MethodComparison comparison;
  comparison.block = &block;
  comparison.quantity = &quantity;
  comparison.at = block.conditions.back();
  if (!block.factor.empty()) comparison.level = view.level_words(block.levels.back());
  std::vector<GroupMeans> methods = group_means_of(view, block, quantity, comparison.at);

  // A method that lacks a group would take that group from all others.
  std::set<std::string> groups;
  for (const GroupMeans& method : methods)
    for (const auto& [group, value] : method.means) groups.insert(group);
  std::erase_if(methods, [&](const GroupMeans& method) {
    if (method.means.size() == groups.size()) return false;
    comparison.left_out.push_back(view.study().methods[method.method].label);
    return true;
  });
  if (methods.size() < 2) return std::nullopt;

  const bool lower = quantity.better == Better::kLower;
  std::ranges::stable_sort(methods, [&](const GroupMeans& a, const GroupMeans& b) {
    return lower ? mean_of(a.means) < mean_of(b.means) : mean_of(a.means) > mean_of(b.means);
  });
  comparison.groups = static_cast<int>(groups.size());
  std::vector<double> p;
  for (const GroupMeans& method : methods) {
    comparison.methods.push_back(
        {.method = method.method, .mean = mean_of(method.means), .change = std::nullopt});
    if (&method == &methods.front() || groups.size() < 2) continue;
    comparison.methods.back().change = paired_change(differences(method, methods.front()));
    p.push_back(comparison.methods.back().change->p);
  }
  const std::vector<double> corrected = holm(p);
  for (std::size_t i = 0; i < corrected.size(); ++i)
    comparison.methods[i + 1].corrected_p = corrected[i];
  if (groups.size() > 1) comparison.ranks = ranks_of(methods, lower);
  return comparison;
}

std::string with_unit(double value, const Quantity& quantity) {
  return fmt::format("{:.3g}{}{}", value, quantity.unit.empty() ? "" : " ", quantity.unit);
}

std::string p_words(double p) { return p < 1e-3 ? "p < 0.001" : fmt::format("p = {:.2g}", p); }

}  // namespace

std::vector<MethodComparison> compare_methods(const ResultsView& view) {
  std::vector<MethodComparison> comparisons;
  if (!view.study().results.are_repeats) return comparisons;
  for (const ResultsBlock& block : view.blocks())
    for (const Quantity* quantity : view.quantities(block))
      if (quantity->better != Better::kNeither)
        if (auto comparison = compare(view, block, *quantity))
          comparisons.push_back(*std::move(comparison));
  return comparisons;
}

std::string sentence_of(const MethodComparison& comparison, const ResultsView& view) {
  const Quantity& quantity = *comparison.quantity;
  const auto label = [&](const ComparedMethod& method) {
    return view.study().methods[method.method].label;
  };
  const ComparedMethod &best = comparison.methods[0], &next = comparison.methods[1];
  std::string text =
      fmt::format("{}{}{}: {} has the {} mean {}, {}; {} follows with {}", comparison.block->title,
                  comparison.level.empty() ? "" : ", ", comparison.level, label(best),
                  quantity.better == Better::kLower ? "lowest" : "highest", quantity.label,
                  with_unit(best.mean, quantity), label(next), with_unit(next.mean, quantity));
  if (!next.change) return text + ".";
  return text + fmt::format(" ({}, {} over {}).",
                            next.corrected_p < kAlpha ? "a significant difference"
                                                      : "no significant difference",
                            p_words(next.corrected_p), counted(comparison.groups, "group"));
}

}  // namespace mapproof
