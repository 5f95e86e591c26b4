#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/statistics/intervals.hpp"
#include "core/statistics/robust_noise.hpp"
#include "reports/history/regression_rules.hpp"
#include "reports/history/shown_names.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMethodsForCommon = 4;

double median_of(const std::vector<double>& values) {
  const RobustNoise noise = robust_noise(values);
  return noise.values == 0 ? kNaN : noise.median;
}

std::vector<double> picked(const std::vector<double>& values,
                           const std::vector<std::size_t>& places) {
  std::vector<double> out;
  for (const std::size_t place : places)
    if (!std::isnan(values[place])) out.push_back(values[place]);
  return out;
}

/// The seconds of a method.
struct MethodSeconds {
  std::string shown = {};  ///< The method, for readers.
  std::vector<double> logs = {};
};

/// The mean over steps of the logarithms of a method's median seconds, one value per nightly run;
/// one that lacks a step has none, and neither has a method whose pieces are too short.
std::map<std::string, MethodSeconds> log_seconds(const StudyTrend& trend, double shortest) {
  std::map<std::string, MethodSeconds> methods;
  std::map<std::string, std::vector<std::vector<double>>> steps;
  for (const auto& [series, values] : trend.medians) {
    if (trend.quantities.at(series.quantity).nightly != NightlyRule::kDuration) continue;
    const double usual = median_of(values);
    if (std::isnan(usual) || usual < shortest) continue;
    std::vector<double> logs;
    for (const double value : values) logs.push_back(std::log(std::max(value, 1e-9)));
    steps[method_of(series)].push_back(std::move(logs));
    methods[method_of(series)].shown = shown_method_of(trend.labels, series);
  }
  for (const auto& [method, all] : steps) {
    std::vector<double> mean(trend.nights.size(), 0.0);
    for (const auto& logs : all)
      for (std::size_t i = 0; i < mean.size(); ++i)
        mean[i] += logs[i] / static_cast<double>(all.size());
    methods[method].logs = std::move(mean);
  }
  return methods;
}

/// A limit that this nightly run is compared with.
struct Limit {
  double usual = 0.0;
  double most = 0.0;
  int nights = 0;
};

/// What is known of the noise of several series together.
struct SharedNoise {
  double sigma = 0.0;
  int values = 0;
};

/// Of what each nightly run lies off its own series' median.
SharedNoise shared_noise(const std::vector<NightSeries>& all, NightRule rule,
                         const std::vector<std::size_t>& usual) {
  std::vector<double> off;
  for (const NightSeries& series : all) {
    if (series.rule != rule) continue;
    const std::vector<double> values = picked(series.values, usual);
    const double middle = robust_noise(values).median;
    for (const double value : values) off.push_back(value - middle);
  }
  const RobustNoise noise = robust_noise(off);
  return {noise.sigma, noise.values};
}

/// @param shared  A few nightly runs determine one method's noise poorly, all methods together
/// better: the greater of the two is used, with the degrees of freedom of all.
Limit limit_of(const NightSeries& series, const std::vector<std::size_t>& usual, double p,
               const SharedNoise& shared = {}) {
  const std::vector<double> values = picked(series.values, usual);
  RobustNoise noise = robust_noise(values);
  const Limit limit{noise.median, noise.median + series.least, noise.values};
  noise.sigma = std::max(noise.sigma, shared.sigma);
  noise.values = std::max(noise.values, shared.values);
  return {limit.usual, std::max(limit.most, upper_limit(noise, p, series.floor)), limit.nights};
}

NightFinding finding_of(const NightSeries& series, const Limit& limit, const StudyTrend& trend,
                        int since, const std::string& word) {
  const std::string label =
      series.quantity == "memory" ? "peak memory" : trend.quantities.at(series.quantity).label;
  return {
      .study = trend.name,
      .rule = series.rule,
      .subject = series.subject,
      .quantity = series.quantity,
      .since = since,
      .sentence = fmt::format(
          "{}: {} {} than usual in {} passing nightly runs, where the limit is {}{}", series.shown,
          label, change_words(series.values.back() - limit.usual, series.ratio, word), limit.nights,
          change_words(limit.most - limit.usual, series.ratio, word),
          since == trend.nights.back().number ? "" : fmt::format("; since nightly run {}", since))};
}

