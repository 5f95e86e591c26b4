#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/results/quantity.hpp"
#include "core/results/study_labels.hpp"

namespace mapproof {

/// What a number of a night is of: all but the run.
struct SeriesId {
  std::string sensor = {};  ///< Condition::setup: "bearing", "plaza-1".
  std::string method = {};  ///< With its parameter and all levels but steps: "isomap-K6 level=30".
  int step = 0;             ///< 0: of the whole.
  std::string quantity = {};  ///< Quantity::id.

  auto operator<=>(const SeriesId&) const = default;
};

/// "bearing, isomap-K6, 2000 steps".
std::string subject_of(const SeriesId& series);
/// The same without the step.
std::string method_of(const SeriesId& series);
/// Where the levels of factors begin in a SeriesId::method: the blank before "noise=0.1"; its size
/// where there are none.
std::size_t levels_begin(const std::string& method);

/// One value of one run.
struct RunValue {
  std::string run = {};   ///< "layout-1-pose-2", "plaza-1".
  std::string unit = {};  ///< What runs that depend on each other share: "layout-1".
  double value = 0.0;     ///< NaN: no map came out, or there is nothing to judge.
};

/// The values of a study by what they are of; runs in ascending order.
using Scores = std::map<SeriesId, std::vector<RunValue>>;

/// A figure's file as it was drawn that night.
struct FigureFile {
  std::string file = {};    ///< "fig-4.svg".
  std::string digest = {};  ///< SHA-256, hexadecimal.
  std::int64_t bytes = 0;
};

/// What a night holds of one study.
struct StudyNight {
  std::string name = {};
  std::string kind = {};          ///< "mapproof.study", "mapproof.slam_study".
  std::string order_digest = {};  ///< SHA-256 of the experiment as it was ordered: nights are
                                  ///< compared where it is the same.
  bool draws_groups = false;      ///< StudyContents::draws_groups.
  int runs = 0;
  std::optional<double> seconds = {};  ///< Of all sessions that made it.
  std::optional<double> peak_memory_mib = {};
  Quantities quantities = {};  ///< The dictionary and what the study declares.
  StudyLabels labels = {};
  Scores scores = {};
  std::vector<FigureFile> figures = {};
};

/// What is wrong with a night, in order of weight.
enum class NightVerdict {
  kGood,
  kCost,      ///< Only seconds or memory grew.
  kAccuracy,  ///< Accuracy got worse.
};

/// "good", "cost", "accuracy".
std::string_view name(NightVerdict verdict);
std::optional<NightVerdict> night_verdict_named(std::string_view name);

/// Which rule found something.
enum class NightRule {
  kAccuracy,       ///< Paired by seed against the reference night.
  kLostResults,    ///< Results that no longer come out, or series that are not there any more.
  kSeconds,        ///< One method slower than the others would have it.
  kAllSeconds,     ///< Everything slower, two nights in a row.
  kMemory,         ///< Two nights in a row.
  kAccuracyDrift,  ///< A change point over many nights.
  kCostDrift,
};

/// "accuracy", "lost-results", "seconds", "all-seconds", "memory", "accuracy-drift", "cost-drift".
std::string_view name(NightRule rule);
std::optional<NightRule> rule_named(std::string_view name);
NightVerdict verdict_of(NightRule rule);

/// One thing that got worse.
struct NightFinding {
  std::string study = {};
  NightRule rule = NightRule::kAccuracy;
  std::string subject = {};   ///< "bearing, isomap-K6"; of the whole study: "all methods".
  std::string quantity = {};  ///< Quantity::id, or "memory".
  int since = 0;              ///< The night it began, as far as can be told.
  std::string sentence = {};  ///< With numbers.
};

/// The heaviest of them.
NightVerdict verdict_of(const std::vector<NightFinding>& findings);

/// Where and when a night was made.
struct NightFacts {
  int number = 0;                ///< Its place in the order of nights, from 1; never given twice.
  std::string started_utc = {};  ///< ISO 8601. Clocks jump: nights are ordered by number.
  std::string ended_utc = {};
  std::string command = {};
  std::string provenance = {};  ///< JSON.
  std::string host = {};
  std::string processor = {};  ///< "x86_64, AMD EPYC …".
  int cores = 0;
  int jobs = 0;
  std::optional<int> reference = {};  ///< The night it was compared with.
  bool pinned = false;
  NightVerdict verdict = NightVerdict::kGood;
};

/// The verdict in a word: its name, but "not compared" where nothing got worse because there was
/// nothing to compare with.
std::string_view verdict_word(const NightFacts& night);

/// Whether seconds of the two can be compared.
bool same_machine(const NightFacts& a, const NightFacts& b);

/// A night as it is appended.
struct Night {
  NightFacts facts = {};
  std::vector<StudyNight> studies = {};
  std::vector<NightFinding> findings = {};
};

/// One study over the nights that had the same order, oldest first, tonight last: what trends and
/// change points are taken from.
struct StudyTrend {
  std::string name = {};
  Quantities quantities = {};
  StudyLabels labels = {};  ///< Of all these nights, the last one's first.
  std::vector<NightFacts> nights = {};
  std::vector<double> peak_memory_mib = {};  ///< One a night; NaN: not known.
  /// Medians over runs, one a night; NaN: none.
  std::map<SeriesId, std::vector<double>> medians = {};
  /// Likewise, as change points are looked for in: see level_of().
  std::map<SeriesId, std::vector<double>> levels = {};
};

/// The median of the values that are no NaN; NaN without any.
double known_median(const std::vector<RunValue>& values);

/// The mean over the runs of the logarithm of a quantity that is judged by ratio, 1e-9 for less;
/// of any other its mean; its negative of what is better if it is higher. Runs differ far more than
/// nights do: a median would follow one of them. NaN without any.
double level_of(const Quantity& quantity, const std::vector<RunValue>& values);

/// What nightly runs do with a series: what its quantity says; but one that stands in for another
/// is only kept where `all`, a map by SeriesId, has the other as well.
template <typename Map>
NightlyRule rule_of(const SeriesId& series, const Quantities& quantities, const Map& all) {
  const Quantity& quantity = quantities.at(series.quantity);
  if (quantity.stands_in_for.empty()) return quantity.nightly;
  const SeriesId other{series.sensor, series.method, series.step, quantity.stands_in_for};
  return all.contains(other) ? NightlyRule::kKept : quantity.nightly;
}

/// Whether it is an error that is judged.
constexpr bool is_accuracy(NightlyRule rule) {
  return rule == NightlyRule::kRatio || rule == NightlyRule::kPoints;
}

}  // namespace mapproof
