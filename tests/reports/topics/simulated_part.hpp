#pragma once

#include <utility>
#include <vector>

#include "core/base/random.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/world.hpp"
#include "core/topics/topic.hpp"

namespace mapproof::test {

/// What a topic makes of one simulated world and walk of the experiment, always the same one.
inline TopicPart simulated_part(const Topic& topic, const TopicExperiment& experiment,
                                std::vector<Eigen::Index> anchors) {
  Random random(9);
  const World world = scatter_landmarks(experiment.world, random);
  const Path path = random_walk(world, experiment.walk, experiment.steps, random);
  return topic.make({.experiment = experiment,
                     .part = "layout-1-pose-1",
                     .run = {},
                     .world = &world,
                     .path = &path,
                     .anchors = std::move(anchors),
                     .seed = 5,
                     .data = {},
                     .with_maps = true});
}

/// A study of that part alone.
inline TopicStudy simulated_study(const Topic& topic, const TopicExperiment& experiment,
                                  std::vector<Eigen::Index> anchors) {
  TopicStudy study;
  study.experiment = experiment;
  study.design = topic.design(experiment);
  study.parts = {simulated_part(topic, experiment, std::move(anchors))};
  return study;
}

}  // namespace mapproof::test
