#include "reports/history/accuracy_rule.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <tuple>

#include <fmt/format.h>
#include <boost/math/distributions/binomial.hpp>

#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "core/statistics/paired_runs.hpp"
#include "reports/history/great_medians.hpp"
#include "reports/history/regression_rules.hpp"
#include "reports/history/shown_names.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

/// One method and quantity over its steps.
using Family = std::tuple<std::string, std::string, std::string>;

/// By how much values got worse, in ascending order of the runs, those of one run step by step.
struct RunDifferences {
  std::vector<RunChange> changes = {};
  bool differ = false;     ///< One by more than rounding may.
  bool from_zero = false;  ///< One grew from 0: its ratio is that to kLeastError.
};

/// What one test is of.
struct Comparison {
  std::string subject = {};
  std::string shown = {};   ///< The subject, for readers.
  std::string method = {};  ///< method_of() its series.
  const Quantity* quantity = nullptr;
  PairedUnits units = {};            ///< By how much each got worse.
  bool has_steps = false;            ///< The medians are of the last.
  bool from_zero = false;            ///< A run's value grew from 0: there is no percentage.
  double before = 0.0, after = 0.0;  ///< Medians.
};

struct Losses {
  std::string subject = {};
  std::string shown = {};
  const Quantity* quantity = nullptr;
  int lost = 0, gained = 0, of = 0;
};

/// Series of the reference that this nightly run does not have at all.
struct Vanished {
  std::string subject = {};
  std::string shown = {};
  std::string quantity = {};  ///< Of the first of them.
  std::set<std::string> quantities = {};
  int series = 0;
};

const RunValue* find_run(const std::vector<RunValue>& values, const Name& run) {
  const auto found = std::ranges::lower_bound(values, run, {}, &RunValue::run);
  return found != values.end() && found->run == run ? &*found : nullptr;
}

/// Adds the differences of one step, and counts what was lost. A run that is not there any more is
/// lost as well.
void add_step(RunDifferences& differences, Losses& losses, const Quantity& quantity,
              const std::vector<RunValue>& before, const std::vector<RunValue>& after) {
  differences.changes.reserve(differences.changes.size() + std::min(before.size(), after.size()));
  const double worse = quantity.better == Better::kHigher ? -1.0 : 1.0;
  for (const RunValue& old : before) {
    const RunValue* now = find_run(after, old.run);
    const bool had = std::isfinite(old.value);
    const bool has = now != nullptr && std::isfinite(now->value);
    losses.of += had;
    losses.lost += had && !has;
    losses.gained += !had && has;
    if (!had || !has) continue;
    const bool in_points = changes_in_points(quantity);
    const double change = value_change(in_points, old.value, now->value);
    differences.changes.push_back({old.run, old.unit, worse * change});
    differences.differ = differences.differ || !quantity.rounding.holds(old.value, now->value);
    differences.from_zero =
        differences.from_zero || (!in_points && old.value < kLeastError && change > 0.0);
  }
  for (const RunValue& now : after)
    losses.gained += std::isfinite(now.value) && find_run(before, now.run) == nullptr;
}

/// All that this nightly run and the reference have in common.
struct Work {
  std::vector<Comparison> comparisons;
  std::vector<Losses> losses;
  std::vector<Vanished> vanished;
  std::set<std::string> too_few;
  std::set<std::string> other_runs;  ///< Methods that have no run in common.
};

