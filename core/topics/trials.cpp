#include "core/topics/trials.hpp"

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "core/experiment/seeds.hpp"
#include "core/records/experiments/profiles.hpp"
#include "core/records/studies/results_of.hpp"
#include "core/records/studies/trial_json.hpp"
#include "core/records/studies/trial_store.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/world.hpp"
#include "core/topics/experiment_changes.hpp"
#include "core/trials/topics.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

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

/// What the tasks share.
struct PlannedTrials {
  TrialOrder order;
  TrialDesign design;
};

void add_data_tasks(const std::shared_ptr<const PlannedTrials>& trials, StudyPlan& plan) {
  for (const TrialData& data : trials->order.data)
    plan.tasks.push_back(
        {[=](const fs::path& folder) {
           return holds_part(folder, trials->design, data.set.id, data.set.digest);
         },
         [=] { return part_of(make_of_data(trials->order.experiment, data), data.set.digest); }});
}

void add_run_tasks(const std::shared_ptr<const PlannedTrials>& trials, StudyPlan& plan) {
  const TrialExperiment& experiment = trials->order.experiment;
  for (int layout = 1; layout <= experiment.layouts; ++layout)
    for (int pose = 1; pose <= experiment.poses; ++pose) {
      const RunId run{.layout = layout, .pose = pose};
      plan.tasks.push_back(
          {[=](const fs::path& folder) {
             return holds_part(folder, trials->design, slug(run), "");
           },
           [=] { return part_of(simulate_part(trials->order.experiment, run), ""); }});
    }
}

StudyPlan plan_trials(std::string_view text, const std::string& source,
                      const PlanOptions& options) {
  TrialExperiment experiment =
      parse_trial_experiment(text, source, input_of_topics(), options.profile);
  const bool of_data = topic_named(experiment.topic)->of_data;
  apply(of_data && options.one_of_several ? seed_alone(options.changes) : options.changes,
        experiment, of_data);
  TrialOrder order = with_data(std::move(experiment), of_data ? options.data : std::nullopt);
  TrialDesign design = planned_study(order.experiment, {}).design;
  const auto trials = std::make_shared<const PlannedTrials>(
      PlannedTrials{.order = std::move(order), .design = std::move(design)});
  StudyPlan plan{.name = trials->order.experiment.name,
                 .seed = trials->order.experiment.seed,
                 .layouts = trials->order.experiment.layouts,
                 .poses = trials->order.experiment.poses,
                 .uses_data = of_data,
                 .start = [=](const Provenance& made_by) {
                   return study_start(planned_study(trials->order.experiment, made_by));
                 }};
  if (of_data)
    add_data_tasks(trials, plan);
  else
    add_run_tasks(trials, plan);
  return plan;
}

bool needs_data(std::string_view text, const std::string& source) {
  return topic_named(parse_trial_experiment(text, source, input_of_topics()).topic)->of_data;
}

void read_trials(const fs::path& folder, const std::string& text, const ContentsAsked& asked,
                 StudyContents& contents) {
  TrialStudy study = parse_trial_study(text, (folder / "study.json").string());
  contents.provenance = study.provenance;
  for (const TrialSetup& setup : study.design.setups)
    contents.labels.setups[setup.id] = setup.title;
  for (const TrialSeries& series : study.design.series)
    contents.labels.methods[series.id] = series.label;
  for (const fs::path& path : part_files(folder)) {
    contents.runs[path.stem().string()] = "";
    try_file(contents, folder, path, asked, [&] {
      TrialPart part = parse_trial_part(read_file(path), path.string(), &study.design).part;
      if (part.id != path.stem().string())
        throw IoError(path.string(), "/id", "states that it is " + part.id);
      contents.runs[part.id] = part.run ? fmt::format("layout-{}", part.run->layout) : part.id;
      if (asked.maps && asked.maps(path))
        for (const TrialMap& map : part.maps)
          contents.points[part.id + "/" + map.id] = placed(map.map);
      study.parts.push_back(std::move(part));
    });
  }
  contents.results = results_of(study);
  if (asked.seconds) contents.seconds = seconds_of(read_trial_study(folder));
}

void check_trial_experiment_file(std::string_view text, const std::string& source) {
  parse_trial_experiment(text, source, input_of_topics());
  for (const std::string& profile : profile_names(text, source, kTrialStudies.experiment))
    parse_trial_experiment(text, source, input_of_topics(), profile);
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

const StudyKind kTrialStudies = {
    .study = "mapproof.trial_study",
    .title = "a study of one topic",
    .experiment = "mapproof.trial_experiment",
    .files = {{"mapproof.trial_study",
               [](auto text, auto& source) { parse_trial_study(text, source); }},
              {"mapproof.trial_experiment", check_trial_experiment_file},
              {"mapproof.trial_part",
               [](auto text, auto& source) { parse_trial_part(text, source, nullptr); }}},
    .records = {"parts"},
    .needs_data = needs_data,
    .plan = plan_trials,
    .read = read_trials,
    .check =
        [](const fs::path& folder) { return read_trial_study(folder), std::vector<std::string>(); },
};

}  // namespace mapproof
