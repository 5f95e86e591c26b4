#include "reports/sections/topics/topic_text.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/not_finite.hpp"
#include "core/records/studies/results_of.hpp"
#include "core/topics/topic.hpp"
#include "core/topics/topics.hpp"
#include "reports/sections/results/topic_records.hpp"
#include "reports/sections/topics/topic_means.hpp"

namespace mapproof {
namespace {

TEST(TopicWords, AreThoseOfEveryTopic) {
  std::vector<std::string_view> with_words, topics;
  for (const TopicWords* words : all_topic_words()) with_words.push_back(words->topic);
  for (const Topic* topic : all_topics()) topics.push_back(topic->name);
  EXPECT_EQ(with_words, topics);
}

TEST(TopicWords, HaveConclusionsAndAHeadlineOfEveryTopic) {
  for (const TopicWords* words : all_topic_words()) {
    EXPECT_NE(words->conclusions, nullptr) << words->topic;
    EXPECT_NE(words->headline, nullptr) << words->topic;
  }
}

TEST(TopicWords, SayWhatEveryTopicIsComparedWith) {
  for (const Topic* topic : all_topics()) {
    TopicExperiment experiment;
    experiment.topic = topic->name;
    const std::string_view words = compared_with_of(experiment);
    EXPECT_FALSE(words.empty()) << topic->name;
    EXPECT_FALSE(words.ends_with('.')) << topic->name;  // The page adds it.
  }
}

TEST(TopicWords, AskAQuestionOfEveryTopic) {
  for (const Topic* topic : all_topics()) {
    TopicExperiment experiment;
    experiment.topic = topic->name;
    for (const TopicOption& option : topic->options)
      experiment.options[std::string(option.name)] = option.usual;
    EXPECT_GT(question_of(experiment).size(), 40U) << topic->name;
  }
}

TEST(TopicWords, SayEqualOrLessThanThePrecisionInPlaceOfNoMetres) {
  EXPECT_EQ(regret_words(0.0).value, "equal");
  EXPECT_EQ(regret_words(0.0).words, "to");
  EXPECT_EQ(regret_words(0.0004).value, "< 0.001\u00a0m");
  EXPECT_EQ(regret_words(0.0012).value, "0.00120 m");
  EXPECT_EQ(regret_words(0.022).words, "worse than");
}

TopicStudy empty_study(const Topic& topic) {
  TopicStudy study;
  study.experiment.topic = topic.name;
  for (const TopicOption& option : topic.options)
    study.experiment.options[std::string(option.name)] = option.usual;
  study.design = topic.design(study.experiment);
  return study;
}

/// A study of layouts that have the same means at every level: by the method's id, of one quantity.
/// Each layout's are a little larger than those of the one before.
TopicStudy study_of(const Topic& topic, int layouts, const std::string& quantity,
                    const std::vector<std::pair<std::string, double>>& means) {
  TopicStudy study = empty_study(topic);
  for (int layout = 1; layout <= layouts; ++layout) {
    TopicPart& part = study.parts.emplace_back();
    part.run = RunId{layout, 1};
    part.id = slug(*part.run);
    for (const TopicSetup& setup : study.design.setups)
      for (const Condition& at : conditions_of(setup))
        for (const auto& [method, mean] : means)
          part.outcomes.push_back({.at = at,
                                   .method = method,
                                   .values = {{quantity, mean * (1.0 + 0.01 * layout)}},
                                   .statuses = {}});
  }
  return study;
}

TEST(TopicWords, HaveOneTextOfARegretOnTheTileAndInTheSentence) {
  EXPECT_EQ(regret_text(0.0), "0 m");
  EXPECT_EQ(regret_text(0.0004), "< 0.001\u00a0m");
  const TopicStudy study =
      study_of(kMissingTopic, 1, "mpe_m",
               {{"auto", 0.1004}, {"pairwise-complete-smacof-knn", 0.1}, {"ppca-smacof-knn", 0.2}});
  const TopicHeadline headline = headline_of(study);
  EXPECT_EQ(headline.value, "< 0.001\u00a0m");
  EXPECT_TRUE(headline.detail.starts_with("always pairwise-complete 0 m, always PPCA 0.101 m"))
      << headline.detail;
  EXPECT_NE(conclusions_of(study).at(0).find("costs < 0.001\u00a0m of MPE"), std::string::npos)
      << conclusions_of(study)[0];
}

TEST(TopicWords, OfFewLayoutsJudgeNoHeadlineByADifference) {
  struct Case {
    const Topic& topic;
    std::string quantity, better, other;
  };
  const std::string few = "too few runs to test the difference, in 2 layouts";
  for (const Case& one : {Case{kSubmapsTopic, "mpe_m", "parts-smacof-knn", "whole-smacof-knn"},
                          Case{kReferencesTopic, "mpe_m", "landmark-isomap-K8", "isomap-K8"},
                          Case{kMixedTopic, "mpe_m", "joint", "bearing"},
                          Case{kMissingTopic, "mpe_m", "auto", "pairwise-complete-smacof-knn"},
                          Case{kChoiceTopic, "regret_m", "trustworthiness", "fixed"}}) {
    const auto headline = [&](int layouts, double mean) {
      return headline_of(
          study_of(one.topic, layouts, one.quantity, {{one.better, mean}, {one.other, 0.2}}));
    };
    const TopicHeadline of_few = headline(2, 0.1);
    EXPECT_EQ(of_few.verdict, "") << one.topic.name;
    EXPECT_FALSE(of_few.falls_short) << one.topic.name;
    EXPECT_TRUE(of_few.detail.ends_with(few)) << of_few.detail;
    EXPECT_EQ(of_few.detail.find("better"), std::string::npos) << of_few.detail;
    EXPECT_TRUE(headline(5, 0.1).verdict.starts_with("better")) << headline(5, 0.1).verdict;
    EXPECT_TRUE(headline(5, 0.3).falls_short) << one.topic.name;
  }
}

TEST(TopicWords, OfAChoiceGiveTheIntervalOfItsDifferenceFromAFixedMethod) {
  // Layouts 1 to 5 have differences of 0.101 m to 0.105 m: 0.103 m and t of 2.776 times their
  // error.
  const TopicHeadline headline = headline_of(
      study_of(kChoiceTopic, 5, "regret_m", {{"trustworthiness", 0.1}, {"fixed", 0.2}}));
  EXPECT_EQ(
      headline.verdict,
      "better than a fixed method, 0.206 m (95 % interval of the difference: \u22120.105 m to "
      "\u22120.101 m)");
}

TEST(TopicWords, OfMissingDataJudgeTheStrategyByTheBetterOfTheOthers) {
  const auto verdict = [](double advised_m, int layouts) {
    return headline_of(study_of(kMissingTopic, layouts, "mpe_m",
                                {{"auto", advised_m},
                                 {"pairwise-complete-smacof-knn", 0.3},
                                 {"ppca-smacof-knn", 0.2}}))
        .verdict;
  };
  EXPECT_EQ(verdict(0.25, 5), "worse, compared with always PPCA");
  EXPECT_EQ(verdict(0.2, 5), "not significantly different, compared with always PPCA");
  EXPECT_EQ(verdict(0.25, 4), "");
  const TopicStudy study = study_of(kMissingTopic, 4, "mpe_m", {{"ppca-smacof-knn", 0.2}});
  EXPECT_TRUE(conclusions_of(study).at(0).ends_with("in 4 layouts.")) << conclusions_of(study)[0];
}

TEST(TopicWords, NameTheQuantityOfEveryHeadline) {
  for (const Topic* topic : all_topics()) {
    if (topic->of_data || topic->sweeps) continue;
    TopicStudy study = empty_study(*topic);
    TopicPart& part = study.parts.emplace_back();
    for (const Condition& at : all_conditions(study))
      for (const StudiedMethod& method : study.design.methods) {
        TopicOutcome& outcome = part.outcomes.emplace_back();
        outcome.at = at;
        outcome.method = method.id;
        for (const Quantity& quantity : study.design.quantities) outcome.values[quantity.id] = 50.0;
      }
    const TopicHeadline headline = headline_of(study);
    EXPECT_FALSE(headline.value.empty()) << topic->name;
    EXPECT_NE(std::ranges::find(study.design.quantities, headline.quantity, &Quantity::id),
              study.design.quantities.end())
        << topic->name << ": " << headline.quantity;
  }
}

/// All values of a curve over the panels of a figure.
std::vector<double> values_of(const Figure& figure, const std::string& label) {
  std::vector<double> values;
  for (const Panel& panel : figure.panels)
    for (const Layer& layer : panel.layers)
      if (const auto* line = std::get_if<Polyline>(&layer); line != nullptr && line->label == label)
        values.insert(values.end(), line->y.begin(), line->y.end());
  return values;
}

TEST(TopicEvidence, IsWhatTheHeadlineOfMissingDataIsTheMeanOf) {
  const TopicStudy study =
      study_of(kMissingTopic, 5, "mpe_m",
               {{"auto", 0.25}, {"pairwise-complete-smacof-knn", 0.3}, {"ppca-smacof-knn", 0.2}});
  const ResultsStudy results = labelled_results(study);
  const auto label_of = [&](const char* id) {
    return std::ranges::find(results.methods, id, &Label::id)->label;
  };
  const FigureGroup group = topic_evidence(study, results, headline_of(study));
  ASSERT_EQ(group.figures.size(), 1U);
  const Figure& figure = group.figures.front();
  EXPECT_EQ(figure.title, "0.0515 m worse than the best map: the strategy chosen for missing data");
  EXPECT_EQ(figure.panels.size(), study.design.setups.size());
  const std::vector<double> chosen = values_of(figure, label_of("auto"));
  EXPECT_EQ(chosen.size(), all_conditions(study).size());
  for (const double value : chosen) EXPECT_NEAR(value, 0.0515, 1e-9);
  for (const double value : values_of(figure, label_of("ppca-smacof-knn"))) EXPECT_EQ(value, 0.0);
}

TEST(TopicEvidence, OfFaultsIsTheShareOfEachThatIsReported) {
  TopicStudy study = study_of(kDoubtTopic, 5, "reported_percent", {{"slam", 50.0}});
  for (TopicPart& part : study.parts)
    for (TopicOutcome& outcome : part.outcomes)
      if (outcome.at.setup == Name("late-clock")) outcome.values["reported_percent"] = 90.0;
  const TopicHeadline headline = headline_of(study);
  const FigureGroup group = topic_evidence(study, labelled_results(study), headline);
  ASSERT_EQ(group.figures.size(), 1U);
  EXPECT_EQ(group.figures.front().title, headline.value + " of faults in range-only logs reported");
  const std::vector<double> late = values_of(group.figures.front(), "Late clock");
  EXPECT_EQ(late.size(), list_option(study.experiment, "sizes_percent").size());
  for (const double value : late) EXPECT_EQ(value, 90.0);
}

/// Drives on each of which all faults of one size are reported, and an alarm on the first without
/// any fault.
TopicStudy study_of_one_size(int layouts) {
  TopicStudy study;
  study.experiment = empty_study(kDoubtTopic).experiment;
  study.experiment.options["sizes_percent"] = {100.0};
  study.design = kDoubtTopic.design(study.experiment);
  for (int layout = 1; layout <= layouts; ++layout) {
    TopicPart& part = study.parts.emplace_back();
    part.run = RunId{layout, 1};
    part.id = slug(*part.run);
    for (const TopicSetup& setup : study.design.setups) {
      TopicOutcome& outcome = part.outcomes.emplace_back();
      outcome.at = conditions_of(setup).front();
      outcome.method = "slam";
      outcome.values =
          setup.factors.empty()
              ? std::map<std::string, double>{{"alarm_percent", layout == 1 ? 100.0 : 0.0}}
              : std::map<std::string, double>{{"reported_percent", 100.0}, {"named_percent", 0.0}};
    }
  }
  return study;
}

TEST(TopicWords, OfFaultsOfOneSizeDoNotRepeatIt) {
  const std::vector<std::string> sentences = conclusions_of(study_of_one_size(2));
  EXPECT_EQ(sentences.back(),
            "Odometry at a standstill for 60 s: 100 % reported and 0 % with the right cause.");
}

TEST(TopicEvidence, OfFaultsOfOneSizeIsADotForEachAndForTheFalseAlarms) {
  for (const int layouts : {2, 10}) {
    const TopicStudy study = study_of_one_size(layouts);
    const FigureGroup group = topic_evidence(study, labelled_results(study), headline_of(study));
    ASSERT_EQ(group.figures.size(), 1U);
    ASSERT_EQ(group.figures[0].panels.size(), 1U);
    const Panel& panel = group.figures[0].panels[0];
    ASSERT_EQ(panel.y.names.size(), 9U);
    EXPECT_EQ(panel.y.names.front(), "No fault (false alarms)");
    EXPECT_EQ(panel.y.names.back(), "Common offset of ranges") << "in the order of the sections";
    double alarms = kNaN, interval_end = kNaN;
    std::size_t circles = 0;
    for (const Layer& layer : panel.layers) {
      if (const auto* bar = std::get_if<Segments>(&layer); bar != nullptr && bar->y0[0] == 0.0)
        interval_end = bar->x1[0];
      const auto* dots = std::get_if<Scatter>(&layer);
      if (dots == nullptr || dots->y[0] != 0.0) continue;
      if (dots->filled)
        alarms = dots->x[0];
      else
        circles += dots->x.size();
    }
    EXPECT_DOUBLE_EQ(alarms, 100.0 / layouts);
    EXPECT_EQ(circles, layouts == 2 ? 2U : 0U) << "few runs are points";
    EXPECT_EQ(interval_end > alarms, layouts == 10) << "more have an interval";
  }
}

TEST(TopicEvidence, IsNoneWhereTheFigureOfTheQuantityIsEnough) {
  const TopicStudy study =
      study_of(kSubmapsTopic, 5, "mpe_m", {{"parts-smacof-knn", 0.2}, {"whole-smacof-knn", 0.1}});
  EXPECT_TRUE(topic_evidence(study, labelled_results(study), headline_of(study)).empty());
}

TEST(TopicWords, OfMovedLandmarksNameOthersAtTheSameLevelsAlone) {
  TopicStudy study = empty_study(kMovedTopic);
  TopicPart& part = study.parts.emplace_back();
  const auto add = [&](double by_m, std::map<std::string, double> values) {
    part.outcomes.push_back({.at = condition("distance", {{"moved_m", by_m}}),
                             .method = "permutations",
                             .values = std::move(values),
                             .statuses = {}});
  };
  add(0.0, {{"false_percent", 16.7}});
  add(0.1, {{"false_percent", 2.0}, {"named_percent", 66.7}, {"step_error", 4.0}});
  const std::vector<std::string> sentences = conclusions_of(study);
  ASSERT_EQ(sentences.size(), 2U);
  EXPECT_NE(sentences[0].find("16.7 %"), std::string::npos) << sentences[0];
  EXPECT_NE(sentences[1].find("at 0.1 m the moved landmark is named in 66.7 % of the logs, another "
                              "one in 2 % at most"),
            std::string::npos)
      << sentences[1];
}

TEST(TopicWords, OfUncertaintyCountTheMeansThatAreAsAimedAt) {
  const auto sentence = [](double first, double second) {
    TopicStudy study = study_of(kUncertaintyTopic, 1, "mean_covered_percent",
                                {{"lpca", first / 1.01}, {"smacof", second / 1.01}});
    return conclusions_of(study).at(0);
  };
  // Two methods at two levels.
  EXPECT_NE(sentence(98.0, 99.0).find("aimed at are met by none of 4 values."), std::string::npos)
      << sentence(98.0, 99.0);
  EXPECT_NE(sentence(95.0, 99.0).find("met by 2 of 4 values."), std::string::npos);
  EXPECT_NE(sentence(95.0, 96.0).find("met by all of 4 values."), std::string::npos);
}

TEST(TopicWords, OfFaultsCountTheirSizes) {
  TopicExperiment experiment = empty_study(kDoubtTopic).experiment;
  EXPECT_NE(question_of(experiment).find("at 5 sizes."), std::string::npos);
  experiment.options["sizes_percent"] = {100.0};
  EXPECT_NE(question_of(experiment).find("at 1 size."), std::string::npos);
}

TEST(TopicWords, OfDataAssociationStateWhatLeavingMeasurementsOutGives) {
  TopicStudy study = study_of(kAssociationTopic, 1, "mpe_m",
                              {{"given", 0.3}, {"left-out", 0.2}, {"estimated", 0.1}});
  const std::string sentence = conclusions_of(study).at(0);
  for (const char* words : {"0.303 m with the IDs as given, 0.202 m",
                            "0.202 m with doubtful measurements left out and 0.101 m"})
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
  for (TopicPart& part : study.parts)
    std::erase_if(part.outcomes,
                  [](const TopicOutcome& outcome) { return outcome.method == "left-out"; });
  EXPECT_EQ(conclusions_of(study).at(0).find("left out"), std::string::npos);
}

TEST(TopicWords, OfSubmapsNameTheSizesAndShares) {
  TopicExperiment experiment = empty_study(kSubmapsTopic).experiment;
  experiment.options["sizes"] = {16.0, 30.0};
  experiment.options["overlaps"] = {0.2, 0.35};
  experiment.options["shares_sensor_range"] = {0.89};
  const std::string question = question_of(experiment);
  for (const char* words : {"with groups of 16 and 30 landmarks at most", "overlaps of 20 and 35 %",
                            "where 89 % of the entries"})
    EXPECT_NE(question.find(words), std::string::npos) << question;
}

TEST(TopicWords, OfReferencesSayFromWhichMapsTheyDiffer) {
  const TopicStudy study =
      study_of(kReferencesTopic, 1, "mpe_m", {{"landmark-isomap-K8", 0.1}, {"isomap-K8", 0.1}});
  EXPECT_NE(conclusions_of(study).at(0).find("differ from those of ISOMAP by"), std::string::npos)
      << conclusions_of(study).at(0);
}

TEST(TopicWords, AreNoneOfATopicThatIsNotKnown) {
  TopicStudy study;
  study.experiment.topic = "weather";
  study.parts.emplace_back();
  EXPECT_EQ(question_of(study.experiment), "");
  EXPECT_TRUE(conclusions_of(study).empty());
}

}  // namespace
}  // namespace mapproof
