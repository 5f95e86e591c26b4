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
      "the step? Each run tries {:g} landmarks, one at a time.",
      number_option(experiment, "reach_m"), number_option(experiment, "tried"));
}

/// The mean of a quantity at each level that has one: "0, 50 and 100".
std::string means_text(const TopicStudy& study, const TopicSetup& setup, const char* quantity) {
  std::vector<std::string> means;
  for (const Condition& at : conditions_of(setup))
    if (const double mean = topic_mean(study, at, "permutations", quantity); !std::isnan(mean))
      means.push_back(fmt::format("{:.3g}", mean));
  return all_listed(means);
}

double greatest_mean(const TopicStudy& study, const TopicSetup& setup, const char* quantity) {
  double greatest = 0.0;
  for (const Condition& at : conditions_of(setup))
    if (const double mean = topic_mean(study, at, "permutations", quantity); mean > greatest)
      greatest = mean;
  return greatest;
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
    std::vector<std::string> levels;
    for (const double level : levels_of(setup))
      if (!std::isnan(
              topic_mean(study, condition_at(setup, level), "permutations", "named_percent")))
        levels.push_back(fmt::format("{:g}", level));
    if (levels.empty()) continue;
    const SetupFactor& factor = setup.factors.front();
    sentences.push_back(fmt::format(
        "{}: at {} {} the moved landmark is named in {} % of the logs, another one in {:.3g} % at "
        "most; the step is {:.0f} steps off on average at most.",
        setup.title, all_listed(levels),
        factor.unit.empty() ? "(" + factor.label + ")" : factor.unit,
        means_text(study, setup, "named_percent"), greatest_mean(study, setup, "false_percent"),
        greatest_mean(study, setup, "step_error")));
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
          "of moved landmarks named, " + level_words(setup, at), "",
          std::isnan(still)
              ? std::string()
              : fmt::format("{:.1f}\u00a0% named where nothing moves, {:.0f}\u00a0% aimed at",
                            still, kLevel),
          still > kLevel};
}

}  // namespace

const TopicWords kMovedWords = {.topic = "moved",
                                .question = moved_question,
                                .conclusions = moved_conclusions,
                                .headline = moved_headline};

}  // namespace mapproof
