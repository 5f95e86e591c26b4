#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

std::string association_question(const TopicExperiment& experiment) {
  return fmt::format(
      "A share of the landmark IDs is permuted: among single measurements of a step that are known "
      "to be without an ID, the same without that knowledge, or among whole rows over intervals of "
      "{:g} steps. What does mapping with the IDs as given cost, what leaving doubtful "
      "measurements out, "
      "and what is won by estimating the correspondence? Maps are of SMACOF over K = {:g} "
      "neighbours.",
      number_option(experiment, "stretch"), number_option(experiment, "neighbours"));
}

std::vector<std::string> association_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  for (const TopicSetup& setup : study.design.setups) {
    std::vector<std::string> levels, right, given, left_out, estimated;
    for (const double level : levels_of(setup)) {
      const auto mean = [&](const char* method, const char* quantity) {
        return topic_mean(study, condition_at(setup, level), method, quantity);
      };
      if (level == 0.0 || std::isnan(mean("given", "mpe_m")) ||
          std::isnan(mean("estimated", "mpe_m")))
        continue;
      levels.push_back(fmt::format("{:g}", level));
      right.push_back(fmt::format("{:.0f}", mean("estimated", "correct_percent")));
      given.push_back(error_text(mean("given", "mpe_m")));
      if (const double error = mean("left-out", "mpe_m"); !std::isnan(error))
        left_out.push_back(error_text(error));
      estimated.push_back(error_text(mean("estimated", "mpe_m")));
    }
    if (levels.empty()) continue;
    // Where it is not known which measurements are doubtful, none are left out.
    const std::string without =
        left_out.size() == levels.size()
            ? fmt::format(", {} with doubtful measurements left out", all_listed(left_out))
            : "";
    sentences.push_back(
        fmt::format("{}: of {} % of wrong landmark IDs, {} % are corrected; the mean MPE is {} "
                    "with the IDs as given{} and {} with those estimated.",
                    setup.title, all_listed(levels), all_listed(right), all_listed(given), without,
                    all_listed(estimated)));
  }
  return sentences;
}

/// Of the smallest share of wrong landmark IDs in the first setup.
TopicHeadline association_headline(const TopicStudy& study) {
  const TopicSetup& setup = study.design.setups.front();
  for (const double level : levels_of(setup)) {
    const Condition at = condition_at(setup, level);
    const double given = topic_mean(study, at, "given", "mpe_m");
    const double estimated = topic_mean(study, at, "estimated", "mpe_m");
    if (level == 0.0 || std::isnan(given + estimated)) continue;
    TopicHeadline headline{
        .value =
            fmt::format("{:.0f}\u00a0%", topic_mean(study, at, "estimated", "correct_percent")),
        .label = fmt::format("of landmark IDs corrected, where {:g}\u00a0% are wrong", level),
        .detail = fmt::format("MPE {}; {} with the IDs as given", error_text(estimated),
                              error_text(given)),
        .quantity = "correct_percent"};
    const auto difference = topic_difference(study, at, "estimated", "given", "mpe_m");
    if (!difference || has_few_layouts(*difference)) return headline;
    headline.falls_short = !is_better(*difference);
    headline.verdict =
        headline.falls_short ? "no significantly better map" : "a better map than without";
    return headline;
  }
  return {};
}

}  // namespace

const TopicWords kAssociationWords = {
    .topic = "association",
    .question = association_question,
    .compared_with = "the same scans mapped with the landmark IDs as given",
    .conclusions = association_conclusions,
    .headline = association_headline};

}  // namespace mapproof