void add_family(Work& work, const StudyEvidence& evidence,
                const std::vector<const SeriesId*>& steps) {
  const Quantity& quantity = evidence.trend.quantities.at(steps.front()->quantity);
  const StudyLabels& labels = evidence.trend.labels;
  const std::string method = method_of(*steps.back());
  const std::string shown = shown_method_of(labels, *steps.back());
  Losses losses{method, shown, &quantity};
  const bool has_steps = steps.size() > 1;
  bool has_any = false;
  RunDifferences all, last;
  for (const SeriesId* series : steps) {
    const auto& before = evidence.reference->scores.at(*series);
    const auto& after = evidence.this_run.at(*series);
    last = {};
    add_step(last, losses, quantity, before, after);
    has_any = has_any || !last.changes.empty();
    if (!has_steps) continue;
    all.changes.insert(all.changes.end(), last.changes.begin(), last.changes.end());
    all.differ = all.differ || last.differ;
    all.from_zero = all.from_zero || last.from_zero;
  }
  const auto add = [&](RunDifferences differences, const std::string& subject,
                       const std::string& shown_as) {
    if (differences.changes.empty()) return;
    Comparison comparison{
        .subject = subject,
        .shown = shown_as,
        .method = method,
        .quantity = &quantity,
        .units = paired_units(std::move(differences.changes), evidence.draws_groups),
        .has_steps = steps.back()->step != 0,
        .from_zero = differences.from_zero};
    comparison.before = known_median(evidence.reference->scores.at(*steps.back()));
    comparison.after = known_median(evidence.this_run.at(*steps.back()));
    if (std::cmp_less(comparison.units.changes.size(), kLeastUnits))
      work.too_few.insert(shown);
    else if (differences.differ)
      work.comparisons.push_back(std::move(comparison));
  };
  add(std::move(last), subject_of(*steps.back()), shown_subject(labels, *steps.back()));
  if (has_steps) {
    std::ranges::stable_sort(all.changes, {}, &RunChange::run);
    const std::string mean = fmt::format(", mean of {} steps", steps.size());
    add(std::move(all), method + mean, shown + mean);
  }
  if (!has_any && losses.lost > 0 && losses.gained > 0) work.other_runs.insert(shown);
  // Quantities that are lost together are one finding.
  const auto same = std::ranges::find_if(work.losses, [&](const Losses& other) {
    return other.subject == losses.subject && other.lost == losses.lost &&
           other.gained == losses.gained && other.of == losses.of;
  });
  if (same == work.losses.end())
    work.losses.push_back(std::move(losses));
  else if (dictionary_rank(quantity) < dictionary_rank(*same->quantity))
    same->quantity = &quantity;
}

/// Names what is gone by the widest thing that is gone: a setup, a method of it, one of its levels.
void add_vanished(Work& work, const StudyEvidence& evidence) {
  const auto without_levels = [](SeriesId series) {
    series.method.resize(levels_begin(series.method));
    return series;
  };
  const auto base = [&](const SeriesId& series) { return method_of(without_levels(series)); };
  std::set<std::string> setups, methods, quantities, subjects;
  for (const auto& [series, values] : evidence.this_run) {
    setups.insert(series.sensor);
    methods.insert(base(series));
    quantities.insert(series.quantity);
    subjects.insert(method_of(series));
  }
  const auto is_known = [](const RunValue& value) { return std::isfinite(value.value); };
  for (const auto& [series, values] : evidence.reference->scores) {
    const Quantity* quantity = evidence.trend.quantities.find(series.quantity);
    if (quantity == nullptr || quantity->nightly == NightlyRule::kDuration) continue;
    if (evidence.this_run.contains(series) || std::ranges::none_of(values, is_known)) continue;
    const auto [subject, shown] = [&, &series = series]() -> std::pair<std::string, std::string> {
      const StudyLabels& labels = evidence.trend.labels;
      if (!setups.contains(series.sensor)) {
        const std::string setup = shown_setup(labels, series.sensor);
        return {series.sensor, setup.empty() ? "the setup without a name" : setup};
      }
      if (!methods.contains(base(series)))
        return {base(series), shown_method_of(labels, without_levels(series))};
      if (!quantities.contains(series.quantity)) return {kAllMethods, kAllMethods};
      return {method_of(series), shown_method_of(labels, series)};
    }();
    const bool of_quantity = subject == kAllMethods || subjects.contains(subject);
    auto same = std::ranges::find_if(work.vanished, [&, &subject = subject](const Vanished& other) {
      return other.subject == subject && (!of_quantity || other.quantity == series.quantity);
    });
    if (same == work.vanished.end()) {
      work.vanished.push_back({.subject = subject, .shown = shown, .quantity = series.quantity});
      same = std::prev(work.vanished.end());
    }
    ++same->series;
    same->quantities.insert(quantity->label);
  }
}

