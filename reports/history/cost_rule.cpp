#include "reports/history/cost_rule.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/statistics/intervals.hpp"
#include "core/statistics/paired_runs.hpp"
#include "core/statistics/robust_noise.hpp"
#include "reports/history/accuracy_rule.hpp"
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
                           const std::vector<std::size_t>& indices) {
  std::vector<double> out;
  for (const std::size_t index : indices)
    if (!std::isnan(values[index])) out.push_back(values[index]);
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
    std::vector<double> mean(trend.nightly_runs.size(), 0.0);
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
  int nightly_runs = 0;
};

/// What is known of the noise of several series together.
struct SharedNoise {
  double sigma = 0.0;
  int values = 0;
};

/// Of what each nightly run lies off its own series' median.
SharedNoise shared_noise(const std::vector<NightlySeries>& all, HistoryRule rule,
                         const std::vector<std::size_t>& usual) {
  std::vector<double> off;
  for (const NightlySeries& series : all) {
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
Limit limit_of(const NightlySeries& series, const std::vector<std::size_t>& usual, double p,
               const SharedNoise& shared = {}) {
  const std::vector<double> values = picked(series.values, usual);
  RobustNoise noise = robust_noise(values);
  const Limit limit{noise.median, noise.median + series.least, noise.values};
  noise.sigma = std::max(noise.sigma, shared.sigma);
  noise.values = std::max(noise.values, shared.values);
  return {limit.usual, std::max(limit.most, upper_limit(noise, p, series.floor)),
          limit.nightly_runs};
}

NightlyFinding finding_of(const NightlySeries& series, const Limit& limit, const StudyTrend& trend,
                          int since, const std::string& word) {
  const std::string label =
      series.quantity == "memory" ? "peak memory" : trend.quantities.at(series.quantity).label;
  const bool is_error = series.rule == HistoryRule::kAccuracy;
  const auto words = [&](double worsening) {
    return is_error ? worse_words(trend.quantities.at(series.quantity), limit.usual, worsening)
                    : change_words(worsening, series.ratio, word);
  };
  const double worsening = series.values.back() - limit.usual;
  const std::optional<double> change =
      is_error ? change_of(trend.quantities.at(series.quantity), limit.usual, worsening)
               : std::optional(100.0 * std::expm1(worsening));
  return {.study = trend.name,
          .rule = series.rule,
          .subject = series.subject,
          .quantity = series.quantity,
          .since = since,
          .sentence =
              fmt::format("{}: {} {} than usual in {} passing nightly runs{}{}", series.shown,
                          label, words(worsening), limit.nightly_runs,
                          change ? ", where the limit is " + words(limit.most - limit.usual) : "",
                          since == trend.nightly_runs.back().number
                              ? ""
                              : fmt::format("; since nightly run {}", since)),
          .change = change};
}

/// The index of the last nightly run before this one that has a value and was made on the same
/// machine.
std::optional<std::size_t> nightly_before(const StudyTrend& trend, const NightlySeries& series) {
  for (std::size_t i = trend.nightly_runs.size() - 1; i-- > 0;)
    if (!std::isnan(series.values[i]) &&
        same_machine(trend.nightly_runs[i], trend.nightly_runs.back()))
      return i;
  return std::nullopt;
}

/// By how much two nightly runs in a row have to be beyond what is usual.
struct SustainedRule {
  double p = 0.0;              ///< The chance that both are.
  int least_nightly_runs = 1;  ///< That define what is usual.
};

void judge_sustained(const NightlySeries& series, const StudyTrend& trend,
                     const std::vector<std::size_t>& usual, const SustainedRule& rule,
                     RuleOutcome& outcome) {
  const auto before = nightly_before(trend, series);
  if (std::isnan(series.values.back()) || !before) return;
  // The nightly run before is judged as well: it cannot define what is usual.
  std::vector<std::size_t> others = usual;
  std::erase(others, *before);
  // Both nightly runs have to be beyond it, each by a chance of its own.
  const Limit limit = limit_of(series, others, std::sqrt(rule.p));
  if (limit.nightly_runs < rule.least_nightly_runs || series.values.back() <= limit.most) return;
  const std::string word = series.rule == HistoryRule::kAllSeconds ? "slower" : "higher";
  const int since = trend.nightly_runs[*before].number;
  if (series.values[*before] > limit.most) {
    outcome.findings.push_back(finding_of(series, limit, trend, since, word));
    return;
  }
  outcome.remarks.push_back(
      finding_of(series, limit, trend, trend.nightly_runs.back().number, word).sentence +
      "; flagged if the next nightly run is too");
}

/// How many units a series has that pairs can be tested by.
int units_of(const std::vector<RunValue>& values, bool draws_groups) {
  std::set<Name> units;
  for (const RunValue& value : values) units.insert(draws_groups ? value.unit : value.run);
  return static_cast<int>(units.size());
}

/// Accuracy of single logs, and of few groups: little or nothing to pair, so judged over nightly
/// runs.
std::vector<NightlySeries> unpaired_series(const StudyEvidence& evidence,
                                           const RegressionRules& rules) {
  const int least = evidence.draws_groups ? kLeastGroups : kLeastUnits;
  std::vector<NightlySeries> series;
  for (NightlySeries& one : accuracy_series(evidence.trend, rules)) {
    int units = 0;
    for (const auto& [id, values] : evidence.this_run)
      if (method_of(id) == one.subject && id.quantity == one.quantity)
        units = std::max(units, units_of(values, evidence.draws_groups));
    one.least = one.ratio ? std::log1p(rules.least_growth) : rules.least_points;
    if (units < least) series.push_back(std::move(one));
  }
  return series;
}

}  // namespace

std::vector<std::size_t> usual_nightly_runs(const StudyTrend& trend, const RegressionRules& rules) {
  std::vector<std::size_t> usual;
  for (std::size_t i = 0; i + 1 < trend.nightly_runs.size(); ++i)
    // A user who pins a nightly run accepts it as passing.
    if ((trend.nightly_runs[i].verdict == NightlyVerdict::kPassed ||
         trend.nightly_runs[i].pinned) &&
        same_machine(trend.nightly_runs[i], trend.nightly_runs.back()))
      usual.push_back(i);
  const auto most = static_cast<std::size_t>(rules.most_good_nightly_runs);
  if (usual.size() > most) usual.erase(usual.begin(), usual.end() - static_cast<long>(most));
  return usual;
}

std::vector<NightlySeries> seconds_series(const StudyTrend& trend,
                                          const std::vector<std::size_t>& usual,
                                          const RegressionRules& rules) {
  std::vector<NightlySeries> all;
  for (auto& [method, seconds] : log_seconds(trend, rules.shortest_s)) {
    const double level = median_of(picked(seconds.logs, usual));
    if (std::isnan(level)) continue;
    NightlySeries series{.rule = HistoryRule::kSeconds,
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
    for (NightlySeries& series : all) series.rule = HistoryRule::kAllSeconds;
    return all;
  }
  NightlySeries common{.rule = HistoryRule::kAllSeconds,
                       .subject = kAllMethods,
                       .shown = kAllMethods,
                       .quantity = "seconds",
                       .least = std::log1p(rules.least_slowdown),
                       .floor = rules.seconds_floor};
  for (std::size_t nightly_run = 0; nightly_run < trend.nightly_runs.size(); ++nightly_run) {
    std::vector<double> of_nightly_run;
    for (const NightlySeries& series : all) of_nightly_run.push_back(series.values[nightly_run]);
    common.values.push_back(median_of(of_nightly_run));
    for (NightlySeries& series : all) series.values[nightly_run] -= common.values.back();
  }
  all.push_back(std::move(common));
  return all;
}

std::vector<NightlySeries> memory_series(const StudyTrend& trend, const RegressionRules& rules) {
  NightlySeries series{.rule = HistoryRule::kMemory,
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
  return known ? std::vector{series} : std::vector<NightlySeries>{};
}

std::vector<NightlySeries> accuracy_series(const StudyTrend& trend, const RegressionRules& rules) {
  // Series ascend by step: the last of each method and quantity stays.
  std::map<std::pair<std::string, std::string>, NightlySeries> last;
  for (const auto& [id, values] : trend.levels) {
    const NightlyRule rule = rule_of(id, trend.quantities, trend.levels);
    if (!is_accuracy(rule)) continue;
    const bool ratio = rule == NightlyRule::kRatio;
    NightlySeries series{.rule = HistoryRule::kAccuracy,
                         .subject = method_of(id),
                         .shown = shown_method_of(trend.labels, id),
                         .quantity = id.quantity,
                         .ratio = ratio,
                         .least = ratio ? std::log1p(rules.least_ratio) : rules.least_points,
                         .values = values};
    last[{series.subject, series.quantity}] = std::move(series);
  }
  std::vector<NightlySeries> all;
  for (auto& [key, series] : last) all.push_back(std::move(series));
  return all;
}

RuleOutcome judge_costs(const StudyEvidence& evidence, const RegressionRules& rules) {
  RuleOutcome outcome;
  const StudyTrend& trend = evidence.trend;
  const std::vector<std::size_t> usual = usual_nightly_runs(trend, rules);
  if (std::cmp_less(usual.size(), rules.least_passing_nightly_runs)) {
    outcome.remarks.push_back(
        fmt::format("{}: seconds and memory of a single nightly run are not judged yet: that takes "
                    "{} earlier nightly runs on this machine that passed, and so far there {} {}",
                    trend.name, rules.least_passing_nightly_runs, usual.size() == 1 ? "is" : "are",
                    usual.size()));
    return outcome;
  }
  const std::vector<NightlySeries> seconds = seconds_series(trend, usual, rules);
  const double p = rules.alpha / std::max<double>(1.0, static_cast<double>(seconds.size()));
  const SharedNoise shared = shared_noise(seconds, HistoryRule::kSeconds, usual);
  for (const NightlySeries& series : seconds) {
    if (series.rule == HistoryRule::kAllSeconds) {
      judge_sustained(series, trend, usual, {p, rules.least_passing_nightly_runs - 1}, outcome);
      continue;
    }
    const Limit limit = limit_of(series, usual, p, shared);
    if (limit.nightly_runs >= rules.least_passing_nightly_runs && series.values.back() > limit.most)
      outcome.findings.push_back(
          finding_of(series, limit, trend, trend.nightly_runs.back().number, "slower"));
  }
  for (const NightlySeries& series : memory_series(trend, rules))
    judge_sustained(series, trend, usual, {rules.alpha, rules.least_passing_nightly_runs - 1},
                    outcome);
  for (const NightlySeries& series : unpaired_series(evidence, rules))
    judge_sustained(series, trend, usual, {rules.alpha, 1}, outcome);
  return outcome;
}

}  // namespace mapproof
