#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "reports/sections/trials/topic_words.hpp"
#include "reports/sections/trials/trial_means.hpp"

namespace mapproof {
namespace {

std::string sweep_question(const TrialExperiment& experiment) {
  return fmt::format(
      "How do errors of maps depend on the world, the sensor and the anchors? One factor or two "
      "change at a time; otherwise {} landmarks of {:g} m stand in a room of {:g} m, {} of them "
      "anchors, and are observed {} times. Levels share their random numbers as far as they can, "
      "so that differences between them are paired.",
      experiment.world.landmarks, experiment.world.landmark_diameter_m, experiment.world.side_m,
      experiment.anchors, experiment.steps);
}

/// "from 0.05 to 0.1 m with ISOMAP": a series' mean MPE at the first and the last condition.
std::string ends_words(const TrialStudy& study, const TrialSetup& setup,
                       const TrialSeries& series) {
  const std::vector<Condition> conditions = conditions_of(setup);
  const double first = trial_mean(study, conditions.front(), series.id, "mpe_m");
  const double last = trial_mean(study, conditions.back(), series.id, "mpe_m");
  if (std::isnan(first) || std::isnan(last)) return "";
  return fmt::format("from {:.3g} to {:.3g} m with {}", first, last, series.label);
}

std::vector<std::string> sweep_conclusions(const TrialStudy& study) {
  std::vector<std::string> sentences;
  for (const TrialSetup& setup : study.design.setups) {
    std::vector<std::string> words;
    for (const TrialSeries& series : study.design.series)
      if (std::string ends = ends_words(study, setup, series); !ends.empty())
        words.push_back(std::move(ends));
    const std::vector<Condition> conditions = conditions_of(setup);
    if (words.empty() || conditions.size() < 2) continue;
    sentences.push_back(fmt::format("{}: between {} and {}, the mean MPE goes {}.", setup.title,
                                    level_words(setup, conditions.front()),
                                    level_words(setup, conditions.back()), all_listed(words)));
  }
  return sentences;
}

}  // namespace

const TopicWords kSweepWords = {
    .topic = "sweep", .question = sweep_question, .conclusions = sweep_conclusions};

}  // namespace mapproof
