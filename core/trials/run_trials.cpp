#include "core/trials/run_trials.hpp"

#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/experiment/seeds.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/world.hpp"

namespace mapproof {
namespace {

const Topic& topic_of(const TrialExperiment& experiment) {
  const Topic* topic = topic_named(experiment.topic);
  if (topic == nullptr) throw InvalidInput("no topic " + printable(experiment.topic));
  return *topic;
}

TrialPart named(TrialPart part, const std::string& id) {
  part.id = id;
  for (TrialSeconds& timing : part.seconds) timing.part = id;
  return part;
}

}  // namespace

InputOfTopic input_of_topics() {
  return [](std::string_view name) -> TopicInput {
    const Topic* topic = topic_named(name);
    if (topic == nullptr) return {};
    return {.options = &topic->options, .sweeps = topic->sweeps};
  };
}

TrialOrder with_data(TrialExperiment experiment,
                     const std::optional<std::filesystem::path>& folder) {
  const Topic& topic = topic_of(experiment);
  if (!topic.of_data) {
    if (folder)
      throw InvalidInput(
          fmt::format("--data: the experiment {} uses no data from outside", experiment.name));
    return {.experiment = std::move(experiment), .data = {}};
  }
  if (!folder)
    throw InvalidInput(fmt::format(
        "the experiment {} is made of data: give their folder by --data DIR", experiment.name));
  TrialOrder order{.experiment = std::move(experiment), .data = topic.data_sets(*folder)};
  if (order.data.empty()) throw IoError(folder->string(), "holds no data of the experiment");
  for (const TrialData& data : order.data) order.experiment.data.push_back(data.set);
  return order;
}

TrialStudy planned_study(const TrialExperiment& experiment, const Provenance& provenance) {
  return {.experiment = experiment,
          .provenance = provenance,
          .design = topic_of(experiment).design(experiment),
          .parts = {}};
}

TrialPart simulate_part(const TrialExperiment& experiment, const RunId& run) {
  const auto layout = static_cast<std::uint64_t>(run.layout);
  const auto pose = static_cast<std::uint64_t>(run.pose);
  Random scatter(derive_seed(experiment.seed, {kLayout, layout}));
  Random choice(derive_seed(experiment.seed, {kPlacement, layout}));
  Random wander(derive_seed(experiment.seed, {kWalk, layout, pose}));
  const World world = scatter_landmarks(experiment.world, scatter);
  const Path path = random_walk(world, experiment.walk, experiment.steps, wander);
  const TrialContext context{
      .experiment = experiment,
      .part = slug(run),
      .run = run,
      .world = &world,
      .path = &path,
      .anchors = place_anchors(world, experiment.anchors, AnchorPlacement::kWalls, choice),
      .seed = derive_seed(experiment.seed, {kTrial, layout, pose}),
      .data = {},
      .with_maps = run == RunId{.layout = 1, .pose = 1},
  };
  TrialPart part = named(topic_of(experiment).make(context), context.part);
  part.run = run;
  return part;
}

TrialPart make_of_data(const TrialExperiment& experiment, const TrialData& data) {
  const TrialContext context{
      .experiment = experiment,
      .part = data.set.id,
      .run = {},
      .world = nullptr,
      .path = nullptr,
      .anchors = {},
      .seed = derive_seed(experiment.seed, {kTrial}),
      .data = data.folder,
      .with_maps = true,
  };
  return named(topic_of(experiment).make(context), data.set.id);
}

}  // namespace mapproof
