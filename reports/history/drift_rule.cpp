#include "reports/history/drift_rule.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/statistics/robust_noise.hpp"
#include "core/statistics/signed_rank.hpp"
#include "reports/history/accuracy_rule.hpp"
#include "reports/history/cost_rule.hpp"
#include "reports/history/regression_rules.hpp"
#include "reports/history/shown_names.hpp"

namespace mapproof {
namespace {

/// A series without the nightly runs that have no value.
struct Known {
  NightlySeries series = {};
  std::vector<double> values = {};
  std::vector<int> nightly_runs = {};
  ChangePoint change = {};
};

/// @param same_machine_alone  Whether other machines' nightly runs are left out.
void add_known(std::vector<Known>& all, NightlySeries series, const StudyTrend& trend,
               bool same_machine_alone, int least_nightly_runs) {
  Known known{.series = std::move(series)};
  for (std::size_t i = 0; i < trend.nightly_runs.size(); ++i) {
    if (!std::isfinite(known.series.values[i])) continue;
    if (same_machine_alone && !same_machine(trend.nightly_runs[i], trend.nightly_runs.back()))
      continue;
    known.values.push_back(known.series.values[i]);
    known.nightly_runs.push_back(trend.nightly_runs[i].number);
  }
  if (std::cmp_less(known.values.size(), least_nightly_runs)) return;
  known.change = rise_in(known.values);
  all.push_back(std::move(known));
}

std::vector<Known> known_series(const StudyTrend& trend, const RegressionRules& rules) {
  std::vector<Known> all;
  const int least = rules.least_drift_nightly_runs;
  for (NightlySeries& series : accuracy_series(trend, rules))
    add_known(all, std::move(series), trend, false, least);
  std::vector<std::size_t> nightly_runs;
  for (std::size_t i = 0; i < trend.nightly_runs.size(); ++i)
    if (same_machine(trend.nightly_runs[i], trend.nightly_runs.back())) nightly_runs.push_back(i);
  for (NightlySeries& series : seconds_series(trend, nightly_runs, rules)) {
    // A drift is found below the limit of a single nightly run.
    series.least = std::log1p(0.5 * rules.least_slowdown);
    add_known(all, std::move(series), trend, true, least);
  }
  for (NightlySeries& series : memory_series(trend, rules))
    add_known(all, std::move(series), trend, true, least);
  return all;
}

/// Whether another rule reports it already.
bool is_reported(const std::vector<NightlyFinding>& found, const NightlySeries& series) {
  return std::ranges::any_of(found, [&](const NightlyFinding& finding) {
    return finding.quantity == series.quantity && finding.subject.starts_with(series.subject);
  });
}

NightlyFinding finding_of(const Known& known, double p, std::size_t tests,
                          const StudyTrend& trend) {
  const NightlySeries& series = known.series;
  const bool accuracy = series.rule == HistoryRule::kAccuracy;
  const int since = known.nightly_runs[static_cast<std::size_t>(known.change.first)];
  const std::string change =
      accuracy ? worse_words(trend.quantities.at(series.quantity), known.change.rise)
               : change_words(known.change.rise, series.ratio,
                              series.quantity == "seconds" ? "slower" : "higher");
  const std::string label =
      series.quantity == "memory" ? "peak memory" : trend.quantities.at(series.quantity).label;
  return {.study = trend.name,
          .rule = accuracy ? HistoryRule::kAccuracyDrift : HistoryRule::kCostDrift,
          .subject = series.subject,
          .quantity = series.quantity,
          .since = since,
          .sentence = fmt::format("{}: {} {} since about nightly run {}, {}; p = {:.2g} corrected "
                                  "for {} series of {} nightly runs",
                                  series.shown, label, change, since,
                                  known.change.gradual ? "a slow drift" : "a step", p, tests,
                                  known.values.size())};
}

}  // namespace

RuleOutcome judge_drifts(const StudyEvidence& evidence, const RegressionRules& rules,
                         const std::vector<NightlyFinding>& found) {
  RuleOutcome outcome;
  const std::vector<Known> all = known_series(evidence.trend, rules);
  std::vector<double> p;
  for (const Known& known : all) p.push_back(known.change.p);
  p = holm(p);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (p[i] <= rules.alpha && all[i].change.rise >= all[i].series.least &&
        !is_reported(found, all[i].series))
      outcome.findings.push_back(finding_of(all[i], p[i], all.size(), evidence.trend));
  return outcome;
}

}  // namespace mapproof
