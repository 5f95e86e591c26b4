#include "core/studies/topic_studies.hpp"

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "core/experiment/seeds.hpp"
#include "core/records/experiments/profiles.hpp"
#include "core/records/studies/results_of.hpp"
#include "core/records/studies/topic_json.hpp"
#include "core/records/studies/topic_store.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/world.hpp"
#include "core/studies/experiment_changes.hpp"
#include "core/topics/topics.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

const Topic& topic_of(const TopicExperiment& experiment) {
  const Topic* topic = topic_named(experiment.topic);
  if (topic == nullptr) throw InvalidInput("no topic " + printable(experiment.topic));
  return *topic;
}

TopicPart named(TopicPart part, const std::string& id) {
  part.id = id;
  for (MethodSeconds& timing : part.seconds) timing.part = id;
  return part;
}

/// What the tasks share.
struct PlannedTopicStudy {
  ExperimentWithData input;
  TopicDesign design;
};

void add_data_tasks(const std::shared_ptr<const PlannedTopicStudy>& planned, StudyPlan& plan) {
  for (const DataSetFolder& data : planned->input.data)
    plan.tasks.push_back(
        {data.set.id,
         [=](const fs::path& folder) {
           return holds_part(folder, planned->design, data.set.id, data.set.digest);
         },
         [=] { return part_of(make_of_data(planned->input.experiment, data), data.set.digest); }});
}

void add_run_tasks(const std::shared_ptr<const PlannedTopicStudy>& planned, StudyPlan& plan) {
  const TopicExperiment& experiment = planned->input.experiment;
  for (int layout = 1; layout <= experiment.layouts; ++layout)
    for (int pose = 1; pose <= experiment.poses; ++pose) {
      const RunId run{.layout = layout, .pose = pose};
      plan.tasks.push_back(
          {slug(run),
           [=](const fs::path& folder) {
             return holds_part(folder, planned->design, slug(run), "");
           },
           [=] { return part_of(simulate_part(planned->input.experiment, run), ""); }});
    }
}

StudyPlan plan_topic_study(std::string_view text, const std::string& source,
                           const PlanOptions& options) {
  TopicExperiment experiment =
      parse_topic_experiment(text, source, input_of_topics(), options.profile);
  const bool of_data = topic_named(experiment.topic)->of_data;
  apply(of_data && options.one_of_several ? seed_alone(options.changes) : options.changes,
        experiment, of_data);
  ExperimentWithData input =
      with_data(std::move(experiment), of_data ? options.data : std::nullopt);
  TopicDesign design = planned_study(input.experiment, {}).design;
  const auto planned = std::make_shared<const PlannedTopicStudy>(
      PlannedTopicStudy{.input = std::move(input), .design = std::move(design)});
  StudyPlan plan{.name = planned->input.experiment.name,
                 .seed = planned->input.experiment.seed,
                 .layouts = planned->input.experiment.layouts,
                 .poses = planned->input.experiment.poses,
                 .uses_data = of_data,
                 .start = [=](const Provenance& made_by) {
                   return study_start(planned_study(planned->input.experiment, made_by));
                 }};
  if (of_data)
    add_data_tasks(planned, plan);
  else
    add_run_tasks(planned, plan);
  return plan;
}

bool needs_data(std::string_view text, const std::string& source) {
  return topic_named(parse_topic_experiment(text, source, input_of_topics()).topic)->of_data;
}

void read_topic_parts(const fs::path& folder, const std::string& text, const ContentsAsked& asked,
                      StudyContents& contents) {
  TopicStudy study = parse_topic_study(text, (folder / "study.json").string());
  contents.provenance = study.provenance;
  for (const TopicSetup& setup : study.design.setups) {
    contents.labels.setups[setup.id] = setup.title;
    for (const SetupFactor& factor : setup.factors)
      contents.labels.factors[factor.id] = {factor.label, factor.unit};
  }
  for (const StudiedMethod& method : study.design.methods)
    contents.labels.add_method(method.id, method.label);
  for (const fs::path& path : part_files(folder)) {
    contents.runs.set(path.stem().string(), "");
    try_file(contents, folder, path, asked, [&] {
      TopicPart part = parse_topic_part(read_file(path), path.string(), &study.design).part;
      if (part.id != path.stem().string())
        throw IoError(path.string(), "/id", "states that it is " + part.id);
      contents.runs.set(part.id, part.run ? fmt::format("layout-{}", part.run->layout) : part.id);
      if (asked.maps && asked.maps(path))
        for (const TopicMap& map : part.maps)
          contents.points[part.id + "/" + map.id] = placed(map.map);
      study.parts.push_back(std::move(part));
    });
  }
  contents.results = results_of(study);
  if (asked.seconds) contents.seconds = seconds_of(read_topic_study(folder));
}

