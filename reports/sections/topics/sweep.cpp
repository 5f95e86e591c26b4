#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
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

/// "with the side of the room from 1.5 m to 4 m": from the first condition to the last.
std::string change_words(const TopicSetup& setup) {
  std::vector<std::string> words;
  for (const SetupFactor& factor : setup.factors) {
    if (factor.levels.size() < 2) continue;
    const auto level = [&](double value) {
      return with_unit(fmt::format("{:g}", value), factor.unit);
    };
    words.push_back(fmt::format("{} from {} to {}", subject_of(factor),
                                level(factor.levels.front()), level(factor.levels.back())));
  }
  return "with " + all_listed(words);
}

/// A method's mean MPE at a condition.
struct MeanAt {
  Condition at;
  double mean_m = 0.0;
};

/// Those of a method that are known, in the order of the conditions.
std::vector<MeanAt> means_of(const TopicStudy& study, const TopicSetup& setup,
                             const StudiedMethod& method) {
  std::vector<MeanAt> means;
  for (const Condition& at : conditions_of(setup))
    if (const double mean = topic_mean(study, at, method.id, "mpe_m"); !std::isnan(mean))
      means.push_back({at, mean});
  return means;
}

/// Whether no factor is lower at `after`.
bool is_beyond(const Condition& after, const Condition& before) {
  return std::ranges::equal(after.levels, before.levels, [](const Level& a, const Level& b) {
    return std::get<double>(a.value) >= std::get<double>(b.value);
  });
}

/// "grows" or "falls", if the means do wherever a factor grows and none falls; else "goes".
std::string course_word(const std::vector<MeanAt>& means) {
  bool grows = true, falls = true;
  for (const MeanAt& before : means)
    for (const MeanAt& after : means) {
      if (!is_beyond(after.at, before.at)) continue;
      grows = grows && after.mean_m >= before.mean_m;
      falls = falls && after.mean_m <= before.mean_m;
    }
  return grows ? "grows" : falls ? "falls" : "goes";
}

/// "of ISOMAP (K = 6) grows from 0.05 m to 0.1 m": a method's mean MPE from the first condition to
/// the last; empty where one of them has none.
std::string course_words(const TopicStudy& study, const TopicSetup& setup,
                         const StudiedMethod& method) {
  const std::vector<Condition> conditions = conditions_of(setup);
  const std::vector<MeanAt> means = means_of(study, setup, method);
  if (means.empty() || means.front().at != conditions.front() ||
      means.back().at != conditions.back())
    return "";
  const auto [least, greatest] = std::ranges::minmax(means, {}, &MeanAt::mean_m);
  const std::string name = bracketed(method.label), low = error_text(least.mean_m),
                    high = error_text(greatest.mean_m);
  if (low == high) return fmt::format("of {} stays at {}", name, low);
  const std::string word = course_word(means);
  return fmt::format("of {} {} from {} to {}{}", name, word, error_text(means.front().mean_m),
                     error_text(means.back().mean_m),
                     word == "goes" ? fmt::format(" (between {} and {})", low, high) : "");
}

std::vector<std::string> sweep_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  for (const TopicSetup& setup : study.design.setups) {
    std::vector<std::string> words;
    for (const StudiedMethod& method : study.design.methods)
      if (std::string course = course_words(study, setup, method); !course.empty())
        words.push_back((words.empty() ? "the mean MPE " : "that ") + course);
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
  return {.value = error_text(least) + " to " + error_text(greatest),
          .label = "mean MPE over all worlds, sensors and anchors",
          .detail = std::move(where),
          .quantity = "mpe_m"};
}

}  // namespace

const TopicWords kSweepWords = {.topic = "sweep",
                                .question = sweep_question,
                                .compared_with = "the other methods in the same worlds",
                                .conclusions = sweep_conclusions,
                                .headline = sweep_headline};

}  // namespace mapproof
