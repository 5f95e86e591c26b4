#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/topic_study.hpp"
#include "core/results/results_study.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {

/// What a topic came to in one number, with what it is compared with.
struct TopicHeadline {
  std::string value;   ///< "89 %"; empty: there is none.
  std::string label;   ///< "of wrong landmark IDs corrected".
  std::string detail;  ///< "mean MPE 0.086 m; 0.125 m with the IDs as given".
  /// Whether that is as it should be: "fewer errors than with the IDs as given"; empty: nothing is
  /// aimed at.
  std::string verdict = {};
  bool falls_short = false;
  std::string quantity = {};  ///< Of the design, that the value is of: its figure comes first.
};

/// Judges a headline by a tested difference, which falls short if it is worse. Of too few layouts
/// it is not judged, and its detail ends with why.
/// @param verdict  What the test found, in words.
void judge(TopicHeadline& headline, const MeanEstimate& difference, std::string verdict);

/// By how much a mean error is larger than that of the best map, the same on tiles and in
/// sentences: "0.022 m", "< 0.001 m", "0 m".
std::string regret_text(double regret_m);

/// The same with the words that follow it on a tile: {"0.022 m", "worse than"}, {"< 0.001 m",
/// "worse than"}, {"equal", "to"}.
struct RegretWords {
  std::string value;
  std::string_view words;
};
RegretWords regret_words(double regret_m);

/// The words of a topic (core/topics/topic.hpp).
struct TopicWords {
  std::string_view topic;  ///< In files: "missing".
  /// What is asked and how it is tried, two or three sentences.
  std::string (*question)(const TopicExperiment& experiment) = nullptr;
  std::string_view compared_with = {};  ///< What its maps are judged against, within a sentence.
  /// What came out, with numbers, a sentence each.
  std::vector<std::string> (*conclusions)(const TopicStudy& study) = nullptr;
  TopicHeadline (*headline)(const TopicStudy& study) = nullptr;
  /// What the headline's value is the mean of, as a study of one setup and quantity, from the
  /// results of all; null: the figure of its quantity shows it.
  ResultsStudy (*evidence)(const ResultsStudy& results) = nullptr;
  /// What is wrong with the data or the maps, a sentence each; null: nothing is looked for.
  std::vector<std::string> (*warnings)(const TopicStudy& study) = nullptr;
};

extern const TopicWords kUncertaintyWords, kChoiceWords, kAssociationWords, kDoubtWords,
    kMissingWords, kMixedWords, kMovedWords, kMrclamWords, kIncrementalWords, kSubmapsWords,
    kSweepWords, kReferencesWords;

/// Of every topic, in their order.
std::span<const TopicWords* const> all_topic_words();

/// Empty of a topic that is not known.
std::string question_of(const TopicExperiment& experiment);

/// Empty of a topic that is not known.
std::string_view compared_with_of(const TopicExperiment& experiment);

/// None of a topic that is not known, or without any part.
std::vector<std::string> conclusions_of(const TopicStudy& study);

/// None of a topic that looks for nothing.
std::vector<std::string> warnings_of(const TopicStudy& study);

/// TopicWords::evidence of the study's topic; without a quantity if it has none.
ResultsStudy evidence_of(const TopicStudy& study, const ResultsStudy& results);

/// Without a value for a topic that is not known, or without any part.
TopicHeadline headline_of(const TopicStudy& study);

}  // namespace mapproof
