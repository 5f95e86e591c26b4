#include "reports/history/nightly_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/statistics/paired_runs.hpp"

namespace mapproof {
namespace {

constexpr std::array kVerdictNames = {std::pair(NightlyVerdict::kPassed, "passed"),
                                      std::pair(NightlyVerdict::kCost, "cost"),
                                      std::pair(NightlyVerdict::kAccuracy, "accuracy")};

constexpr std::array kRuleNames = {
    std::pair(HistoryRule::kAccuracy, "accuracy"),
    std::pair(HistoryRule::kLostResults, "lost-results"),
    std::pair(HistoryRule::kSeconds, "seconds"),
    std::pair(HistoryRule::kAllSeconds, "all-seconds"),
    std::pair(HistoryRule::kMemory, "memory"),
    std::pair(HistoryRule::kAccuracyDrift, "accuracy-drift"),
    std::pair(HistoryRule::kCostDrift, "cost-drift"),
};

template <typename Value, std::size_t N>
std::string_view name_in(const std::array<std::pair<Value, const char*>, N>& names, Value value) {
  for (const auto& [known, text] : names)
    if (known == value) return text;
  throw InvalidInput("a value of an enumeration has no name");
}

template <typename Value, std::size_t N>
std::optional<Value> value_in(const std::array<std::pair<Value, const char*>, N>& names,
                              std::string_view name) {
  for (const auto& [value, text] : names)
    if (name == text) return value;
  return std::nullopt;
}

}  // namespace

std::string method_of(const SeriesId& series) { return series.sensor + ", " + series.method; }

std::size_t levels_begin(const std::string& method) {
  for (std::size_t at = method.find('='); at != std::string::npos; at = method.find('=', at + 1))
    if (const std::size_t blank = method.rfind(' ', at); blank != std::string::npos) return blank;
  return method.size();
}

bool is_about(const NightlyFinding& finding, const SeriesId& series) {
  if (finding.quantity != series.quantity) return false;
  const std::string method = method_of(series);
  return finding.subject == kAllMethods || finding.subject == method ||
         finding.subject.starts_with(method + ", ");
}

std::string subject_of(const SeriesId& series) {
  return series.step == 0 ? method_of(series)
                          : fmt::format("{}, {} steps", method_of(series), series.step);
}

std::string_view name(NightlyVerdict verdict) { return name_in(kVerdictNames, verdict); }
std::optional<NightlyVerdict> nightly_verdict_named(std::string_view name) {
  return value_in(kVerdictNames, name);
}

std::string_view name(HistoryRule rule) { return name_in(kRuleNames, rule); }
std::optional<HistoryRule> rule_named(std::string_view name) {
  if (name == "lost-maps") return HistoryRule::kLostResults;  // As older histories call it.
  return value_in(kRuleNames, name);
}

NightlyVerdict verdict_of(HistoryRule rule) {
  switch (rule) {
    case HistoryRule::kAccuracy:
    case HistoryRule::kLostResults:
    case HistoryRule::kAccuracyDrift:
      return NightlyVerdict::kAccuracy;
    default:
      return NightlyVerdict::kCost;
  }
}

NightlyVerdict verdict_of(const std::vector<NightlyFinding>& findings) {
  NightlyVerdict verdict = NightlyVerdict::kPassed;
  for (const NightlyFinding& finding : findings)
    verdict = std::max(verdict, verdict_of(finding.rule));
  return verdict;
}

std::string_view verdict_word(const NightlyFacts& nightly_run) {
  const bool unjudged = nightly_run.verdict == NightlyVerdict::kPassed && !nightly_run.reference;
  return unjudged ? "not compared" : name(nightly_run.verdict);
}

bool same_machine(const NightlyFacts& a, const NightlyFacts& b) {
  return a.host == b.host && a.processor == b.processor && a.cores == b.cores && a.jobs == b.jobs;
}

double known_median(const std::vector<RunValue>& values) {
  std::vector<double> known;
  for (const RunValue& value : values)
    if (!std::isnan(value.value)) known.push_back(value.value);
  return known.empty() ? kNaN : median(known);
}

double percent_change(double before, double after) {
  return before > 0.0 ? 100.0 * (after / before - 1.0) : kNaN;
}

double median_change(const Quantity& quantity, double before, double after) {
  if (quantity.nightly == NightlyRule::kPoints) return after - before;
  const bool was_zero = quantity.nightly == NightlyRule::kRatio && before < kLeastError;
  return was_zero ? kNaN : percent_change(before, after);
}

double level_of(const Quantity& quantity, const std::vector<RunValue>& values) {
  const bool ratio = quantity.nightly == NightlyRule::kRatio;
  double sum = 0.0;
  int count = 0;
  for (const RunValue& value : values) {
    // A ratio of what lies below 0 means nothing: it is not judged.
    if (!std::isfinite(value.value) || (ratio && value.value < 0.0)) continue;
    sum += ratio ? std::log(std::max(value.value, kLeastError)) : value.value;
    ++count;
  }
  if (count == 0) return kNaN;
  return (quantity.better == Better::kHigher ? -sum : sum) / count;
}

bool is_level_of_zero(const Quantity& quantity, double level) {
  // Twice as much is nothing as well, and the mean of logarithms is rounded.
  return quantity.nightly == NightlyRule::kRatio && quantity.better != Better::kHigher &&
         level < std::log(2.0 * kLeastError);
}

}  // namespace mapproof