/// Only what differs is tested: under the null hypothesis, by which both signs are equally likely,
/// leaving out the others changes no probability.
Work compare_all(const StudyEvidence& evidence) {
  std::map<Family, std::vector<const SeriesId*>> families;
  for (const auto& [series, values] : evidence.this_run) {
    if (!is_accuracy(rule_of(series, evidence.trend.quantities, evidence.this_run))) continue;
    if (!evidence.reference->scores.contains(series)) continue;
    families[{series.sensor, series.method, series.quantity}].push_back(&series);
  }
  Work work;
  for (const auto& [family, steps] : families) add_family(work, evidence, steps);
  std::erase_if(work.losses, [](const Losses& one) { return one.lost + one.gained == 0; });
  add_vanished(work, evidence);
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

/// A change as sentences show it, without its unit.
std::string change_digits(const Quantity& quantity, double change) {
  return quantity.nightly == NightlyRule::kPoints
             ? fmt::format("{:.2f}", change)
             : fmt::format("{:.1f}", worse_percent(quantity, change));
}

std::string interval_words(const Quantity& quantity, const PairedChange& change) {
  const bool in_points = quantity.nightly == NightlyRule::kPoints;
  const std::string low = change_digits(quantity, change.low),
                    high = change_digits(quantity, change.high);
  return fmt::format("95\u00a0% interval {}\u00a0{}",
                     low == high ? std::string("narrower than ") + (in_points ? "0.01" : "0.1")
                                 : low + " to " + high,
                     in_points ? "points" : "%");
}

const char* worse_word(const Quantity& quantity) {
  return quantity.better == Better::kHigher ? "lower" : "higher";
}

/// "12 % higher": of a change of a level, in percent or points.
std::string amount_words(const Quantity& quantity, double worsening) {
  return quantity.nightly == NightlyRule::kRatio
             ? fmt::format("{:.1f}\u00a0% {}", worse_percent(quantity, worsening),
                           worse_word(quantity))
             : change_words(worsening, false, worse_word(quantity));
}

/// In percent or points, with the sign of the change of the values.
double signed_amount(const Quantity& quantity, double worsening) {
  const double amount =
      quantity.nightly == NightlyRule::kRatio ? worse_percent(quantity, worsening) : worsening;
  return quantity.better == Better::kHigher ? -amount : amount;
}

/// In how many units, or in pairs with which interval.
std::string pairs_words(const Comparison& comparison, const PairedChange& change,
                        const std::string& units) {
  if (change.equal) return "in each of " + units;
  const std::string pairs = fmt::format("in pairs of {}s", comparison.units.unit);
  return comparison.from_zero ? pairs : pairs + ", " + interval_words(*comparison.quantity, change);
}

NightlyFinding finding_of(const Comparison& comparison, const PairedChange& change, double p,
                          std::size_t tests, const StudyEvidence& evidence) {
  const Quantity& quantity = *comparison.quantity;
  const std::string units = counted(change.units, comparison.units.unit);
  const std::string test =
      !change.has_p()
          ? std::string(kNoPWords)
          : fmt::format("{} over {}, {} corrected for {}",
                        change.by_ranks ? "Wilcoxon's signed-rank test" : "Student's t test", units,
                        small_p_words(p), counted(static_cast<long long>(tests), "test"));
  return {
      .study = evidence.trend.name,
      .rule = HistoryRule::kAccuracy,
      .subject = comparison.subject,
      .quantity = quantity.id,
      .since = evidence.trend.nightly_runs.back().number,
      .sentence = fmt::format(
          "{}: {} {} than in nightly run {} {}; median {}{}; {}", comparison.shown, quantity.label,
          comparison.from_zero ? worse_word(quantity) : amount_words(quantity, change.shift),
          evidence.reference->nightly_run, pairs_words(comparison, change, units),
          medians_text(comparison.before, comparison.after, quantity.unit,
                       has_great_errors(evidence.trend, quantity)),
          comparison.has_steps ? " at the last step" : "", test),
      .change = comparison.from_zero ? std::nullopt
                                     : std::optional(signed_amount(quantity, change.shift))};
}

NightlyFinding finding_of(const Losses& losses, double p, const StudyEvidence& evidence) {
  return {
      .study = evidence.trend.name,
      .rule = HistoryRule::kLostResults,
      .subject = losses.subject,
      .quantity = losses.quantity->id,
      .since = evidence.trend.nightly_runs.back().number,
      .sentence = fmt::format(
          "{}: {} of the {} results of nightly run {} no longer come out, {} do that did not; {}",
          losses.shown, losses.lost, losses.of, evidence.reference->nightly_run, losses.gained,
          small_p_words(p))};
}

NightlyFinding finding_of(const Vanished& vanished, const StudyEvidence& evidence) {
  return {.study = evidence.trend.name,
          .rule = HistoryRule::kLostResults,
          .subject = vanished.subject,
          .quantity = vanished.quantity,
          .since = evidence.trend.nightly_runs.back().number,
          .sentence = fmt::format(
              "{}: no result any more, where nightly run {} had {} ({})", vanished.shown,
              evidence.reference->nightly_run,
              vanished.series == 1 ? "one series" : fmt::format("{} series", vanished.series),
              listed({vanished.quantities.begin(), vanished.quantities.end()}, 4))};
}

/// Whether so many results are lost that no test is needed.
bool are_many(const Losses& losses, const RegressionRules& rules) {
  const int net = losses.lost - losses.gained;
  return net > 0 && (losses.lost == losses.of ||
                     (net >= rules.least_lost && net >= rules.least_lost_share * losses.of));
}

/// "A and 3 more" of methods.
std::string first_of(const std::set<std::string>& methods) {
  return *methods.begin() +
         (methods.size() == 1 ? "" : fmt::format(" and {} more", methods.size() - 1));
}

/// What is lost, whether by a test or without one; the rest is remarked on.
/// @param p  Of the losses, corrected.
void judge_losses(const Work& work, std::span<const double> p, const StudyEvidence& evidence,
                  const RegressionRules& rules, RuleOutcome& outcome) {
  for (const Vanished& vanished : work.vanished)
    outcome.findings.push_back(finding_of(vanished, evidence));
  int lost = 0;
  std::set<std::string> methods;
  for (std::size_t i = 0; i < work.losses.size(); ++i) {
    const Losses& losses = work.losses[i];
    if (p[i] <= rules.alpha || are_many(losses, rules)) {
      outcome.findings.push_back(finding_of(losses, p[i], evidence));
    } else if (losses.lost > 0) {
      lost += losses.lost;
      methods.insert(losses.shown);
    }
  }
  if (lost > 0)
    outcome.remarks.push_back(fmt::format(
        "{}: {} of nightly run {} no longer come out, of {}; too few of each to be judged",
        evidence.trend.name, counted(lost, "result"), evidence.reference->nightly_run,
        first_of(methods)));
  if (!work.other_runs.empty())
    outcome.remarks.push_back(fmt::format(
        "{}: no run in common with nightly run {} for {}; not compared", evidence.trend.name,
        evidence.reference->nightly_run, first_of(work.other_runs)));
}

}  // namespace

