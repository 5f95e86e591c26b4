#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/words.hpp"
#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

constexpr const char* kFitTest = "slam";
constexpr const char* kReported = "reported_percent";

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
    parts.push_back(fmt::format("{:.0f} % reported and {:.0f} % with the right cause at {}",
                                topic_mean(study, at, kFitTest, kReported),
                                topic_mean(study, at, kFitTest, "named_percent"),
                                level_words(setup, at)));
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
        topic_values(study, at, kFitTest, "alarm_percent").size(),
        topic_mean(study, at, kFitTest, "alarm_percent"),
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
      alarms = topic_mean(study, at, kFitTest, "alarm_percent");
      logs = static_cast<double>(topic_values(study, at, kFitTest, "alarm_percent").size());
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

/// The share of each fault that is reported over its size, in one figure.
ResultsStudy reported_faults(const ResultsStudy& results) {
  ResultsStudy study;
  study.name = results.name;
  study.title = results.title;
  study.quantities = {kReported};
  study.quantity_labels = results.quantity_labels;
  study.factors = results.factors;
  study.results.quantities = results.results.quantities;
  study.results.are_repeats = results.results.are_repeats;
  std::set<std::string> faults;
  for (const Result& row : results.results.rows) {
    if (row.quantity != kReported || row.at.levels.empty()) continue;
    faults.insert(row.at.setup);
    Result& reported = study.results.rows.emplace_back(row);
    reported.at = {.levels = row.at.levels};
    reported.method = row.at.setup;
  }
  for (const Label& setup : results.setups)
    if (faults.contains(setup.id)) study.methods.push_back(setup);
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
