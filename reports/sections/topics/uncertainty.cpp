#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
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

/// The means of all methods and levels of a setup.
std::vector<double> means_of(const TopicStudy& study, const TopicSetup& setup,
                             const char* quantity) {
  std::vector<double> means;
  for (const StudiedMethod& method : study.design.methods)
    for (const Condition& at : conditions_of(setup))
      if (const double mean = topic_mean(study, at, method.id, quantity); !std::isnan(mean))
        means.push_back(mean);
  return means;
}

/// The least and the greatest; the greatest below the least of none.
std::pair<double, double> range_of(const std::vector<double>& means) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const double mean : means) {
    low = std::min(low, mean);
    high = std::max(high, mean);
  }
  return {low, high};
}

bool meets_aim(double covered_percent) {
  return covered_percent >= 93.0 && covered_percent <= 97.0;
}

/// "by none of 8 values", "by 3 of 8 values", "by all of 8 values": how many are as aimed at.
std::string meeting_words(const std::vector<double>& shares_percent) {
  const auto met = std::ranges::count_if(shares_percent, meets_aim);
  return fmt::format("by {} of {}",
                     met == 0                            ? "none"
                     : met == std::ssize(shares_percent) ? "all"
                                                         : fmt::format("{}", met),
                     counted(std::ssize(shares_percent), "value"));
}

std::vector<std::string> uncertainty_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  for (const TopicSetup& setup : study.design.setups) {
    const std::vector<double> covered = means_of(study, setup, "mean_covered_percent");
    if (covered.empty()) continue;
    const auto [low, high] = range_of(covered);
    sentences.push_back(fmt::format(
        "{}: the 95 % ellipses hold the mean of the method's own maps for {:.1f} to {:.1f} % of "
        "the landmarks, by method and level; the 93 to 97 % aimed at are met {}.",
        setup.title, low, high, meeting_words(covered)));
    const auto [ground_truth_low, ground_truth_high] =
        range_of(means_of(study, setup, "ground_truth_covered_percent"));
    const auto [bias_low, bias_high] = range_of(means_of(study, setup, "bias_m"));
    sentences.push_back(fmt::format(
        "{}: they hold the ground truth for {:.1f} to {:.1f} % of them, since the mean map itself "
        "is {} to {} off: ellipses measure random errors, not the bias of a method.",
        setup.title, ground_truth_low, ground_truth_high, error_text(bias_low),
        error_text(bias_high)));
  }
  return sentences;
}

TopicHeadline uncertainty_headline(const TopicStudy& study) {
  std::vector<double> covered;
  for (const TopicSetup& setup : study.design.setups)
    for (const double mean : means_of(study, setup, "mean_covered_percent"))
      covered.push_back(mean);
  if (covered.empty()) return {};
  const auto [low, high] = range_of(covered);
  return {fmt::format("{:.0f} to {:.0f}\u00a0%", low, high),
          "of landmarks have the method\u2019s mean map in their 95\u00a0% ellipse",
          "by method and level",
          fmt::format("the 93 to 97\u00a0% aimed at are met {}", meeting_words(covered)),
          !std::ranges::all_of(covered, meets_aim),
          "mean_covered_percent"};
}

}  // namespace

const TopicWords kUncertaintyWords = {
    .topic = "uncertainty",
    .question = uncertainty_question,
    .compared_with = "the 95\u00a0% of landmarks that the ellipses aim to cover",
    .conclusions = uncertainty_conclusions,
    .headline = uncertainty_headline};

}  // namespace mapproof
