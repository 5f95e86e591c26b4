#include "core/topics/topics.hpp"

#include <algorithm>
#include <vector>

namespace mapproof {

std::span<const Topic* const> all_topics() {
  static const std::vector<const Topic*> kTopics = {
      &kUncertaintyTopic, &kChoiceTopic,  &kAssociationTopic, &kDoubtTopic,
      &kMissingTopic,     &kMixedTopic,   &kMovedTopic,       &kMrclamTopic,
      &kIncrementalTopic, &kSubmapsTopic, &kSweepTopic,       &kReferencesTopic,
  };
  return kTopics;
}

const Topic* topic_named(std::string_view name) {
  const auto topics = all_topics();
  const auto found =
      std::ranges::find_if(topics, [&](const Topic* topic) { return topic->name == name; });
  return found == topics.end() ? nullptr : *found;
}

}  // namespace mapproof
