#include "reports/history/judge_nightly_run.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/statistics/robust_noise.hpp"
#include "core/statistics/signed_rank.hpp"
#include "reports/history/accuracy_rule.hpp"
#include "reports/history/cost_rule.hpp"
#include "reports/history/nightly_run.hpp"
#include "reports/history/regression_rules.hpp"
#include "reports/history/shown_names.hpp"
#include "reports/model/format.hpp"

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

/// Whether one of them is about the quantity of a method, at a step or over all.
bool is_reported(const std::vector<NightlyFinding>& found, const std::string& method,
                 const std::string& quantity) {
  return std::ranges::any_of(found, [&](const NightlyFinding& finding) {
    return finding.quantity == quantity &&
           (finding.subject == method || finding.subject.starts_with(method + ", "));
  });
}

NightlyFinding finding_of(const Known& known, double p, std::size_t tests,
                          const StudyTrend& trend) {
  const NightlySeries& series = known.series;
  const bool accuracy = series.rule == HistoryRule::kAccuracy;
  const std::vector<double> before(known.values.begin(),
                                   known.values.begin() + std::max(1, known.change.first));
  const int since = known.nightly_runs[static_cast<std::size_t>(known.change.first)];
  const std::string change =
      accuracy
          ? worse_words(trend.quantities.at(series.quantity), median(before), known.change.rise)
          : change_words(known.change.rise, series.ratio,
                         series.quantity == "seconds" ? "slower" : "higher");
  const std::string label =
      series.quantity == "memory" ? "peak memory" : trend.quantities.at(series.quantity).label;
  return {.study = trend.name,
          .rule = accuracy ? HistoryRule::kAccuracyDrift : HistoryRule::kCostDrift,
          .subject = series.subject,
          .quantity = series.quantity,
          .since = since,
          .sentence = fmt::format("{}: {} {} since about nightly run {}, {}; {} corrected "
                                  "for {} series of {} nightly runs",
                                  series.shown, label, change, since,
                                  known.change.gradual ? "a slow drift" : "a step",
                                  small_p_words(p), tests, known.values.size()),
          .change = accuracy ? change_of(trend.quantities.at(series.quantity), median(before),
                                         known.change.rise)
                             : std::optional(100.0 * std::expm1(known.change.rise))};
}

/// Rises at an unknown nightly run, by rise_in(), of all of these over the nightly runs of the
/// trend; p corrected by Holm.
/// @param found  What other rules found of this nightly run: it is not reported twice.
RuleOutcome judge_drifts(const StudyEvidence& evidence, const RegressionRules& rules,
                         const std::vector<NightlyFinding>& found) {
  RuleOutcome outcome;
  const std::vector<Known> all = known_series(evidence.trend, rules);
  std::vector<double> p;
  for (const Known& known : all) p.push_back(known.change.p);
  p = holm(p);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (p[i] <= rules.alpha && all[i].change.rise >= all[i].series.least &&
        !is_reported(found, all[i].series.subject, all[i].series.quantity))
      outcome.findings.push_back(finding_of(all[i], p[i], all.size(), evidence.trend));
  return outcome;
}

void append(RuleOutcome& all, RuleOutcome more) {
  std::ranges::move(more.findings, std::back_inserter(all.findings));
  std::ranges::move(more.remarks, std::back_inserter(all.remarks));
}

/// Whether the nightly run has a study that was ordered in the same way as one of this nightly
/// run's.
bool can_be_compared(HistoryStore& store, int nightly_run, const NightlyRun& this_run) {
  return std::ranges::any_of(this_run.studies, [&](const NightlyStudy& study) {
    return has_study(store, nightly_run, study);
  });
}

void drop_before(StudyTrend& trend, int nightly_run) {
  const auto first = std::ranges::find_if(
      trend.nightly_runs, [&](const NightlyFacts& facts) { return facts.number >= nightly_run; });
  const auto count = std::distance(trend.nightly_runs.begin(), first);
  trend.nightly_runs.erase(trend.nightly_runs.begin(), first);
  trend.peak_memory_mib.erase(trend.peak_memory_mib.begin(), trend.peak_memory_mib.begin() + count);
  for (auto* all : {&trend.medians, &trend.levels})
    for (auto& [series, values] : *all) values.erase(values.begin(), values.begin() + count);
}

/// @param study  Of this nightly run, whose scores are lent to the evidence.
StudyEvidence evidence_of(HistoryStore& store, const NightlyRun& this_run, NightlyStudy& study,
                          int pinned) {
  StudyEvidence evidence{.trend = store.trend(study.name, study.experiment_digest, kTrendRuns,
                                              this_run.facts.number - 1),
                         .draws_groups = study.draws_groups};
  drop_before(evidence.trend, pinned);
  add_this_run(evidence.trend, this_run.facts, study);
  evidence.this_run = std::move(study.scores);
  if (!this_run.facts.reference) return evidence;
  for (const NightlyStudy& then : store.studies(*this_run.facts.reference))
    if (then.name == study.name && then.experiment_digest == study.experiment_digest)
      evidence.reference = {*this_run.facts.reference,
                            store.scores(*this_run.facts.reference, study.name)};
  return evidence;
}

}  // namespace

