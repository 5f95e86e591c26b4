#include "reports/history/pages/study_course.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
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

/// The changes of the medians over the nightly runs, above zero where they are for the worse.
std::vector<double> changes_of(const Quantity& quantity, const std::vector<double>& medians,
                               std::size_t from) {
  const double sign = quantity.better == Better::kHigher ? -1.0 : 1.0;
  std::vector<double> changes;
  for (const double median : medians)
    changes.push_back(sign * median_change(quantity, medians[from], median));
  return changes;
}

/// The last step of each method and quantity.
std::vector<SeriesId> last_steps_of(const StudyTrend& trend) {
  std::map<std::tuple<std::string, std::string, std::string>, SeriesId> last;
  for (const auto& [id, values] : trend.medians)  // Series ascend by step.
    last[{id.sensor, id.method, id.quantity}] = id;
  std::vector<SeriesId> ids;
  for (auto& [key, id] : last) ids.push_back(std::move(id));
  return ids;
}

/// The course of a series, red where a finding is about it.
ChangeCurve curve_of(const StudyTrend& trend, const SeriesId& id, std::size_t from,
                     const std::vector<std::vector<NightlyFinding>>& findings) {
  const Quantity& quantity = trend.quantities.at(id.quantity);
  ChangeCurve curve{.changes = changes_of(quantity, trend.medians.at(id), from),
                    .least = least_of(is_by_points(quantity))};
  for (const auto& found : findings)
    curve.is_found.push_back(std::ranges::any_of(
        found, [&](const NightlyFinding& finding) { return is_about(finding, id); }));
  return curve;
}

/// The series at its last step that a finding is about, of several the one whose change is nearest
/// to its own; nothing if it is about none that is still there.
std::optional<SeriesId> series_of(const NightlyFinding& finding, const StudyTrend& trend,
                                  std::size_t from) {
  std::optional<SeriesId> nearest;
  double least = kInfinity;
  for (const SeriesId& id : last_steps_of(trend)) {
    const std::vector<double>& medians = trend.medians.at(id);
    const double change =
        median_change(trend.quantities.at(id.quantity), medians[from], medians.back());
    const double distance = std::abs(change - finding.change.value_or(change));
    if (!is_about(finding, id) || !std::isfinite(distance) || distance > least) continue;
    least = distance;
    nearest = id;
  }
  return nearest;
}

ChangeCurve memory_curve(const StudyTrend& trend, std::size_t from,
                         const std::vector<std::vector<NightlyFinding>>& findings) {
  ChangeCurve curve;
  for (const double mib : trend.peak_memory_mib)
    curve.changes.push_back(percent_change(trend.peak_memory_mib[from], mib));
  for (const auto& found : findings)
    curve.is_found.push_back(std::ranges::any_of(
        found, [](const NightlyFinding& finding) { return finding.rule == HistoryRule::kMemory; }));
  return curve;
}

/// "MPE +17.6 %" of a change of a series.
std::string change_words(const StudyTrend& trend, const SeriesId& id, double change) {
  const Quantity& quantity = trend.quantities.at(id.quantity);
  return fmt::format("{}: {} {}\u00a0{}", shown_method_of(trend.labels, id), quantity.label,
                     format_number(change, kDecimals, true),
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
  std::optional<SeriesId> greatest;
  double most = 0.0;
  for (const SeriesId& id : last_steps_of(trend)) {
    if (!is_accuracy(rule_of(id, trend.quantities, trend.medians))) continue;
    const Quantity& quantity = trend.quantities.at(id.quantity);
    const double change = sign * changes_of(quantity, trend.medians.at(id), from).back();
    const double least = least_of(is_by_points(quantity)), size = change / least;
    const bool is_shown = change >= (shown == Shown::kAll ? least_shown() : least);
    if (!std::isfinite(size) || !is_shown || size < most) continue;
    most = size;
    greatest = id;
  }
  if (!greatest) return std::nullopt;
  const std::vector<double>& medians = trend.medians.at(*greatest);
  const Quantity& quantity = trend.quantities.at(greatest->quantity);
  return Course{
      change_words(trend, *greatest, median_change(quantity, medians[from], medians.back())),
      curve_of(trend, *greatest, from, found)};
}

}  // namespace

std::optional<Course> worst_course(const StudyTrend& trend, const NightlyFindings& findings,
                                   std::span<const NightlyNote> notes) {
  const auto found = findings_of(trend, findings);
  const std::vector<NightlyFinding>& last = found.back();
  const std::vector<FindingGroup> groups =
      grouped(trend.nightly_runs.back().number, last, std::span(&trend, 1), notes);
  if (groups.empty()) return greatest_course(trend, findings, 1.0, Shown::kAll);
  const FindingGroup& worst = groups.front();
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
  else if (const auto id = series_of(finding, trend, from))
    course.curve = curve_of(trend, *id, from, found);
  return course;
}

std::optional<Course> best_course(const StudyTrend& trend, const NightlyFindings& findings) {
  return greatest_course(trend, findings, -1.0, Shown::kAsFindings);
}

}  // namespace mapproof
