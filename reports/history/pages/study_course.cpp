#include "reports/history/pages/study_course.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "reports/history/accuracy_rule.hpp"
#include "reports/history/regression_rules.hpp"
#include "reports/history/shown_names.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

/// The findings of each of the trend's nightly runs on its study.
std::vector<std::vector<NightlyFinding>> findings_of(const StudyTrend& trend,
                                                     const NightlyFindings& findings) {
  std::vector<std::vector<NightlyFinding>> all(trend.nightly_runs.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const auto found = findings.find(trend.nightly_runs[i].number); found != findings.end())
      std::ranges::copy_if(
          found->second, std::back_inserter(all[i]),
          [&](const NightlyFinding& finding) { return finding.study == trend.name; });
  return all;
}

bool is_by_points(const Quantity& quantity) { return quantity.nightly == NightlyRule::kPoints; }

/// Of which size a change is shown as one: the least that a rule for accuracy finds.
double least_of(bool in_points) {
  const RegressionRules rules;
  return in_points ? rules.least_points : 100.0 * rules.least_ratio;
}

constexpr int kDecimals = 1;  ///< Of a change, in percent or in points.

/// The least change that is shown as one: half of its last digit.
double least_shown() { return 0.5 * std::pow(10.0, -kDecimals); }

/// By how much a quantity changed between two levels (see level_of()): in percent, or in points of
/// what is judged by points. The sign is that of the change of its values.
double change_between(const Quantity& quantity, double before, double after) {
  return quantity.nightly == NightlyRule::kDuration ? 100.0 * (after / before - 1.0)
                                                    : change_of(quantity, after - before);
}

/// The same over the nightly runs, above zero where it is worse.
std::vector<double> changes_of(const Quantity& quantity, const std::vector<double>& levels,
                               std::size_t from) {
  const double sign = quantity.better == Better::kHigher ? -1.0 : 1.0;
  std::vector<double> changes;
  for (const double level : levels)
    changes.push_back(sign * change_between(quantity, levels[from], level));
  return changes;
}

/// The course of a series, red where a finding is about it.
ChangeCurve curve_of(const StudyTrend& trend, const SeriesId& id, std::size_t from,
                     const std::vector<std::vector<NightlyFinding>>& findings) {
  const Quantity& quantity = trend.quantities.at(id.quantity);
  ChangeCurve curve{.changes = changes_of(quantity, trend.levels.at(id), from),
                    .least = least_of(is_by_points(quantity))};
  for (const auto& found : findings)
    curve.is_found.push_back(std::ranges::any_of(
        found, [&](const NightlyFinding& finding) { return is_about(finding, id); }));
  return curve;
}

/// The series that a finding is about and whose change is nearest to its own; null if it is about
/// none that is still there.
const SeriesId* series_of(const NightlyFinding& finding, const StudyTrend& trend,
                          std::size_t from) {
  const SeriesId* nearest = nullptr;
  double least = kInfinity;
  for (const auto& [id, levels] : trend.levels) {
    const double change =
        change_between(trend.quantities.at(id.quantity), levels[from], levels.back());
    const double distance = std::abs(change - finding.change.value_or(change));
    if (!is_about(finding, id) || !std::isfinite(distance) || distance > least) continue;
    least = distance;
    nearest = &id;
  }
  return nearest;
}

ChangeCurve memory_curve(const StudyTrend& trend, std::size_t from,
                         const std::vector<std::vector<NightlyFinding>>& findings) {
  ChangeCurve curve;
  for (const double mib : trend.peak_memory_mib)
    curve.changes.push_back(100.0 * (mib / trend.peak_memory_mib[from] - 1.0));
  for (const auto& found : findings)
    curve.is_found.push_back(std::ranges::any_of(
        found, [](const NightlyFinding& finding) { return finding.rule == HistoryRule::kMemory; }));
  return curve;
}

