#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/results/results_conventions.hpp"
#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

/// Series that are not criteria.
constexpr const char* kRandomPick = "random";
constexpr const char* kFixedMethod = "fixed";

std::string choice_question(const TopicExperiment&) {
  return "All methods with several parameters map the same observations. How much worse than the "
         "best of these maps is the one that a criterion picks without the ground truth? "
         "With anchors it judges maps fitted to them, and is judged by their MPE. Without anchors "
         "it judges the shapes alone, and is judged by the MPE with the affine map fitted on all "
         "landmarks.";
}

/// The mean of a quantity over all setups and levels.
double mean_over_all(const TopicStudy& study, std::string_view method, const char* quantity) {
  double sum = 0.0;
  int count = 0;
  for (const Condition& at : all_conditions(study))
    for (const double value : topic_values(study, at, method, quantity)) {
      sum += value;
      ++count;
    }
  return count > 0 ? sum / count : kNaN;
}

struct BestCriterion {
  std::string id = {};  ///< Empty: none has a value.
  std::string label = {};
  double regret_m = HUGE_VAL;
};

BestCriterion best_criterion(const TopicStudy& study, const char* quantity) {
  BestCriterion best;
  for (const StudiedMethod& method : study.design.methods) {
    const double regret = mean_over_all(study, method.id, quantity);
    if (std::isnan(regret)) continue;
    if (method.id == kRandomPick || method.id == kFixedMethod || regret >= best.regret_m) continue;
    best = {method.id, method.label, regret};
  }
  return best;
}

std::string choice_sentence(const TopicStudy& study, const char* quantity, const char* when) {
  const BestCriterion best = best_criterion(study, quantity);
  return fmt::format(
      "{}, over all sensors and numbers of steps, the criterion with the lowest mean regret is {}: "
      "its pick is {} worse than the best map on average; a fixed method is {} worse and a random "
      "pick {}{}.",
      when, in_sentence(best.label), regret_text(best.regret_m),
      regret_text(mean_over_all(study, kFixedMethod, quantity)),
      regret_text(mean_over_all(study, kRandomPick, quantity)),
      has_few_layouts(study) ? fmt::format("; too few runs to rank the criteria, in {}",
                                           counted(layouts_of(study), "layout"))
                             : "");
}

std::vector<std::string> choice_conclusions(const TopicStudy& study) {
  return {choice_sentence(study, "regret_m", "With anchors"),
          choice_sentence(study, "regret_shape_m", "Without anchors")};
}

TopicHeadline choice_headline(const TopicStudy& study) {
  const BestCriterion best = best_criterion(study, "regret_m");
  if (best.id.empty()) return {};
  const auto [value, words] = regret_words(best.regret_m);
  TopicHeadline headline{
      .value = value,
      .label = fmt::format("{} the best map: the map that a criterion picks", words),
      .detail = "by " + in_sentence(best.label),
      .quantity = "regret_m"};
  const auto difference =
      topic_difference(study, all_conditions(study), best.id, kFixedMethod, "regret_m");
  if (!difference) return headline;
  const std::string fixed = regret_text(mean_over_all(study, kFixedMethod, "regret_m"));
  if (has_few_layouts(*difference)) {
    headline.detail += fmt::format("; a fixed method: {}; {}", fixed, verdict_words(*difference));
    return headline;
  }
  headline.falls_short = !is_better(*difference);
  headline.verdict =
      fmt::format("{} than a fixed method, {} (95 % interval of the difference: {} to {})",
                  headline.falls_short ? "not significantly better" : "better", fixed,
                  error_text(difference->mean - *difference->half_width),
                  error_text(difference->mean + *difference->half_width));
  return headline;
}

}  // namespace

const TopicWords kChoiceWords = {.topic = "choice",
                                 .question = choice_question,
                                 .compared_with = "the best map of each outcome and a fixed method",
                                 .conclusions = choice_conclusions,
                                 .headline = choice_headline};

}  // namespace mapproof
