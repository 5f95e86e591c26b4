#include "app/study_order.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "app/build_facts.hpp"
#include "app/study_run.hpp"
#include "app/trial_outputs.hpp"
#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/base/sha256.hpp"
#include "core/records/experiment_json.hpp"
#include "core/records/results_study_json.hpp"
#include "core/records/run_json.hpp"
#include "core/records/slam_experiment_json.hpp"
#include "core/records/slam_run_json.hpp"
#include "core/records/slam_store.hpp"
#include "core/records/study_store.hpp"
#include "core/records/trial_experiment_json.hpp"
#include "core/records/trial_json.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kFull = "full";

/// The profile asked for; "" where it may be missing and is.
std::string profile_of(const OrderOptions& options, const std::vector<std::string>& known) {
  const bool is_there = std::ranges::find(known, options.profile) != known.end();
  const bool may_be_missing = options.profile_if_there || options.profile == kFull;
  return is_there || !may_be_missing ? options.profile : "";
}

ExperimentChanges seed_alone(const ExperimentChanges& changes) {
  return {.seed = changes.seed, .layouts = std::nullopt, .poses = std::nullopt};
}

LoggedSlam read_slam(const ExperimentText& file, const OrderOptions& options) {
  const std::string profile = profile_of(options, slam_profiles(file.text, file.source));
  LoggedSlam slam{.experiment = parse_slam_experiment(file.text, file.source, profile), .data = {}};
  apply(options.one_of_several ? seed_alone(options.changes) : options.changes, slam.experiment);
  slam.data = read_slam_data(slam.experiment, options.plaza);
  return slam;
}

TrialOrder read_trials(const ExperimentText& file, const OrderOptions& options) {
  const std::string profile = profile_of(options, trial_profiles(file.text, file.source));
  TrialExperiment experiment =
      parse_trial_experiment(file.text, file.source, input_of_topics(), profile);
  const bool of_data = topic_named(experiment.topic)->of_data;
  apply(of_data && options.one_of_several ? seed_alone(options.changes) : options.changes,
        experiment, of_data);
  return with_data(std::move(experiment), of_data ? options.data : std::nullopt);
}

Experiment read_mapping(const ExperimentText& file, const OrderOptions& options) {
  const std::string profile = profile_of(options, profiles(file.text, file.source));
  Experiment experiment = parse_experiment(file.text, file.source, profile);
  apply(options.changes, experiment);
  return experiment;
}

template <typename Simulated>
void put_changes(std::vector<std::string>& words, const ExperimentChanges& changes,
                 const Simulated& experiment) {
  if (changes.layouts) words.insert(words.end(), {"--layouts", std::to_string(experiment.layouts)});
  if (changes.poses) words.insert(words.end(), {"--poses", std::to_string(experiment.poses)});
}

std::uint64_t seed_of(const StudyOrder& order) {
  if (const auto* slam = std::get_if<LoggedSlam>(&order.experiment)) return slam->experiment.seed;
  if (const auto* trials = std::get_if<TrialOrder>(&order.experiment))
    return trials->experiment.seed;
  if (std::holds_alternative<GivenStudy>(order.experiment)) return 0;
  return std::get<Experiment>(order.experiment).seed;
}

void copy_study(const std::filesystem::path& from, const std::filesystem::path& to) {
  for (const std::filesystem::path& file : results_study_files(from))
    write_file(to / file, read_file(from / file));
}

}  // namespace

void add_data_options(CLI::App& app, OrderOptions& options) {
  app.add_option("--plaza", options.plaza, "Folder of the Plaza data, for experiments on them")
      ->check(CLI::ExistingDirectory);
  app.add_option("--data", options.data,
                 "Folder of data sets, or of one, for experiments made of them (mrclam)")
      ->check(CLI::ExistingDirectory);
}

StudyOrder read_study_order(const ExperimentText& file, const OrderOptions& options) {
  StudyOrder order{
      .name = {}, .digest = sha256_hex(options.profile + "\n" + file.text), .experiment = {}};
  if (is_slam_experiment(file.text, file.source)) {
    LoggedSlam slam = read_slam(file, options);
    order.name = slam.experiment.name;
    order.experiment = std::move(slam);
  } else if (is_trial_experiment(file.text, file.source)) {
    TrialOrder trials = read_trials(file, options);
    order.name = trials.experiment.name;
    order.experiment = std::move(trials);
  } else {
    Experiment experiment = read_mapping(file, options);
    order.name = experiment.name;
    order.experiment = std::move(experiment);
  }
  return order;
}

