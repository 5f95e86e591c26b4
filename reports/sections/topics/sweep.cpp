#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/topics/topic_text.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

std::string sweep_question(const TopicExperiment& experiment) {
  return fmt::format(
      "How do errors of maps depend on the world, the sensor and the anchors? One factor or two "
      "change at a time. Otherwise {} landmarks of {:g} m stand in a room of {:g} m, {} of them "
      "anchors, and are observed {} times. Levels share their random numbers as far as they can, "
      "so that differences between them are paired.",
      experiment.world.landmarks, experiment.world.landmark_diameter_m, experiment.world.side_m,
      experiment.anchors, experiment.steps);
}

/// "the side of the room", "the number of landmarks": a factor as what grows.
std::string subject_of(const SetupFactor& factor) {
  return (factor.unit.empty() ? "the number of " : "the ") + factor.label;
}

/// "as the side of the room goes from 1.5 m to 4 m": from the first condition to the last.
std::string change_words(const TopicSetup& setup) {
  std::vector<std::string> words;
  for (const SetupFactor& factor : setup.factors) {
    if (factor.levels.size() < 2) continue;
    const auto level = [&](double value) {
      return with_unit(fmt::format("{:g}", value), factor.unit);
    };
    words.push_back(fmt::format("{}{} from {} to {}", subject_of(factor),
                                words.empty() ? " goes" : "", level(factor.levels.front()),
                                level(factor.levels.back())));
  }
  return "as " + all_listed(words);
}

/// "of ISOMAP (K = 6) grows from 0.05 m to 0.1 m": a method's mean MPE at the first and the last
/// condition; empty where one of them has none.
std::string ends_words(const TopicStudy& study, const TopicSetup& setup,
                       const StudiedMethod& method) {
  const std::vector<Condition> conditions = conditions_of(setup);
  const double first = topic_mean(study, conditions.front(), method.id, "mpe_m");
  const double last = topic_mean(study, conditions.back(), method.id, "mpe_m");
  if (std::isnan(first) || std::isnan(last)) return "";
  const auto metres = [](double value) { return error_text(value); };
  if (metres(first) == metres(last))
    return fmt::format("of {} stays at {}", bracketed(method.label), metres(first));
  return fmt::format("of {} {} from {} to {}", bracketed(method.label),
                     last > first ? "grows" : "falls", metres(first), metres(last));
}

std::vector<std::string> sweep_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  for (const TopicSetup& setup : study.design.setups) {
    std::vector<std::string> words;
    for (const StudiedMethod& method : study.design.methods)
      if (std::string ends = ends_words(study, setup, method); !ends.empty())
        words.push_back((words.empty() ? "the mean MPE " : "that ") + ends);
    const std::vector<Condition> conditions = conditions_of(setup);
    if (words.empty() || conditions.size() < 2) continue;
    sentences.push_back(
        fmt::format("{}: {}, {}.", setup.title, change_words(setup), all_listed(words)));
  }
  return sentences;
}

/// The least and the greatest mean over all conditions.
TopicHeadline sweep_headline(const TopicStudy& study) {
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  std::string where;
  for (const TopicSetup& setup : study.design.setups)
    for (const Condition& at : conditions_of(setup))
      for (const StudiedMethod& method : study.design.methods) {
        const double mean = topic_mean(study, at, method.id, "mpe_m");
        if (std::isnan(mean)) continue;
        least = std::min(least, mean);
        if (mean <= greatest) continue;
        greatest = mean;
        where = fmt::format("greatest by {}, {}", bracketed(method.label), level_words(setup, at));
      }
  if (least > greatest) return {};
  return {error_text(least) + " to " + error_text(greatest),
          "mean MPE over all worlds, sensors and anchors", std::move(where)};
}

}  // namespace

const TopicWords kSweepWords = {.topic = "sweep",
                                .question = sweep_question,
                                .conclusions = sweep_conclusions,
                                .headline = sweep_headline};

}  // namespace mapproof
