#include <algorithm>
#include <vector>

#include "core/trials/certainty.hpp"
#include "core/trials/choice.hpp"
#include "core/trials/labels.hpp"
#include "core/trials/missing.hpp"
#include "core/trials/mixed.hpp"
#include "core/trials/moved.hpp"
#include "core/trials/mrclam.hpp"
#include "core/trials/online.hpp"
#include "core/trials/submaps.hpp"
#include "core/trials/sweep.hpp"
#include "core/trials/topic.hpp"

namespace mapproof {

std::span<const Topic* const> all_topics() {
  static const std::vector<const Topic*> kTopics = {
      &kCertaintyTopic, &kChoiceTopic, &kLabelsTopic, &kMissingTopic, &kMixedTopic,
      &kMovedTopic,     &kMrclamTopic, &kOnlineTopic, &kSubmapsTopic, &kSweepTopic,
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