StudyOrder given_study_order(const std::filesystem::path& folder) {
  StudyOrder order{
      .name = read_results_study(folder).name, .digest = {}, .experiment = GivenStudy{folder}};
  std::string texts;
  for (const std::filesystem::path& file : results_study_files(folder))
    texts += file.string() + "\n" + read_file(folder / file);
  order.digest = sha256_hex(texts);
  return order;
}

bool is_made_of_data(const ExperimentText& file) {
  if (!is_trial_experiment(file.text, file.source)) return false;
  const TrialExperiment experiment =
      parse_trial_experiment(file.text, file.source, input_of_topics());
  return topic_named(experiment.topic)->of_data;
}

void check_data_used(std::span<const StudyOrder> orders, const OrderOptions& options) {
  const auto uses_plaza = [](const StudyOrder& order) {
    return std::holds_alternative<LoggedSlam>(order.experiment);
  };
  const auto uses_data = [](const StudyOrder& order) {
    const auto* trials = std::get_if<TrialOrder>(&order.experiment);
    return trials != nullptr && !trials->data.empty();
  };
  const auto refuse = [&](std::string_view option) {
    throw InvalidInput(fmt::format(
        "{}: {} uses no such data", option,
        orders.size() == 1 ? "the experiment " + orders.front().name : "none of the experiments"));
  };
  if (options.plaza && std::ranges::none_of(orders, uses_plaza)) refuse("--plaza");
  if (options.data && std::ranges::none_of(orders, uses_data)) refuse("--data");
}

std::vector<std::string> words_of(std::span<const StudyOrder> orders, const OrderOptions& options) {
  std::vector<std::string> words;
  if (!options.profile.empty()) words.insert(words.end(), {"--profile", options.profile});
  // Studies of several experiments have a seed each.
  if (orders.size() == 1 || options.changes.seed)
    words.insert(words.end(), {"--seed", std::to_string(seed_of(orders.front()))});
  for (const StudyOrder& order : orders) {
    const std::size_t before = words.size();
    if (const auto* experiment = std::get_if<Experiment>(&order.experiment))
      put_changes(words, options.changes, *experiment);
    else if (const auto* trials = std::get_if<TrialOrder>(&order.experiment))
      put_changes(words, options.changes, trials->experiment);
    if (words.size() > before) break;
  }
  if (options.plaza) words.insert(words.end(), {"--plaza", *options.plaza});
  if (options.data) words.insert(words.end(), {"--data", *options.data});
  return words;
}

std::string study_json(const StudyOrder& order) {
  const Provenance provenance = build_provenance();
  if (const auto* slam = std::get_if<LoggedSlam>(&order.experiment))
    return slam_study_json(slam->experiment, provenance);
  if (const auto* trials = std::get_if<TrialOrder>(&order.experiment))
    return trial_study_json(planned_study(trials->experiment, provenance));
  if (const auto* given = std::get_if<GivenStudy>(&order.experiment))
    return read_file(given->folder / "study.json");
  return study_json(std::get<Experiment>(order.experiment), provenance);
}

void make_study(const StudyOrder& order, const std::filesystem::path& folder, int jobs,
                const std::string& command, const Console& console) {
  if (const auto* slam = std::get_if<LoggedSlam>(&order.experiment))
    make_slam_records(slam->experiment, slam->data, folder, jobs, command, console);
  else if (const auto* trials = std::get_if<TrialOrder>(&order.experiment))
    make_trial_records(*trials, folder, jobs, command, console);
  else if (const auto* given = std::get_if<GivenStudy>(&order.experiment))
    copy_study(given->folder, folder);
  else
    make_records(std::get<Experiment>(order.experiment), folder, jobs, command, console);
}

StudyNumbers read_study_numbers(const std::filesystem::path& folder) {
  if (is_slam_study(folder)) {
    const SlamStudy study = read_slam_study(folder);
    return {.text = slam_study_text(study),
            .object = slam_study_result(study),
            .missing = study.missing};
  }
  if (is_trial_study(folder)) {
    const TrialStudy study = read_concluded_study(folder);
    return {.text = trial_study_text(study), .object = trial_study_result(study), .missing = {}};
  }
  const Study study = read_study(folder);
  return {.text = study_text(study), .object = study_result(study), .missing = {}};
}

}  // namespace mapproof