/// By the least that a rule for accuracy finds: changes in percent and in points on one scale.
double size_of(const FindingGroup& group) {
  if (group.changes.empty()) return kInfinity;  // Results are lost.
  const auto [least, most] = std::ranges::minmax(group.changes);
  return std::max(std::abs(least), std::abs(most)) / least_of(group.in_points);
}

/// "MPE +17.6 %" of a change of a series.
std::string change_words(const StudyTrend& trend, const SeriesId& id, double worsening) {
  const Quantity& quantity = trend.quantities.at(id.quantity);
  return fmt::format("{}: {} {}\u00a0{}", shown_method_of(trend.labels, id), quantity.label,
                     format_number(change_of(quantity, worsening), kDecimals, true),
                     is_by_points(quantity) ? "points" : "%");
}

/// Which changes are shown.
enum class Shown {
  kAll,        ///< All that are not 0 in the digits shown.
  kAsFindings  ///< Those by the least change of a finding or more.
};

/// The judged error with the greatest change of a sign. Changes in percent and in points are
/// compared by what a rule finds of each.
std::optional<Course> greatest_course(const StudyTrend& trend, const NightlyFindings& findings,
                                      double sign, Shown shown) {
  const auto found = findings_of(trend, findings);
  const std::size_t from = base_index(trend, found.back());
  const SeriesId* greatest = nullptr;
  double most = 0.0;
  for (const auto& [id, levels] : trend.levels) {
    if (!is_accuracy(rule_of(id, trend.quantities, trend.levels))) continue;
    const Quantity& quantity = trend.quantities.at(id.quantity);
    const double change = sign * changes_of(quantity, levels, from).back();
    const double least = least_of(is_by_points(quantity)), size = change / least;
    const bool is_shown = change >= (shown == Shown::kAll ? least_shown() : least);
    if (!std::isfinite(size) || !is_shown || size < most) continue;
    most = size;
    greatest = &id;
  }
  if (greatest == nullptr) return std::nullopt;
  const std::vector<double>& levels = trend.levels.at(*greatest);
  return Course{change_words(trend, *greatest, levels.back() - levels[from]),
                curve_of(trend, *greatest, from, found)};
}

}  // namespace

std::optional<Course> worst_course(const StudyTrend& trend, const NightlyFindings& findings,
                                   std::span<const NightlyNote> notes) {
  const auto found = findings_of(trend, findings);
  const std::vector<NightlyFinding>& last = found.back();
  const std::vector<FindingGroup> groups = grouped(last, std::span(&trend, 1), notes);
  if (groups.empty()) return greatest_course(trend, findings, 1.0, Shown::kAll);
  const auto is_less = [](const FindingGroup& a, const FindingGroup& b) {
    if (a.known.has_value() != b.known.has_value()) return a.known.has_value();
    return size_of(a) < size_of(b);
  };
  const FindingGroup& worst = *std::ranges::max_element(groups, is_less);
  Course course;
  course.words = worst.setup.empty() ? "" : worst.setup + ", ";
  course.words += worst.headline();
  if (worst.known) course.words += ", known";
  if (const std::size_t others = last.size() - worst.numbers.size(); others > 0)
    course.words += ", and " + counted(static_cast<long long>(others), "more finding");
  const std::size_t from = base_index(trend, last);
  const auto change = [&](int number) {
    return std::abs(last[static_cast<std::size_t>(number) - 1].change.value_or(0.0));
  };
  const int number = *std::ranges::max_element(worst.numbers, {}, change);
  const NightlyFinding& finding = last[static_cast<std::size_t>(number) - 1];
  if (worst.rule == HistoryRule::kMemory)
    course.curve = memory_curve(trend, from, found);
  else if (const SeriesId* id = series_of(finding, trend, from))
    course.curve = curve_of(trend, *id, from, found);
  return course;
}

std::optional<Course> best_course(const StudyTrend& trend, const NightlyFindings& findings) {
  return greatest_course(trend, findings, -1.0, Shown::kAsFindings);
}

}  // namespace mapproof
