#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <boost/math/distributions/binomial.hpp>

#include "core/base/words.hpp"
#include "core/statistics/paired_change.hpp"
#include "core/statistics/signed_rank.hpp"
#include "reports/history/regression_rules.hpp"
#include "reports/history/shown_names.hpp"

namespace mapproof {
namespace {

/// A ratio below which both errors count as nothing.
constexpr double kLeastError = 1e-9;

/// One method and quantity over its steps.
using Family = std::tuple<std::string, std::string, std::string>;

/// Differences of one run, step by step.
struct RunPairs {
  std::string unit = {};
  std::vector<double> differences = {};
};

/// What one test is of.
struct Comparison {
  std::string subject = {};
  const Quantity* quantity = nullptr;
  std::vector<double> differences = {};  ///< One a unit.
  bool by_layout = false;
  double before = 0.0, after = 0.0;  ///< Medians.
};

struct Losses {
  std::string subject = {};
  const Quantity* quantity = nullptr;
  int lost = 0, gained = 0, of = 0;
};

/// By how much a value got worse: in points, or the logarithm of a ratio.
double difference(const Quantity& quantity, double before, double after) {
  if (quantity.better == Better::kHigher) std::swap(before, after);
  return quantity.nightly == NightlyRule::kPoints
             ? after - before
             : std::log(std::max(after, kLeastError) / std::max(before, kLeastError));
}

const RunValue* find_run(const std::vector<RunValue>& values, const std::string& run) {
  const auto found = std::ranges::lower_bound(values, run, {}, &RunValue::run);
  return found != values.end() && found->run == run ? &*found : nullptr;
}

/// Adds the differences of one step to those of each run, and counts what was lost.
void add_step(std::map<std::string, RunPairs>& runs, Losses& losses, const Quantity& quantity,
              const std::vector<RunValue>& before, const std::vector<RunValue>& after) {
  for (const RunValue& old : before) {
    const RunValue* now = find_run(after, old.run);
    if (now == nullptr) continue;
    const bool had = std::isfinite(old.value);
    const bool has = std::isfinite(now->value);
    losses.of += had;
    losses.lost += had && !has;
    losses.gained += !had && has;
    if (!had || !has) continue;
    RunPairs& pairs = runs[old.run];
    pairs.unit = old.unit;
    pairs.differences.push_back(difference(quantity, old.value, now->value));
  }
}

/// Means of each run, or of each layout where there are enough.
std::vector<double> unit_means(const std::map<std::string, RunPairs>& runs, int least_layouts,
                               bool& by_layout) {
  std::map<std::string, std::pair<double, int>> units;
  std::set<std::string> layouts;
  for (const auto& [run, pairs] : runs) layouts.insert(pairs.unit);
  by_layout = layouts.size() < runs.size() && std::cmp_greater_equal(layouts.size(), least_layouts);
  for (const auto& [run, pairs] : runs) {
    auto& [sum, count] = units[by_layout ? pairs.unit : run];
    for (const double value : pairs.differences) sum += value;
    count += static_cast<int>(pairs.differences.size());
  }
  std::vector<double> means;
  for (const auto& [unit, total] : units) means.push_back(total.first / total.second);
  return means;
}

/// All that tonight and the reference have in common.
struct Work {
  std::vector<Comparison> comparisons;
  std::vector<Losses> losses;
  std::set<std::string> too_few;
};

void add_family(Work& work, const StudyEvidence& evidence, const RegressionRules& rules,
                const std::vector<const SeriesId*>& steps) {
  const Quantity& quantity = evidence.trend.quantities.at(steps.front()->quantity);
  Losses losses{method_of(*steps.back()), &quantity};
  std::map<std::string, RunPairs> all;
  std::map<std::string, RunPairs> last;
  for (const SeriesId* series : steps) {
    const auto& before = evidence.reference->scores.at(*series);
    const auto& after = evidence.tonight.at(*series);
    add_step(all, losses, quantity, before, after);
    Losses of_last;
    if (series == steps.back()) add_step(last, of_last, quantity, before, after);
  }
  const auto add = [&](const std::map<std::string, RunPairs>& runs, const std::string& subject) {
    if (runs.empty()) return;
    Comparison comparison{.subject = subject, .quantity = &quantity};
    comparison.differences = unit_means(runs, rules.least_layouts, comparison.by_layout);
    comparison.before = known_median(evidence.reference->scores.at(*steps.back()));
    comparison.after = known_median(evidence.tonight.at(*steps.back()));
    if (std::cmp_less(comparison.differences.size(), rules.least_units))
      work.too_few.insert(shown_subject(method_of(*steps.back())));
    else
      work.comparisons.push_back(std::move(comparison));
  };
  add(last, subject_of(*steps.back()));
  if (steps.size() > 1)
    add(all, fmt::format("{}, mean of {} steps", method_of(*steps.back()), steps.size()));
  // MOE is missing where MPE is: told once.
  if (quantity.nightly == NightlyRule::kRatio) work.losses.push_back(std::move(losses));
}

Work compare_all(const StudyEvidence& evidence, const RegressionRules& rules) {
  std::map<Family, std::vector<const SeriesId*>> families;
  for (const auto& [series, values] : evidence.tonight) {
    if (!is_accuracy(rule_of(series, evidence.trend.quantities, evidence.tonight))) continue;
    if (!evidence.reference->scores.contains(series)) continue;
    families[{series.sensor, series.method, series.quantity}].push_back(&series);
  }
  Work work;
  for (const auto& [family, steps] : families) add_family(work, evidence, rules, steps);
  return work;
}

/// The sign test against as many lost as gained.
double sign_p(int lost, int gained) {
  if (lost + gained == 0) return 1.0;
  const boost::math::binomial fair(lost + gained, 0.5);
  return lost == 0 ? 1.0 : boost::math::cdf(boost::math::complement(fair, lost - 1));
}

/// In percent of what it was.
double worse_percent(const Quantity& quantity, double log_ratio) {
  return quantity.better == Better::kHigher ? -100.0 * std::expm1(-log_ratio)
                                            : 100.0 * std::expm1(log_ratio);
}

std::string range_words(const Quantity& quantity, double low, double high) {
  if (quantity.nightly == NightlyRule::kPoints)
    return fmt::format("{:.2f} to {:.2f}\u00a0points", low, high);
  return fmt::format("{:.1f} to {:.1f}\u00a0%", worse_percent(quantity, low),
                     worse_percent(quantity, high));
}

std::string p_text(double p) { return p < 1e-9 ? "p < 1e-9" : fmt::format("p = {:.2g}", p); }

NightFinding finding_of(const Comparison& comparison, const PairedChange& change, double p,
                        std::size_t tests, const StudyEvidence& evidence) {
  const Quantity& quantity = *comparison.quantity;
  const std::string interval = range_words(quantity, change.low, change.high);
  const std::string units = counted(change.units, comparison.by_layout ? "layout" : "run");
  return {
      .study = evidence.trend.name,
      .rule = NightRule::kAccuracy,
      .subject = comparison.subject,
      .quantity = quantity.id,
      .since = evidence.trend.nights.back().number,
      .sentence = fmt::format("{}: {} {} than on night {}, 95\u00a0% interval {}; median {:.4g} → "
                              "{:.4g}\u00a0{} at the last "
                              "step; {}, {} corrected for {}",
                              shown_subject(comparison.subject), quantity.label,
                              worse_words(quantity, change.shift), evidence.reference->night,
                              interval, comparison.before, comparison.after, quantity.unit, units,
                              p_text(p), counted(static_cast<long long>(tests), "test"))};
}

NightFinding finding_of(const Losses& losses, double p, const StudyEvidence& evidence) {
  return {.study = evidence.trend.name,
          .rule = NightRule::kLostMaps,
          .subject = losses.subject,
          .quantity = losses.quantity->id,
          .since = evidence.trend.nights.back().number,
          .sentence = fmt::format(
              "{}: {} of the {} results of night {} no longer come out, {} do that did not; {}",
              shown_subject(losses.subject), losses.lost, losses.of, evidence.reference->night,
              losses.gained, p_text(p))};
}

}  // namespace

std::string change_words(double change, bool ratio, const std::string& word) {
  return ratio ? fmt::format("{:.1f}\u00a0% {}", 100.0 * std::expm1(change), word)
               : fmt::format("{:.2f}\u00a0points {}", change, word);
}

std::string worse_words(const Quantity& quantity, double worsening) {
  const char* word = quantity.better == Better::kHigher ? "lower" : "higher";
  if (quantity.nightly != NightlyRule::kRatio) return change_words(worsening, false, word);
  return fmt::format("{:.1f}\u00a0% {}", worse_percent(quantity, worsening), word);
}

RuleOutcome judge_accuracy(const StudyEvidence& evidence, const RegressionRules& rules) {
  RuleOutcome outcome;
  if (!evidence.reference) {
    outcome.remarks.push_back(
        evidence.trend.name +
        ": no night to compare with made it with these settings and this seed");
    return outcome;
  }
  const Work work = compare_all(evidence, rules);
  const std::size_t tests = work.comparisons.size() + work.losses.size();
  if (!work.too_few.empty())
    outcome.remarks.push_back(fmt::format(
        "{}: too few runs to pair for {}{}; judged over nights", evidence.trend.name,
        *work.too_few.begin(),
        work.too_few.size() == 1 ? "" : fmt::format(" and {} more", work.too_few.size() - 1)));
  if (tests == 0) return outcome;
  // Ranks only where they can pass the correction with room to spare.
  const PairedChangeOptions options{.finest_p = 0.1 * rules.alpha / static_cast<double>(tests)};
  std::vector<PairedChange> changes;
  std::vector<double> p;
  for (const Comparison& comparison : work.comparisons) {
    changes.push_back(paired_change(comparison.differences, options));
    p.push_back(changes.back().p);
  }
  for (const Losses& losses : work.losses) p.push_back(sign_p(losses.lost, losses.gained));
  p = holm(p);
  std::set<std::pair<std::string, std::string>> told;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const Comparison& comparison = work.comparisons[i];
    const double least = comparison.quantity->nightly == NightlyRule::kRatio ? rules.least_ratio
                                                                             : rules.least_points;
    if (p[i] > rules.alpha || changes[i].shift < least) continue;
    // Of one method the last step speaks for the mean over the steps.
    const std::string method = comparison.subject.substr(0, comparison.subject.rfind(", "));
    if (!told.insert({method, comparison.quantity->id}).second) continue;
    outcome.findings.push_back(finding_of(comparison, changes[i], p[i], tests, evidence));
  }
  for (std::size_t i = 0; i < work.losses.size(); ++i)
    if (p[changes.size() + i] <= rules.alpha)
      outcome.findings.push_back(finding_of(work.losses[i], p[changes.size() + i], evidence));
  return outcome;
}

}  // namespace mapproof