std::string change_words(double change, bool ratio, const std::string& word) {
  return ratio ? fmt::format("{:.1f}\u00a0% {}", 100.0 * std::expm1(change), word)
               : fmt::format("{:.2f}\u00a0points {}", change, word);
}

std::optional<double> change_of(const Quantity& quantity, double before, double worsening) {
  if (is_level_of_zero(quantity, before)) return std::nullopt;
  return signed_amount(quantity, worsening);
}

std::string worse_words(const Quantity& quantity, double before, double worsening) {
  if (is_level_of_zero(quantity, before))
    return fmt::format("{} {}", quantity_text(std::exp(before + worsening), quantity.unit),
                       worse_word(quantity));
  return amount_words(quantity, worsening);
}

RuleOutcome judge_accuracy(const StudyEvidence& evidence, const RegressionRules& rules) {
  RuleOutcome outcome;
  if (!evidence.reference) {
    outcome.remarks.push_back(evidence.trend.name +
                              ": no nightly run to compare with has the same settings");
    return outcome;
  }
  const Work work = compare_all(evidence);
  const std::size_t tests = work.comparisons.size() + work.losses.size();
  if (!work.too_few.empty())
    outcome.remarks.push_back(
        fmt::format("{}: too few {} to pair for {}; judged over nightly runs", evidence.trend.name,
                    evidence.draws_groups ? "groups" : "runs", first_of(work.too_few)));
  std::vector<std::span<const double>> units;
  for (const Comparison& comparison : work.comparisons) units.push_back(comparison.units.changes);
  std::vector<double> p_of_losses;
  for (const Losses& losses : work.losses)
    p_of_losses.push_back(sign_p(losses.lost, losses.gained));
  const auto [changes, p] = test_pairs(units, p_of_losses);
  std::set<std::pair<std::string, std::string>> reported;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const Comparison& comparison = work.comparisons[i];
    const double least = comparison.quantity->nightly == NightlyRule::kRatio ? rules.least_ratio
                                                                             : rules.least_points;
    if (p[i] > rules.alpha || changes[i].shift < least) continue;
    // Of one method the last step speaks for the mean over the steps.
    if (!reported.insert({comparison.method, comparison.quantity->id}).second) continue;
    outcome.findings.push_back(finding_of(comparison, changes[i], p[i], tests, evidence));
  }
  judge_losses(work, std::span(p).subspan(changes.size()), evidence, rules, outcome);
  return outcome;
}

}  // namespace mapproof
