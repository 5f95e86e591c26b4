#include "reports/history/judge_night.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

void append(RuleOutcome& all, RuleOutcome more) {
  std::ranges::move(more.findings, std::back_inserter(all.findings));
  std::ranges::move(more.remarks, std::back_inserter(all.remarks));
}

/// Whether the nightly run has a study that was ordered in the same way as one of this nightly
/// run's.
bool can_be_compared(HistoryStore& store, int night, const Night& tonight) {
  return std::ranges::any_of(
      tonight.studies, [&](const StudyNight& study) { return has_study(store, night, study); });
}

void drop_before(StudyTrend& trend, int night) {
  const auto first = std::ranges::find_if(
      trend.nights, [&](const NightFacts& facts) { return facts.number >= night; });
  const auto count = std::distance(trend.nights.begin(), first);
  trend.nights.erase(trend.nights.begin(), first);
  trend.peak_memory_mib.erase(trend.peak_memory_mib.begin(), trend.peak_memory_mib.begin() + count);
  for (auto* all : {&trend.medians, &trend.levels})
    for (auto& [series, values] : *all) values.erase(values.begin(), values.begin() + count);
}

StudyEvidence evidence_of(HistoryStore& store, const Night& tonight, const StudyNight& study,
                          int pinned) {
  StudyEvidence evidence{
      .trend = store.trend(study.name, study.order_digest, kTrendNights, tonight.facts.number - 1),
      .tonight = study.scores,
      .draws_groups = study.draws_groups};
  drop_before(evidence.trend, pinned);
  add_tonight(evidence.trend, tonight.facts, study);
  if (!tonight.facts.reference) return evidence;
  for (const StudyNight& then : store.studies(*tonight.facts.reference))
    if (then.name == study.name && then.order_digest == study.order_digest)
      evidence.reference = {*tonight.facts.reference,
                            store.scores(*tonight.facts.reference, study.name)};
  return evidence;
}

}  // namespace

void add_tonight(StudyTrend& trend, const NightFacts& facts, const StudyNight& study) {
  const std::size_t before = trend.nights.size();
  trend.nights.push_back(facts);
  trend.peak_memory_mib.push_back(study.peak_memory_mib.value_or(kNaN));
  const auto add = [&](auto& all, const auto& value_of) {
    for (const auto& [series, values] : study.scores) all.try_emplace(series, before, kNaN);
    for (auto& [series, of_nights] : all) {
      if (of_nights.size() != before)
        throw InvalidInput("add_tonight: a series has another number of nightly runs");
      const auto found = study.scores.find(series);
      of_nights.push_back(found == study.scores.end() ? kNaN : value_of(series, found->second));
    }
  };
  add(trend.medians, [](const SeriesId&, const auto& values) { return known_median(values); });
  for (const Quantity& quantity : study.quantities.declared()) trend.quantities.declare(quantity);
  for (const auto& [id, label] : study.labels.setups) trend.labels.setups[id] = label;
  for (const auto& [id, label] : study.labels.methods) trend.labels.methods[id] = label;
  add(trend.levels, [&](const SeriesId& series, const auto& values) {
    return level_of(trend.quantities.at(series.quantity), values);
  });
}

RuleOutcome judge_study(const StudyEvidence& evidence, const RegressionRules& rules,
                        const std::vector<NightFinding>& yesterday) {
  RuleOutcome outcome = judge_accuracy(evidence, rules);
  RuleOutcome costs = judge_costs(evidence, rules);
  // Few groups are judged both ways: a series is reported once.
  std::erase_if(costs.findings, [&](const NightFinding& finding) {
    return std::ranges::any_of(outcome.findings, [&](const NightFinding& other) {
      return other.subject == finding.subject && other.quantity == finding.quantity;
    });
  });
  append(outcome, std::move(costs));
  append(outcome, judge_drifts(evidence, rules, outcome.findings));
  for (NightFinding& finding : outcome.findings) {
    const auto same = std::ranges::find_if(yesterday, [&](const NightFinding& old) {
      return old.study == finding.study && old.subject == finding.subject &&
             old.quantity == finding.quantity;
    });
    if (same == yesterday.end() || same->since >= finding.since) continue;
    finding.since = same->since;
    finding.sentence += fmt::format("; since nightly run {}", same->since);
  }
  return outcome;
}

bool has_study(HistoryStore& store, int night, const StudyNight& tonight) {
  return std::ranges::any_of(store.studies(night), [&](const StudyNight& then) {
    return then.name == tonight.name && then.order_digest == tonight.order_digest;
  });
}

std::optional<int> reference_night(HistoryStore& store, const Night& tonight,
                                   std::optional<int> asked) {
  const std::vector<NightFacts> nights = store.nights();
  if (asked) {
    if (std::ranges::find(nights, *asked, &NightFacts::number) == nights.end())
      throw InvalidInput(fmt::format("--reference: there is no nightly run {}", *asked));
    if (!can_be_compared(store, *asked, tonight))
      throw InvalidInput(
          fmt::format("--reference: nightly run {} has no requested study with the same "
                      "settings",
                      *asked));
    return asked;
  }
  for (const NightFacts& night : nights)
    if (night.pinned) return night.number;
  for (auto night = nights.rbegin(); night != nights.rend(); ++night)
    if (night->verdict == NightVerdict::kGood && can_be_compared(store, night->number, tonight))
      return night->number;
  return std::nullopt;
}

std::vector<std::string> judge_night(HistoryStore& store, Night& tonight,
                                     std::optional<int> asked_reference,
                                     const RegressionRules& rules) {
  tonight.facts.reference = reference_night(store, tonight, asked_reference);
  // A pinned reference may have no study of this nightly run.
  if (tonight.facts.reference && !can_be_compared(store, *tonight.facts.reference, tonight))
    tonight.facts.reference.reset();
  const std::vector<NightFacts> nights = store.nights();
  const std::vector<NightFinding> yesterday =
      nights.empty() ? std::vector<NightFinding>{} : store.findings(nights.back().number);
  int pinned = 0;
  for (const NightFacts& night : nights)
    if (night.pinned) pinned = night.number;
  std::vector<std::string> remarks;
  if (!nights.empty() && tonight.facts.started_utc < nights.back().ended_utc)
    remarks.push_back(fmt::format(
        "the clock stands at {}, before the end of nightly run {} at {}: nightly runs are ordered "
        "by their number",
        tonight.facts.started_utc, nights.back().number, nights.back().ended_utc));
  for (const StudyNight& study : tonight.studies) {
    RuleOutcome outcome = judge_study(evidence_of(store, tonight, study, pinned), rules, yesterday);
    std::ranges::move(outcome.findings, std::back_inserter(tonight.findings));
    std::ranges::move(outcome.remarks, std::back_inserter(remarks));
  }
  tonight.facts.verdict = verdict_of(tonight.findings);
  return remarks;
}

}  // namespace mapproof