void add_this_run(StudyTrend& trend, const NightlyFacts& facts, const NightlyStudy& study) {
  const std::size_t before = trend.nightly_runs.size();
  trend.nightly_runs.push_back(facts);
  trend.peak_memory_mib.push_back(study.peak_memory_mib.value_or(kNaN));
  const auto add = [&](auto& all, const auto& value_of) {
    for (const auto& [series, values] : study.scores) all.try_emplace(series, before, kNaN);
    for (auto& [series, of_nightly_runs] : all) {
      if (of_nightly_runs.size() != before)
        throw InvalidInput("add_this_run: a series has another number of nightly runs");
      const auto found = study.scores.find(series);
      of_nightly_runs.push_back(found == study.scores.end() ? kNaN
                                                            : value_of(series, found->second));
    }
  };
  add(trend.medians, [](const SeriesId&, const auto& values) { return known_median(values); });
  for (const Quantity& quantity : study.quantities.declared()) trend.quantities.declare(quantity);
  trend.labels.add(study.labels);
  add(trend.levels, [&](const SeriesId& series, const auto& values) {
    return level_of(trend.quantities.at(series.quantity), values);
  });
}

RuleOutcome judge_study(const StudyEvidence& evidence, const RegressionRules& rules,
                        const std::vector<NightlyFinding>& yesterday) {
  RuleOutcome outcome = judge_accuracy(evidence, rules);
  RuleOutcome costs = judge_costs(evidence, rules);
  // Few groups are judged both ways: a series is reported once.
  std::erase_if(costs.findings, [&](const NightlyFinding& finding) {
    return is_reported(outcome.findings, finding.subject, finding.quantity);
  });
  append(outcome, std::move(costs));
  append(outcome, judge_drifts(evidence, rules, outcome.findings));
  for (NightlyFinding& finding : outcome.findings) {
    const auto same = std::ranges::find_if(yesterday, [&](const NightlyFinding& old) {
      return old.study == finding.study && old.subject == finding.subject &&
             old.quantity == finding.quantity;
    });
    if (same == yesterday.end() || same->since >= finding.since) continue;
    finding.since = same->since;
    finding.sentence += fmt::format("; since nightly run {}", same->since);
  }
  return outcome;
}

bool has_study(HistoryStore& store, int nightly_run, const NightlyStudy& this_run) {
  return std::ranges::any_of(store.studies(nightly_run), [&](const NightlyStudy& then) {
    return then.name == this_run.name && then.experiment_digest == this_run.experiment_digest;
  });
}

std::optional<int> reference_nightly_run(HistoryStore& store, const NightlyRun& this_run,
                                         std::optional<int> asked) {
  const std::vector<NightlyFacts> nightly_runs = store.nightly_runs();
  if (asked) {
    if (std::ranges::find(nightly_runs, *asked, &NightlyFacts::number) == nightly_runs.end())
      throw InvalidInput(fmt::format("--reference: there is no nightly run {}", *asked));
    if (!can_be_compared(store, *asked, this_run))
      throw InvalidInput(
          fmt::format("--reference: nightly run {} has no requested study with the same "
                      "settings",
                      *asked));
    return asked;
  }
  for (const NightlyFacts& nightly_run : nightly_runs)
    if (nightly_run.pinned) return nightly_run.number;
  for (auto nightly_run = nightly_runs.rbegin(); nightly_run != nightly_runs.rend(); ++nightly_run)
    if (nightly_run->verdict == NightlyVerdict::kPassed &&
        can_be_compared(store, nightly_run->number, this_run))
      return nightly_run->number;
  return std::nullopt;
}

std::vector<std::string> judge_nightly_run(HistoryStore& store, NightlyRun& this_run,
                                           std::optional<int> asked_reference,
                                           const RegressionRules& rules) {
  this_run.facts.reference = reference_nightly_run(store, this_run, asked_reference);
  // A pinned reference may have no study of this nightly run.
  if (this_run.facts.reference && !can_be_compared(store, *this_run.facts.reference, this_run))
    this_run.facts.reference.reset();
  const std::vector<NightlyFacts> nightly_runs = store.nightly_runs();
  const std::vector<NightlyFinding> yesterday = nightly_runs.empty()
                                                    ? std::vector<NightlyFinding>{}
                                                    : store.findings(nightly_runs.back().number);
  int pinned = 0;
  for (const NightlyFacts& nightly_run : nightly_runs)
    if (nightly_run.pinned) pinned = nightly_run.number;
  std::vector<std::string> remarks;
  if (!nightly_runs.empty() && this_run.facts.started_utc < nightly_runs.back().ended_utc)
    remarks.push_back(fmt::format(
        "the clock stands at {}, before the end of nightly run {} at {}: nightly runs are ordered "
        "by their number",
        this_run.facts.started_utc, nightly_runs.back().number, nightly_runs.back().ended_utc));
  for (NightlyStudy& study : this_run.studies) {
    StudyEvidence evidence = evidence_of(store, this_run, study, pinned);
    RuleOutcome outcome = judge_study(evidence, rules, yesterday);
    study.scores = std::move(evidence.this_run);
    std::ranges::move(outcome.findings, std::back_inserter(this_run.findings));
    std::ranges::move(outcome.remarks, std::back_inserter(remarks));
  }
  this_run.facts.verdict = verdict_of(this_run.findings);
  return remarks;
}

}  // namespace mapproof
