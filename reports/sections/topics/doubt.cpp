#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/words.hpp"
#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

constexpr const char* kFitTest = "slam";
constexpr const char* kReported = "reported_percent";
constexpr const char* kAlarm = "alarm_percent";

std::string doubt_question(const TopicExperiment& experiment) {
  return fmt::format(
      "Simulated drives with single ranges to four to seven landmarks have noise from a third to "
      "three times the usual one, and in every other drive errors that hang together in time. One "
      "fault is put into a copy of each, at {}. Does the test of the fit report it, is its cause "
      "the right one, and how often is there an alarm without any fault? The landmarks' constant "
      "offsets have a standard deviation of {:g} m.",
      counted(std::ssize(list_option(experiment, "sizes_percent")), "size"),
      number_option(experiment, "offset_sigma_m"));
}

std::string fault_sentence(const TopicStudy& study, const TopicSetup& setup) {
  std::vector<std::string> parts;
  for (const Condition& at : conditions_of(setup)) {
    const std::vector<double> reported = topic_values(study, at, kFitTest, kReported);
    if (reported.empty()) continue;
    std::string part = fmt::format("{:.0f} % reported and {:.0f} % with the right cause",
                                   topic_mean(study, at, kFitTest, kReported),
                                   topic_mean(study, at, kFitTest, "named_percent"));
    // All faults have the same sizes: the page names a single one once.
    if (levels_of(setup).size() > 1) part += " at " + level_words(setup, at);
    parts.push_back(std::move(part));
  }
  if (parts.empty()) return "";
  return fmt::format("{}: {}.", setup.title, all_listed(parts));
}

std::vector<std::string> doubt_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  for (const TopicSetup& setup : study.design.setups) {
    if (!setup.factors.empty()) {
      if (std::string sentence = fault_sentence(study, setup); !sentence.empty())
        sentences.push_back(std::move(sentence));
      continue;
    }
    const Condition at = condition_at(setup, 0.0);
    sentences.push_back(fmt::format(
        "Of {} fault-free logs {:.3g} % have an alarm, and of {:.3g} % the verdict is that they do "
        "not fit. Of those that fit, {:.3g} % of the landmarks lie in their 95 % ellipse; the mean "
        "squared error over its variance is {:.2f}, where 2 is right.",
        topic_values(study, at, kFitTest, kAlarm).size(), topic_mean(study, at, kFitTest, kAlarm),
        topic_mean(study, at, kFitTest, "denied_percent"),
        topic_mean(study, at, kFitTest, "inside_percent"),
        topic_mean(study, at, kFitTest, "nees")));
  }
  return sentences;
}

/// Over all faults and sizes.
TopicHeadline doubt_headline(const TopicStudy& study) {
  double sum = 0.0, count = 0.0, alarms = 0.0, logs = 0.0;
  for (const TopicSetup& setup : study.design.setups) {
    if (setup.factors.empty()) {
      const Condition at = condition_at(setup, 0.0);
      alarms = topic_mean(study, at, kFitTest, kAlarm);
      logs = static_cast<double>(topic_values(study, at, kFitTest, kAlarm).size());
      continue;
    }
    for (const Condition& at : conditions_of(setup))
      for (const double reported : topic_values(study, at, kFitTest, kReported))
        sum += reported, count += 1.0;
  }
  if (count == 0.0) return {};
  std::string detail;
  if (logs > 0.0)
    detail = fmt::format("alarms in {:.3g}\u00a0% of {:g} fault-free logs", alarms, logs);
  constexpr double kMostAlarms = 5.0;  // Percent, the level of the test.
  const bool is_over = alarms > kMostAlarms;
  return {fmt::format("{:.0f}\u00a0%", sum / count),
          "of faults in range-only logs reported",
          std::move(detail),
          logs == 0.0 ? ""
          : is_over   ? "more alarms than the 5\u00a0% aimed at"
                      : "no more alarms than the 5\u00a0% aimed at",
          is_over,
          kReported};
}

/// A name of the setup that has room beside a row or a curve; sections have its whole title.
std::string short_title(const Label& setup) {
  constexpr std::array<std::pair<std::string_view, const char*>, 9> kShort = {
      {{"common-offset", "Common offset of ranges"},
       {"landmark-offset", "Offset of one landmark"},
       {"late-clock", "Late clock"},
       {"clock-jump", "Jump of the clock"},
       {"moved-landmark", "Moved landmark"},
       {"exchanged-ids", "Exchanged IDs"},
       {"odometry-gap", "Gap of odometry"},
       {"odometry-frozen", "Frozen odometry"},
       {"fault-free", "No fault (false alarms)"}}};
  const auto* const known =
      std::ranges::find(kShort, setup.id, &std::pair<std::string_view, const char*>::first);
  return known == kShort.end() ? setup.label : known->second;
}

/// The sizes of faults in a study, as levels of a condition.
std::set<std::vector<Level>> sizes_in(const ResultsStudy& results) {
  std::set<std::vector<Level>> sizes;
  for (const Result& row : results.results.rows)
    if (row.quantity == kReported && !row.at.levels.empty()) sizes.insert(row.at.levels);
  return sizes;
}

/// The share of each fault that is reported at each size, in one figure, and that of alarms without
/// any fault, which has no size and is the same beside all.
ResultsStudy reported_faults(const ResultsStudy& results) {
  ResultsStudy study;
  study.name = results.name;
  study.title = results.title;
  study.quantities = {kReported};
  study.quantity_labels = {{kReported, "Share of logs with a fault reported"}};
  study.factors = results.factors;
  study.results.quantities = results.results.quantities;
  study.results.are_repeats = results.results.are_repeats;
  const std::set<std::vector<Level>> sizes = sizes_in(results);
  std::set<std::string> shown;
  const auto add = [&](const Result& row, const std::vector<Level>& size) {
    shown.insert(row.at.setup);
    Result& reported = study.results.rows.emplace_back(row);
    reported.at = {.levels = size};
    reported.method = row.at.setup;
    reported.quantity = kReported;
  };
  for (const Result& row : results.results.rows) {
    if (row.quantity == kReported && !row.at.levels.empty()) add(row, row.at.levels);
    if (row.quantity == kAlarm)
      for (const std::vector<Level>& size : sizes) add(row, size);
  }
  for (const Label& setup : results.setups)
    if (shown.contains(setup.id)) study.methods.push_back({setup.id, short_title(setup)});
  // Below the faults that it is compared with.
  std::ranges::stable_partition(study.methods,
                                [](const Label& method) { return method.id != "fault-free"; });
  sort_results(study.results);
  complete(study);
  return study;
}

}  // namespace

const TopicWords kDoubtWords = {
    .topic = "doubt",
    .question = doubt_question,
    .compared_with = "the known faults of the logs, and logs without faults",
    .conclusions = doubt_conclusions,
    .headline = doubt_headline,
    .evidence = reported_faults};

}  // namespace mapproof
