#include "reports/sections/topics/topic_text.hpp"

#include <gtest/gtest.h>

#include "core/topics/topic.hpp"
#include "core/topics/topics.hpp"

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

TEST(TopicWords, AreNoneOfATopicThatIsNotKnown) {
  TopicStudy study;
  study.experiment.topic = "weather";
  study.parts.emplace_back();
  EXPECT_EQ(question_of(study.experiment), "");
  EXPECT_TRUE(conclusions_of(study).empty());
}

}  // namespace
}  // namespace mapproof
