#include "reports/sections/topics/topic_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/text/number_text.hpp"
#include "reports/sections/topics/topic_means.hpp"

namespace mapproof {
namespace {

const TopicWords* words_of(std::string_view topic) {
  const auto all = all_topic_words();
  const auto found = std::ranges::find(all, topic, &TopicWords::topic);
  return found == all.end() ? nullptr : *found;
}

}  // namespace

std::span<const TopicWords* const> all_topic_words() {
  static constexpr const TopicWords* kAll[] = {
      &kUncertaintyWords, &kChoiceWords,  &kAssociationWords, &kDoubtWords,
      &kMissingWords,     &kMixedWords,   &kMovedWords,       &kMrclamWords,
      &kIncrementalWords, &kSubmapsWords, &kSweepWords,       &kReferencesWords};
  return kAll;
}

void judge(TopicHeadline& headline, const MeanEstimate& difference, std::string verdict) {
  if (has_few_layouts(difference)) {
    headline.detail += (headline.detail.empty() ? "" : "; ") + verdict_words(difference);
    return;
  }
  headline.verdict = std::move(verdict);
  headline.falls_short = is_apart_from_0(difference) && difference.mean > 0.0;
}

std::string regret_text(double regret_m) {
  constexpr double kLeast_m = 0.001;  // Less makes no difference.
  return regret_m != 0.0 && std::abs(regret_m) < kLeast_m ? "< 0.001\u00a0m" : error_text(regret_m);
}

RegretWords regret_words(double regret_m) {
  if (regret_m == 0.0) return {"equal", "to"};
  return {regret_text(regret_m), "worse than"};
}

std::string question_of(const TopicExperiment& experiment) {
  const TopicWords* words = words_of(experiment.topic);
  return words == nullptr ? "" : words->question(experiment);
}

std::string_view compared_with_of(const TopicExperiment& experiment) {
  const TopicWords* words = words_of(experiment.topic);
  return words == nullptr ? std::string_view() : words->compared_with;
}

std::vector<std::string> conclusions_of(const TopicStudy& study) {
  const TopicWords* words = words_of(study.experiment.topic);
  return words == nullptr || study.parts.empty() ? std::vector<std::string>()
                                                 : words->conclusions(study);
}

std::vector<std::string> warnings_of(const TopicStudy& study) {
  const TopicWords* words = words_of(study.experiment.topic);
  return words == nullptr || words->warnings == nullptr ? std::vector<std::string>{}
                                                        : words->warnings(study);
}

ResultsStudy evidence_of(const TopicStudy& study, const ResultsStudy& results) {
  const TopicWords* words = words_of(study.experiment.topic);
  return words == nullptr || words->evidence == nullptr ? ResultsStudy{} : words->evidence(results);
}

TopicHeadline headline_of(const TopicStudy& study) {
  const TopicWords* words = words_of(study.experiment.topic);
  const bool knows = words != nullptr && words->headline != nullptr && !study.parts.empty();
  return knows ? words->headline(study) : TopicHeadline{};
}

}  // namespace mapproof