/// The index of the last nightly run before this one that has a value and was made on the same
/// machine.
std::optional<std::size_t> night_before(const StudyTrend& trend, const NightSeries& series) {
  for (std::size_t i = trend.nights.size() - 1; i-- > 0;)
    if (!std::isnan(series.values[i]) && same_machine(trend.nights[i], trend.nights.back()))
      return i;
  return std::nullopt;
}

void judge_sustained(const NightSeries& series, const StudyTrend& trend,
                     const std::vector<std::size_t>& usual, double p, int least_nights,
                     RuleOutcome& outcome) {
  const auto before = night_before(trend, series);
  if (std::isnan(series.values.back()) || !before) return;
  // The nightly run before is judged as well: it cannot define what is usual.
  std::vector<std::size_t> others = usual;
  std::erase(others, *before);
  // Both nightly runs have to be beyond it, each by a chance of its own.
  const Limit limit = limit_of(series, others, std::sqrt(p));
  if (limit.nights < least_nights || series.values.back() <= limit.most) return;
  const std::string word = series.rule == NightRule::kAllSeconds ? "slower" : "higher";
  const int since = trend.nights[*before].number;
  if (series.values[*before] > limit.most) {
    outcome.findings.push_back(finding_of(series, limit, trend, since, word));
    return;
  }
  outcome.remarks.push_back(
      finding_of(series, limit, trend, trend.nights.back().number, word).sentence +
      "; flagged if the next nightly run is too");
}

/// How many units a series has that pairs can be tested by.
int units_of(const std::vector<RunValue>& values, bool draws_groups) {
  std::set<std::string> units;
  for (const RunValue& value : values) units.insert(draws_groups ? value.unit : value.run);
  return static_cast<int>(units.size());
}

/// Accuracy of single logs, and of few groups: little or nothing to pair, so judged over nightly
/// runs.
std::vector<NightSeries> unpaired_series(const StudyEvidence& evidence,
                                         const RegressionRules& rules) {
  const int least = evidence.draws_groups ? rules.least_layouts : rules.least_units;
  std::vector<NightSeries> series;
  for (NightSeries& one : accuracy_series(evidence.trend, rules)) {
    int units = 0;
    for (const auto& [id, values] : evidence.tonight)
      if (method_of(id) == one.subject && id.quantity == one.quantity)
        units = std::max(units, units_of(values, evidence.draws_groups));
    one.least = one.ratio ? std::log1p(rules.least_growth) : rules.least_points;
    if (units < least) series.push_back(std::move(one));
  }
  return series;
}

}  // namespace

std::vector<std::size_t> usual_nights(const StudyTrend& trend, const RegressionRules& rules) {
  std::vector<std::size_t> usual;
  for (std::size_t i = 0; i + 1 < trend.nights.size(); ++i)
    // A user who pins a nightly run accepts it as passing.
    if ((trend.nights[i].verdict == NightVerdict::kGood || trend.nights[i].pinned) &&
        same_machine(trend.nights[i], trend.nights.back()))
      usual.push_back(i);
  const auto most = static_cast<std::size_t>(rules.most_good_nights);
  if (usual.size() > most) usual.erase(usual.begin(), usual.end() - static_cast<long>(most));
  return usual;
}

