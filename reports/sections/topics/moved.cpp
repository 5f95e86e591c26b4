#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

std::string moved_question(const TopicExperiment& experiment) {
  return fmt::format(
      "Landmarks are seen with range and bearing from up to {:g} m. One of them is at another "
      "position from a random step in the middle half on. Is it named, is another one named, and "
      "how far off is "
      "the step? Each simulated run tries {:g} landmarks, one at a time.",
      number_option(experiment, "reach_m"), number_option(experiment, "tried"));
}

/// The levels of a setup at which a landmark moved.
std::vector<double> levels_with_move(const TopicStudy& study, const TopicSetup& setup) {
  std::vector<double> levels = levels_of(setup);
  std::erase_if(levels, [&](double level) {
    return std::isnan(
        topic_mean(study, condition_at(setup, level), "permutations", "named_percent"));
  });
  return levels;
}

/// The means of a quantity at these levels that have one.
std::vector<double> means_at(const TopicStudy& study, const TopicSetup& setup,
                             const std::vector<double>& levels, const char* quantity) {
  std::vector<double> means;
  for (const double level : levels)
    if (const double mean = topic_mean(study, condition_at(setup, level), "permutations", quantity);
        !std::isnan(mean))
      means.push_back(mean);
  return means;
}

/// "0, 50 and 100".
std::string numbers_text(const std::vector<double>& numbers) {
  std::vector<std::string> words;
  for (const double number : numbers) words.push_back(fmt::format("{:.3g}", number));
  return all_listed(words);
}

/// 0 of none.
double greatest_of(const std::vector<double>& numbers) {
  return numbers.empty() ? 0.0 : std::ranges::max(numbers);
}

/// How often a landmark is named where nothing moves; NaN if that was not tried.
double named_without_move(const TopicStudy& study) {
  return topic_mean(study, condition("distance", {{"moved_m", 0.0}}), "permutations",
                    "false_percent");
}

std::vector<std::string> moved_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  const double still = named_without_move(study);
  if (!std::isnan(still))
    sentences.push_back(fmt::format(
        "Where nothing moves, a landmark is named in {:.3g} % of the logs; the level is 5 %.",
        still));
  for (const TopicSetup& setup : study.design.setups) {
    const std::vector<double> levels = levels_with_move(study, setup);
    if (levels.empty()) continue;
    const auto means = [&](const char* quantity) {
      return means_at(study, setup, levels, quantity);
    };
    std::vector<std::string> level_texts;
    for (const double level : levels) level_texts.push_back(fmt::format("{:g}", level));
    const SetupFactor& factor = setup.factors.front();
    sentences.push_back(fmt::format(
        "{}: at {} {} the moved landmark is named in {} % of the logs, another one in {:.3g} % at "
        "most; the step is {:.0f} steps off on average at most.",
        setup.title, all_listed(level_texts),
        factor.unit.empty() ? "(" + factor.label + ")" : factor.unit,
        numbers_text(means("named_percent")), greatest_of(means("false_percent")),
        greatest_of(means("step_error"))));
  }
  return sentences;
}

/// Of the longest move of the first setup.
TopicHeadline moved_headline(const TopicStudy& study) {
  const TopicSetup& setup = study.design.setups.front();
  const Condition at = conditions_of(setup).back();
  const double named = topic_mean(study, at, "permutations", "named_percent");
  if (std::isnan(named)) return {};
  const double still = named_without_move(study);
  constexpr double kLevel = 5.0;  // Percent.
  return {fmt::format("{:.0f}\u00a0%", named),
          "of moved landmarks named, " + level_words(setup, at),
          "",
          std::isnan(still)
              ? std::string()
              : fmt::format("{:.1f}\u00a0% named where nothing moves, {:.0f}\u00a0% aimed at",
                            still, kLevel),
          still > kLevel,
          "named_percent"};
}

}  // namespace

const TopicWords kMovedWords = {
    .topic = "moved",
    .question = moved_question,
    .compared_with = "the landmarks that were moved, and worlds where nothing moves",
    .conclusions = moved_conclusions,
    .headline = moved_headline};

}  // namespace mapproof
