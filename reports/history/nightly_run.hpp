#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/interned.hpp"
#include "core/results/quantity.hpp"
#include "core/results/study_labels.hpp"

namespace mapproof {

/// What a value of a nightly run belongs to: all of its key but the run.
struct SeriesId {
  std::string sensor = {};  ///< Condition::setup: "bearing", "plaza-1".
  std::string method = {};  ///< With its parameter and all levels but steps: "isomap-K6 level=30".
  int step = 0;             ///< 0: of the whole run.
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
  Name run = {};       ///< "layout-1-pose-2", "plaza-1".
  Name unit = {};      ///< Shared by runs that depend on each other: "layout-1".
  double value = 0.0;  ///< NaN: there is no map, or nothing to judge.
};

/// The values of a study by series; runs in ascending order.
using Scores = std::map<SeriesId, std::vector<RunValue>>;

/// A figure's file as it was drawn in that nightly run.
struct FigureFile {
  std::string file = {};    ///< "fig-4.svg".
  std::string digest = {};  ///< SHA-256, hexadecimal.
  std::int64_t bytes = 0;
};

/// What a nightly run holds of one study.
struct NightlyStudy {
  std::string name = {};
  std::string kind = {};               ///< "mapproof.study", "mapproof.slam_study".
  std::string experiment_digest = {};  ///< SHA-256 of the experiment with its options: nightly runs
                                       ///< are compared where it is the same.
  bool draws_groups = false;           ///< StudyContents::draws_groups.
  int runs = 0;
  std::optional<double> seconds = {};  ///< Of all sessions that made it.
  std::optional<double> peak_memory_mib = {};
  Quantities quantities = {};  ///< The dictionary and what the study declares.
  StudyLabels labels = {};
  Scores scores = {};
  std::vector<FigureFile> figures = {};
};

/// What is wrong with a nightly run, in order of weight.
enum class NightlyVerdict {
  kPassed,
  kCost,      ///< Only seconds or memory grew.
  kAccuracy,  ///< Accuracy got worse.
};

/// "passed", "cost", "accuracy".
std::string_view name(NightlyVerdict verdict);
std::optional<NightlyVerdict> nightly_verdict_named(std::string_view name);

/// Which rule found something.
enum class HistoryRule {
  kAccuracy,       ///< Paired by seed against the reference nightly run.
  kLostResults,    ///< Results that are now missing, or series that no longer exist.
  kSeconds,        ///< One method slower than what all methods have in common explains.
  kAllSeconds,     ///< Everything slower, two nightly runs in a row.
  kMemory,         ///< Two nightly runs in a row.
  kAccuracyDrift,  ///< A change point over many nightly runs.
  kCostDrift,
};

/// "accuracy", "lost-results", "seconds", "all-seconds", "memory", "accuracy-drift", "cost-drift".
std::string_view name(HistoryRule rule);
std::optional<HistoryRule> rule_named(std::string_view name);
NightlyVerdict verdict_of(HistoryRule rule);

/// The subject of a finding that is about the whole study.
inline constexpr const char* kAllMethods = "all methods";

/// One thing that got worse.
struct NightlyFinding {
  std::string study = {};
  HistoryRule rule = HistoryRule::kAccuracy;
  std::string subject = {};   ///< "bearing, isomap-K6"; of the whole study: kAllMethods.
  std::string quantity = {};  ///< Quantity::id, or "memory".
  int since = 0;              ///< The nightly run in which it began, as far as can be determined.
  std::string sentence = {};  ///< With numbers.
  /// By how much the value changed as the rule estimates it (pages show the change of the median
  /// where they can, see FindingGroup): in percent of what it was, or in points of a quantity that
  /// is judged by points. Its sign is that of the value's change. Empty: results are lost, or
  /// the value was 0, so that its change has no percentage.
  std::optional<double> change = {};
};

/// Whether a finding is about a series: about its quantity, and its method at any step or all
/// methods.
bool is_about(const NightlyFinding& finding, const SeriesId& series);

/// The most severe verdict of these findings.
NightlyVerdict verdict_of(const std::vector<NightlyFinding>& findings);

/// Where and when a nightly run was made.
struct NightlyFacts {
  int number = 0;                ///< Its index in the order of nightly runs, from 1; never reused.
  std::string started_utc = {};  ///< ISO 8601. Clocks can jump: nightly runs are ordered by number.
  int utc_offset_s = 0;          ///< Of the local time then, seconds east of UTC.
  std::string ended_utc = {};
  std::string command = {};
  std::string provenance = {};  ///< JSON.
  std::string commit = {};      ///< Of what was under test, in hexadecimal digits; may be empty.
  std::string repository = {};  ///< Its address, "https://host/owner/name"; may be empty.
  std::string build = {};       ///< The command that builds it, for git bisect; may be empty.
  std::string host = {};
  std::string processor = {};  ///< "x86_64, AMD EPYC …".
  int cores = 0;
  int jobs = 0;
  std::optional<int> reference = {};  ///< The nightly run it was compared with.
  bool pinned = false;
  NightlyVerdict verdict = NightlyVerdict::kPassed;
};

/// The verdict in a word: its name, but "not compared" where nothing got worse because there was
/// nothing to compare with.
std::string_view verdict_word(const NightlyFacts& nightly_run);

/// Whether seconds of the two can be compared.
bool same_machine(const NightlyFacts& a, const NightlyFacts& b);

/// A nightly run as it is appended.
struct NightlyRun {
  NightlyFacts facts = {};
  std::vector<NightlyStudy> studies = {};
  std::vector<NightlyFinding> findings = {};
};

/// One study over the nightly runs with the same experiment, profile and seed, oldest first, this
/// nightly run last: what trends and change points are taken from.
struct StudyTrend {
  std::string name = {};
  Quantities quantities = {};
  StudyLabels labels = {};  ///< Of all these nightly runs, the last one's first.
  std::vector<NightlyFacts> nightly_runs = {};
  std::vector<double> peak_memory_mib = {};  ///< One per nightly run; NaN: not known.
  /// Medians over runs, one per nightly run; NaN: none.
  std::map<SeriesId, std::vector<double>> medians = {};
  /// Likewise the levels in which change points are searched: see level_of().
  std::map<SeriesId, std::vector<double>> levels = {};
};

/// The median of the values that are not NaN; NaN without any.
double known_median(const std::vector<RunValue>& values);

/// By how much a value changed, in percent of what it was; NaN of what was 0 or less.
double percent_change(double before, double after);

/// By how much the median of a quantity changed, as figures, tables and words of pages show it: in
/// percent, or as a difference of what is judged by points; NaN of an error that was 0 (below
/// kLeastError), whose change has no percentage.
double median_change(const Quantity& quantity, double before, double after);

/// The mean over the runs of the logarithm of a quantity that is judged by ratio, kLeastError for
/// less; of any other its mean; of a quantity that is better if higher, the negative of these. Runs
/// differ far more than nightly runs do: a median would depend on one of them. NaN without any.
double level_of(const Quantity& quantity, const std::vector<RunValue>& values);

/// Whether the errors of a level_of() were 0: a change from it has no percentage.
bool is_level_of_zero(const Quantity& quantity, double level);

/// How nightly runs judge a series: by the rule of its quantity; but a quantity that stands in for
/// another is only kept where `all`, a map by SeriesId, has the other as well.
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
