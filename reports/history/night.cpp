#include "reports/history/night.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {
namespace {

constexpr std::array kVerdictNames = {std::pair(NightVerdict::kGood, "good"),
                                      std::pair(NightVerdict::kCost, "cost"),
                                      std::pair(NightVerdict::kAccuracy, "accuracy")};

constexpr std::array kRuleNames = {
    std::pair(NightRule::kAccuracy, "accuracy"),
    std::pair(NightRule::kLostResults, "lost-results"),
    std::pair(NightRule::kSeconds, "seconds"),
    std::pair(NightRule::kAllSeconds, "all-seconds"),
    std::pair(NightRule::kMemory, "memory"),
    std::pair(NightRule::kAccuracyDrift, "accuracy-drift"),
    std::pair(NightRule::kCostDrift, "cost-drift"),
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

std::string subject_of(const SeriesId& series) {
  return series.step == 0 ? method_of(series)
                          : fmt::format("{}, {} steps", method_of(series), series.step);
}

std::string_view name(NightVerdict verdict) { return name_in(kVerdictNames, verdict); }
std::optional<NightVerdict> night_verdict_named(std::string_view name) {
  return value_in(kVerdictNames, name);
}

std::string_view name(NightRule rule) { return name_in(kRuleNames, rule); }
std::optional<NightRule> rule_named(std::string_view name) {
  if (name == "lost-maps") return NightRule::kLostResults;  // As older histories call it.
  return value_in(kRuleNames, name);
}

NightVerdict verdict_of(NightRule rule) {
  switch (rule) {
    case NightRule::kAccuracy:
    case NightRule::kLostResults:
    case NightRule::kAccuracyDrift:
      return NightVerdict::kAccuracy;
    default:
      return NightVerdict::kCost;
  }
}

NightVerdict verdict_of(const std::vector<NightFinding>& findings) {
  NightVerdict verdict = NightVerdict::kGood;
  for (const NightFinding& finding : findings)
    verdict = std::max(verdict, verdict_of(finding.rule));
  return verdict;
}

std::string_view verdict_word(const NightFacts& night) {
  const bool unjudged = night.verdict == NightVerdict::kGood && !night.reference;
  return unjudged ? "not compared" : name(night.verdict);
}

bool same_machine(const NightFacts& a, const NightFacts& b) {
  return a.host == b.host && a.processor == b.processor && a.cores == b.cores && a.jobs == b.jobs;
}

double known_median(const std::vector<RunValue>& values) {
  std::vector<double> known;
  for (const RunValue& value : values)
    if (!std::isnan(value.value)) known.push_back(value.value);
  return known.empty() ? kNaN : median(known);
}

double level_of(const Quantity& quantity, const std::vector<RunValue>& values) {
  constexpr double kLeastError = 1e-9;
  const bool ratio = quantity.nightly == NightlyRule::kRatio;
  double sum = 0.0;
  int count = 0;
  for (const RunValue& value : values) {
    if (!std::isfinite(value.value)) continue;
    sum += ratio ? std::log(std::max(value.value, kLeastError)) : value.value;
    ++count;
  }
  if (count == 0) return kNaN;
  return (quantity.better == Better::kHigher ? -sum : sum) / count;
}

}  // namespace mapproof