void check_topic_experiment_file(std::string_view text, const std::string& source) {
  parse_topic_experiment(text, source, input_of_topics());
  for (const std::string& profile : profile_names(text, source, kTopicStudies.experiment))
    parse_topic_experiment(text, source, input_of_topics(), profile);
}

}  // namespace

InputOfTopic input_of_topics() {
  return [](std::string_view name) -> TopicInput {
    const Topic* topic = topic_named(name);
    if (topic == nullptr) return {};
    return {.options = &topic->options, .sweeps = topic->sweeps};
  };
}

ExperimentWithData with_data(TopicExperiment experiment,
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
  ExperimentWithData input{.experiment = std::move(experiment), .data = topic.data_sets(*folder)};
  if (input.data.empty()) throw IoError(folder->string(), "holds no data of the experiment");
  for (const DataSetFolder& data : input.data) input.experiment.data.push_back(data.set);
  return input;
}

TopicStudy planned_study(const TopicExperiment& experiment, const Provenance& provenance) {
  return {.experiment = experiment,
          .provenance = provenance,
          .design = topic_of(experiment).design(experiment),
          .parts = {}};
}

TopicPart simulate_part(const TopicExperiment& experiment, const RunId& run) {
  const auto layout = static_cast<std::uint64_t>(run.layout);
  const auto pose = static_cast<std::uint64_t>(run.pose);
  Random scatter(derive_seed(experiment.seed, {kLayout, layout}));
  Random choice(derive_seed(experiment.seed, {kPlacement, layout}));
  Random wander(derive_seed(experiment.seed, {kWalk, layout, pose}));
  const World world = scatter_landmarks(experiment.world, scatter);
  const Path path = random_walk(world, experiment.walk, experiment.steps, wander);
  const TopicTask context{
      .experiment = experiment,
      .part = slug(run),
      .run = run,
      .world = &world,
      .path = &path,
      .anchors = place_anchors(world, experiment.anchors, AnchorPlacement::kWalls, choice),
      .seed = derive_seed(experiment.seed, {kTopic, layout, pose}),
      .data = {},
      .with_maps = run == RunId{.layout = 1, .pose = 1},
  };
  TopicPart part = named(topic_of(experiment).make(context), context.part);
  part.run = run;
  return part;
}

TopicPart make_of_data(const TopicExperiment& experiment, const DataSetFolder& data) {
  const TopicTask context{
      .experiment = experiment,
      .part = data.set.id,
      .run = {},
      .world = nullptr,
      .path = nullptr,
      .anchors = {},
      .seed = derive_seed(experiment.seed, {kTopic}),
      .data = data.folder,
      .with_maps = true,
  };
  return named(topic_of(experiment).make(context), data.set.id);
}

const StudyKind kTopicStudies = {
    .study = "mapproof.topic_study",
    .title = "a study of one topic",
    .experiment = "mapproof.topic_experiment",
    .files = {{"mapproof.topic_study",
               [](auto text, auto& source) { parse_topic_study(text, source); }},
              {"mapproof.topic_experiment", check_topic_experiment_file},
              {"mapproof.topic_part",
               [](auto text, auto& source) { parse_topic_part(text, source, nullptr); }}},
    .records = {"parts"},
    .needs_data = needs_data,
    .plan = plan_topic_study,
    .start = [](auto text, auto& source) { return study_start(parse_topic_study(text, source)); },
    .read = read_topic_parts,
    .check =
        [](const fs::path& folder) { return read_topic_study(folder), std::vector<std::string>(); },
};

}  // namespace mapproof
