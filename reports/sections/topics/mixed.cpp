#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/topics/topic_text.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

constexpr const char* kSingles[] = {"visibility",       "bearing",       "range",
                                    "visibility-order", "bearing-order", "range-order"};
constexpr const char* kMixes[] = {"equal", "reliable", "joint"};

std::string mixed_question(const TopicExperiment&) {
  return fmt::format(
      "Is one map of several sensors better than that of the best of them? Singly, visibility is "
      "mapped by {}, bearing and range by {}. Together, they are mapped by the mean of their "
      "distances, with equal weights or with weights by how far both halves of the steps agree. "
      "The joint map trusts each sensor's distances in their order alone, and its way is tried on "
      "each sensor alone, too.",
      label({Method::kIsomap, 6.0}), label({Method::kSmacofKnn, 8.0}));
}

/// The method of least mean MPE among some, and that mean; null if none has one.
struct BestSeries {
  const StudiedMethod* method = nullptr;
  double mean_m = HUGE_VAL;
};

template <typename Names>
BestSeries best_series(const TopicStudy& study, const Condition& at, const Names& names) {
  BestSeries best;
  for (const StudiedMethod& method : study.design.methods) {
    if (std::ranges::find(names, method.id) == std::end(names)) continue;
    const double mean = topic_mean(study, at, method.id, "mpe_m");
    if (mean < best.mean_m) best = {&method, mean};
  }
  return best;
}

/// "at noise of bearings 20° the mean MPE is 0.012 m by joint map and 0.013 m by range alone
/// (better)"; of too few layouts without the verdict.
std::string mixed_words_at(const TopicStudy& study, const TopicSetup& setup, const Condition& at) {
  const BestSeries single = best_series(study, at, kSingles);
  const BestSeries mix = best_series(study, at, kMixes);
  if (single.method == nullptr || mix.method == nullptr) return "";
  const auto difference = topic_difference(study, at, mix.method->id, single.method->id, "mpe_m");
  const std::string verdict = difference ? verdict_words(*difference) : "no run has both";
  return fmt::format("at {} the mean MPE is {} by {} and {} by {}{}", level_words(setup, at),
                     error_text(mix.mean_m), bracketed(mix.method->label),
                     error_text(single.mean_m), bracketed(single.method->label),
                     has_few_layouts(study) ? "" : " (" + verdict + ")");
}

/// What it costs to take the map that keeps most neighbourhoods: its MPE less that of the best map,
/// and the joint map's less that, means over the parts.
std::string choice_words(const TopicStudy& study, const TopicSetup& setup) {
  double picked = 0.0, joint = 0.0, count = 0.0;
  for (const TopicPart& part : study.parts)
    for (const Condition& at : conditions_of(setup)) {
      const TopicOutcome* pick = nullptr;
      double best_m = HUGE_VAL, joint_m = kNaN;
      for (const TopicOutcome& outcome : part.outcomes) {
        if (outcome.at != at || !std::isfinite(topic_value(outcome, "mpe_m"))) continue;
        if (pick == nullptr ||
            topic_value(outcome, "continuity") > topic_value(*pick, "continuity"))
          pick = &outcome;
        best_m = std::min(best_m, topic_value(outcome, "mpe_m"));
        if (outcome.method == "joint") joint_m = topic_value(outcome, "mpe_m");
      }
      if (pick == nullptr || std::isnan(joint_m)) continue;
      picked += topic_value(*pick, "mpe_m") - best_m, joint += joint_m - best_m, count += 1.0;
    }
  if (count == 0.0) return "";
  return fmt::format(
      "{}: the map that keeps most neighbourhoods of all sensors has an MPE {} above the "
      "best map's, the joint map one of {} above it.",
      setup.title, error_text(picked / count), error_text(joint / count));
}

std::vector<std::string> mixed_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  for (const TopicSetup& setup : study.design.setups) {
    const std::vector<Condition> conditions = conditions_of(setup);
    std::vector<std::string> ends = {mixed_words_at(study, setup, conditions.front())};
    if (conditions.size() > 1) ends.push_back(mixed_words_at(study, setup, conditions.back()));
    std::erase(ends, "");
    if (!ends.empty())
      sentences.push_back(
          fmt::format("{}: the best map of several sensors compared with the best of one sensor: "
                      "{}{}.",
                      setup.title, fmt::join(ends, "; "), few_layouts_words(study)));
  }
  for (const TopicSetup& setup : study.design.setups)
    if (std::string words = choice_words(study, setup); !words.empty())
      sentences.push_back(std::move(words));
  return sentences;
}

/// At the last level of the first setup that has maps of several sensors and of one.
TopicHeadline mixed_headline(const TopicStudy& study) {
  for (const TopicSetup& setup : study.design.setups) {
    const Condition at = conditions_of(setup).back();
    const BestSeries single = best_series(study, at, kSingles);
    const BestSeries mix = best_series(study, at, kMixes);
    if (single.method == nullptr || mix.method == nullptr) continue;
    const auto difference = topic_difference(study, at, mix.method->id, single.method->id, "mpe_m");
    TopicHeadline headline{.value = error_text(mix.mean_m),
                           .label = "MPE of several sensors together, " + level_words(setup, at),
                           .detail = {},
                           .quantity = "mpe_m"};
    const std::string alone = "the best sensor alone";
    if (!difference || has_few_layouts(*difference)) {
      headline.detail = fmt::format("{} {}", alone, error_text(single.mean_m));
      if (difference) headline.detail += "; " + verdict_words(*difference);
      return headline;
    }
    headline.falls_short = !is_better(*difference);
    headline.verdict = fmt::format(
        "{} than {}, {}",
        is_apart_from_0(*difference) ? verdict_words(*difference) : "not significantly better",
        alone, error_text(single.mean_m));
    return headline;
  }
  return {};
}

}  // namespace

const TopicWords kMixedWords = {.topic = "mixed",
                                .question = mixed_question,
                                .compared_with = "the best sensor alone",
                                .conclusions = mixed_conclusions,
                                .headline = mixed_headline};

}  // namespace mapproof
