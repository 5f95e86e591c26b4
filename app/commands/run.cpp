#include <memory>

#include "app/commands/verbs.hpp"
#include "app/study_run.hpp"
#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/records/experiment_json.hpp"
#include "core/records/slam_experiment_json.hpp"
#include "core/records/slam_store.hpp"
#include "core/records/study_store.hpp"

namespace mapproof {
namespace {

struct Arguments {
  std::string experiment;
  std::string out;
  std::string profile;
  int jobs = 1;
  ExperimentChanges changes;
  std::optional<std::string> plaza;
};

/// The two commands that make the same study and a report of it, wherever they are typed.
/// @param changes  Words that change the experiment.
std::string command_again(const Arguments& arguments, const std::vector<std::string>& changes) {
  std::vector<std::string> words = {"mapproof", "run", arguments.experiment};
  if (!arguments.profile.empty()) words.insert(words.end(), {"--profile", arguments.profile});
  words.insert(words.end(), changes.begin(), changes.end());
  if (arguments.plaza) words.insert(words.end(), {"--plaza", *arguments.plaza});
  words.insert(words.end(), {"--out", arguments.out});
  return quoted_command(words) + " && " + quoted_command({"mapproof", "report", arguments.out});
}

int run_slam(const Arguments& arguments, const std::string& text, const Invocation& invocation) {
  SlamExperiment experiment = parse_slam_experiment(text, arguments.experiment, arguments.profile);
  apply(arguments.changes, experiment);
  const SlamData data = read_slam_data(experiment, arguments.plaza);
  make_slam_records(experiment, data, arguments.out, arguments.jobs,
                    command_again(arguments, {"--seed", std::to_string(experiment.seed)}),
                    invocation.console);
  const SlamStudy study = read_slam_study(arguments.out);
  nlohmann::ordered_json object = slam_study_result(study);
  object["study"] = arguments.out;
  invocation.console.result(slam_study_text(study) + arguments.out + "\n", object);
  return kDone;
}

int run(const Arguments& arguments, const Invocation& invocation) {
  const std::string text = read_file(arguments.experiment);
  if (is_slam_experiment(text, arguments.experiment)) return run_slam(arguments, text, invocation);
  if (arguments.plaza) throw InvalidInput("--plaza: the experiment uses no data from outside");
  Experiment experiment = parse_experiment(text, arguments.experiment, arguments.profile);
  apply(arguments.changes, experiment);
  make_records(experiment, arguments.out, arguments.jobs,
               command_again(arguments, words_of(arguments.changes, experiment)),
               invocation.console);
  const Study study = read_study(arguments.out);
  nlohmann::ordered_json object = study_result(study);
  object["study"] = arguments.out;
  invocation.console.result(study_text(study) + arguments.out + "\n", object);
  return kDone;
}

}  // namespace

Action run_verb(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  app.description("Run an experiment and write its records, nothing else");
  app.footer(
      "Examples:\n"
      "  mapproof run templates/experiments/yairi2007.json --profile quick --out out/study\n"
      "  mapproof run templates/experiments/boots2013.json --plaza plaza --out out/range\n\n"
      "docs/file-formats.md says what an experiment's file holds.\n");
  app.add_option("EXPERIMENT", arguments->experiment, "The experiment's JSON file")->required();
  add_out_option(app, arguments->out, "Folder for the records")->required();
  app.add_option("--profile", arguments->profile, "One of the profiles in the file");
  add_jobs_option(app, arguments->jobs);
  add_experiment_options(app, arguments->changes);
  add_plaza_option(app, arguments->plaza);
  return [arguments](const Invocation& invocation) { return run(*arguments, invocation); };
}

}  // namespace mapproof