std::vector<NightSeries> seconds_series(const StudyTrend& trend,
                                        const std::vector<std::size_t>& usual,
                                        const RegressionRules& rules) {
  std::vector<NightSeries> all;
  for (auto& [method, seconds] : log_seconds(trend, rules.shortest_s)) {
    const double level = median_of(picked(seconds.logs, usual));
    if (std::isnan(level)) continue;
    NightSeries series{.rule = NightRule::kSeconds,
                       .subject = method,
                       .shown = seconds.shown,
                       .quantity = "seconds",
                       .least = std::log1p(rules.least_slowdown),
                       .floor = rules.seconds_floor,
                       .values = seconds.logs};
    for (double& value : series.values) value -= level;
    all.push_back(std::move(series));
  }
  if (all.size() < kMethodsForCommon) {
    for (NightSeries& series : all) series.rule = NightRule::kAllSeconds;
    return all;
  }
  NightSeries common{.rule = NightRule::kAllSeconds,
                     .subject = "all methods",
                     .shown = "all methods",
                     .quantity = "seconds",
                     .least = std::log1p(rules.least_slowdown),
                     .floor = rules.seconds_floor};
  for (std::size_t night = 0; night < trend.nights.size(); ++night) {
    std::vector<double> of_night;
    for (const NightSeries& series : all) of_night.push_back(series.values[night]);
    common.values.push_back(median_of(of_night));
    for (NightSeries& series : all) series.values[night] -= common.values.back();
  }
  all.push_back(std::move(common));
  return all;
}

std::vector<NightSeries> memory_series(const StudyTrend& trend, const RegressionRules& rules) {
  NightSeries series{.rule = NightRule::kMemory,
                     .subject = "the whole study",
                     .shown = "the whole study",
                     .quantity = "memory",
                     .least = std::log1p(rules.least_growth),
                     .floor = rules.memory_floor};
  bool known = false;
  for (const double mib : trend.peak_memory_mib) {
    series.values.push_back(mib > 0.0 ? std::log(mib) : kNaN);
    known = known || mib > 0.0;
  }
  return known ? std::vector{series} : std::vector<NightSeries>{};
}

std::vector<NightSeries> accuracy_series(const StudyTrend& trend, const RegressionRules& rules) {
  // Series ascend by step: the last of each method and quantity stays.
  std::map<std::pair<std::string, std::string>, NightSeries> last;
  for (const auto& [id, values] : trend.levels) {
    const NightlyRule rule = rule_of(id, trend.quantities, trend.levels);
    if (!is_accuracy(rule)) continue;
    const bool ratio = rule == NightlyRule::kRatio;
    NightSeries series{.rule = NightRule::kAccuracy,
                       .subject = method_of(id),
                       .shown = shown_method_of(trend.labels, id),
                       .quantity = id.quantity,
                       .ratio = ratio,
                       .least = ratio ? std::log1p(rules.least_ratio) : rules.least_points,
                       .values = values};
    last[{series.subject, series.quantity}] = std::move(series);
  }
  std::vector<NightSeries> all;
  for (auto& [key, series] : last) all.push_back(std::move(series));
  return all;
}

RuleOutcome judge_costs(const StudyEvidence& evidence, const RegressionRules& rules) {
  RuleOutcome outcome;
  const StudyTrend& trend = evidence.trend;
  const std::vector<std::size_t> usual = usual_nights(trend, rules);
  if (std::cmp_less(usual.size(), rules.least_good_nights)) {
    outcome.remarks.push_back(
        fmt::format("{}: {} of {} passing nightly runs on this machine so far; seconds and memory "
                    "are not judged yet",
                    trend.name, usual.size(), rules.least_good_nights));
    return outcome;
  }
  const std::vector<NightSeries> seconds = seconds_series(trend, usual, rules);
  const double p = rules.alpha / std::max<double>(1.0, static_cast<double>(seconds.size()));
  const SharedNoise shared = shared_noise(seconds, NightRule::kSeconds, usual);
  for (const NightSeries& series : seconds) {
    if (series.rule == NightRule::kAllSeconds) {
      judge_sustained(series, trend, usual, p, rules.least_good_nights - 1, outcome);
      continue;
    }
    const Limit limit = limit_of(series, usual, p, shared);
    if (limit.nights >= rules.least_good_nights && series.values.back() > limit.most)
      outcome.findings.push_back(
          finding_of(series, limit, trend, trend.nights.back().number, "slower"));
  }
  for (const NightSeries& series : memory_series(trend, rules))
    judge_sustained(series, trend, usual, rules.alpha, rules.least_good_nights - 1, outcome);
  for (const NightSeries& series : unpaired_series(evidence, rules))
    judge_sustained(series, trend, usual, rules.alpha, 1, outcome);
  return outcome;
}

}  // namespace mapproof
