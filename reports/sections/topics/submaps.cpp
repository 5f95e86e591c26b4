#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

std::vector<MethodSetting> submap_settings(const TopicExperiment& experiment) {
  const double K = number_option(experiment, "neighbours");
  return {{Method::kSmacofKnn, K}, {Method::kIsomap, K}, {Method::kSde, K}};
}

/// "12, 16 and 20": the values of an option, times a factor.
std::string values_words(const TopicExperiment& experiment, const char* option,
                         double factor = 1.0) {
  std::vector<std::string> words;
  for (const double value : list_option(experiment, option))
    words.push_back(fmt::format("{:.4g}", factor * value));
  return all_listed(words);
}

std::string submaps_question(const TopicExperiment& experiment) {
  return fmt::format(
      "Bearings are mapped as a whole, and in overlapping groups of landmarks whose maps are "
      "joined by similarities: with groups of {1} landmarks at most, with overlaps of {2} % of "
      "groups of {0:g}, and in groups of {0:g} where {3} % of the entries, those of distant "
      "landmarks, are missing. Maps are aligned to the anchors in least squares.",
      number_option(experiment, "usual_size"), values_words(experiment, "sizes"),
      values_words(experiment, "overlaps", 100.0),
      values_words(experiment, "shares_sensor_range", 100.0));
}

/// Sub-maps compared with the whole with one method: means by level, and where chance does not
/// explain the difference.
std::string submaps_comparison(const TopicStudy& study, const TopicSetup& setup,
                               const MethodSetting& setting) {
  const std::string whole = fmt::format("whole-{}", info(setting.method).name);
  const std::string parts = fmt::format("parts-{}", info(setting.method).name);
  std::vector<std::string> levels, of_whole, of_parts, worse, better;
  for (const double level : levels_of(setup)) {
    const Condition at = condition_at(setup, level);
    const auto difference = topic_difference(study, at, parts, whole, "mpe_m");
    if (!difference) continue;
    levels.push_back(with_unit(fmt::format("{:g}", level), setup.factors.front().unit));
    of_parts.push_back(error_text(topic_mean(study, at, parts, "mpe_m")));
    of_whole.push_back(error_text(topic_mean(study, at, whole, "mpe_m")));
    if (is_apart_from_0(*difference))
      (difference->mean > 0.0 ? worse : better).push_back(levels.back());
  }
  if (levels.empty()) return "";
  const std::set<std::string> wholes(of_whole.begin(), of_whole.end());
  std::string words = fmt::format(
      "{}, {}: at {} ({}) the mean MPE of the parts joined is {}, of the whole {}", setup.title,
      label(setting), all_listed(levels), setup.factors.front().label, all_listed(of_parts),
      wholes.size() == 1 ? of_whole.front() : all_listed(of_whole));
  if (!worse.empty()) words += "; significantly worse at " + all_listed(worse);
  if (!better.empty()) words += "; significantly better at " + all_listed(better);
  if (has_few_layouts(study)) return words + few_layouts_words(study) + ".";
  return words + (worse.empty() && better.empty() ? "; no difference is significant." : ".");
}

std::vector<std::string> submaps_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  for (const TopicSetup& setup : study.design.setups)
    for (const MethodSetting& setting : submap_settings(study.experiment))
      if (std::string words = submaps_comparison(study, setup, setting); !words.empty())
        sentences.push_back(std::move(words));
  return sentences;
}

/// Of the first method and setup, at its last level.
TopicHeadline submaps_headline(const TopicStudy& study) {
  const TopicSetup& setup = study.design.setups.front();
  const MethodSetting setting = submap_settings(study.experiment).front();
  const Condition at = conditions_of(setup).back();
  const std::string name(info(setting.method).name);
  const double parts = topic_mean(study, at, "parts-" + name, "mpe_m");
  const double whole = topic_mean(study, at, "whole-" + name, "mpe_m");
  if (std::isnan(parts + whole)) return {};
  const auto difference = topic_difference(study, at, "parts-" + name, "whole-" + name, "mpe_m");
  TopicHeadline headline{
      .value = error_text(parts),
      .label = "MPE of joined sub-maps, " + level_words(setup, at),
      .detail = fmt::format("of the whole map {}; {}", error_text(whole), label(setting)),
      .quantity = "mpe_m"};
  if (difference)
    judge(headline, *difference, verdict_words(*difference) + ", compared with the whole map");
  return headline;
}

}  // namespace

const TopicWords kSubmapsWords = {.topic = "submaps",
                                  .question = submaps_question,
                                  .compared_with = "the map of all landmarks as a whole",
                                  .conclusions = submaps_conclusions,
                                  .headline = submaps_headline};

}  // namespace mapproof
