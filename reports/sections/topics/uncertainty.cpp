#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

std::string uncertainty_question(const TopicExperiment& experiment) {
  return fmt::format(
      "In each layout {:g} walks are mapped. The mean of these maps is what a method tends to. Of "
      "{:g} of them ellipses are drawn by the bootstrap, each from its own walk alone. Of the "
      "landmarks that are not anchors, how many have that mean in their 95 % ellipse, and how many "
      "the ground truth?",
      number_option(experiment, "walks"), number_option(experiment, "tried"));
}

/// The least and the greatest of means over all methods and levels of a setup.
std::pair<double, double> range_of(const TopicStudy& study, const TopicSetup& setup,
                                   const char* quantity) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const StudiedMethod& method : study.design.methods)
    for (const Condition& at : conditions_of(setup)) {
      const double mean = topic_mean(study, at, method.id, quantity);
      if (std::isnan(mean)) continue;
      low = std::min(low, mean);
      high = std::max(high, mean);
    }
  return {low, high};
}

std::vector<std::string> uncertainty_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  for (const TopicSetup& setup : study.design.setups) {
    const auto [low, high] = range_of(study, setup, "mean_covered_percent");
    if (low > high) continue;
    sentences.push_back(fmt::format(
        "{}: the 95 % ellipses hold the mean of the method's own maps for {:.1f} to {:.1f} % of "
        "the landmarks, by method and level; the 93 to 97 % aimed at are {}.",
        setup.title, low, high, low >= 93.0 && high <= 97.0 ? "met by all" : "not met by all"));
    const auto [ground_truth_low, ground_truth_high] =
        range_of(study, setup, "ground_truth_covered_percent");
    const auto [bias_low, bias_high] = range_of(study, setup, "bias_m");
    sentences.push_back(fmt::format(
        "{}: they hold the ground truth for {:.1f} to {:.1f} % of them, since the mean map itself "
        "is {} to {} off: ellipses measure random errors, not the bias of a method.",
        setup.title, ground_truth_low, ground_truth_high, error_text(bias_low),
        error_text(bias_high)));
  }
  return sentences;
}

TopicHeadline uncertainty_headline(const TopicStudy& study) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const TopicSetup& setup : study.design.setups) {
    const auto [least, most] = range_of(study, setup, "mean_covered_percent");
    low = std::min(low, least);
    high = std::max(high, most);
  }
  if (low > high) return {};
  return {fmt::format("{:.0f} to {:.0f}\u00a0%", low, high),
          "of landmarks have the method\u2019s mean map in their 95\u00a0% ellipse",
          "by method and level",
          low >= 93.0 && high <= 97.0 ? "within the 93 to 97\u00a0% aimed at"
                                      : "not within the 93 to 97\u00a0% aimed at",
          !(low >= 93.0 && high <= 97.0)};
}

}  // namespace

const TopicWords kUncertaintyWords = {.topic = "uncertainty",
                                      .question = uncertainty_question,
                                      .conclusions = uncertainty_conclusions,
                                      .headline = uncertainty_headline};

}  // namespace mapproof
