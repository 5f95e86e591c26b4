#include <memory>

#include "app/commands/verbs.hpp"
#include "app/study_run.hpp"
#include "core/base/files.hpp"
#include "core/records/experiment_json.hpp"
#include "core/records/study_store.hpp"

namespace mapproof {
namespace {

struct Arguments {
  std::string experiment;
  std::string out;
  std::string profile;
  int jobs = 1;
  ExperimentChanges changes;
};

/// The two commands that make the same study and a report of it, wherever they are typed.
std::string command_again(const Arguments& arguments, const Experiment& experiment) {
  std::vector<std::string> words = {"mapproof", "run", arguments.experiment};
  if (!arguments.profile.empty()) words.insert(words.end(), {"--profile", arguments.profile});
  const std::vector<std::string> changes = words_of(arguments.changes, experiment);
  words.insert(words.end(), changes.begin(), changes.end());
  words.insert(words.end(), {"--out", arguments.out});
  return quoted_command(words) + " && " + quoted_command({"mapproof", "report", arguments.out});
}

int run(const Arguments& arguments, const Invocation& invocation) {
  Experiment experiment =
      parse_experiment(read_file(arguments.experiment), arguments.experiment, arguments.profile);
  apply(arguments.changes, experiment);
  make_records(experiment, arguments.out, arguments.jobs, command_again(arguments, experiment),
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
      "Example:\n"
      "  mapproof run templates/experiments/yairi2007.json --profile quick --out out/study\n\n"
      "docs/file-formats.md says what an experiment's file holds.\n");
  app.add_option("EXPERIMENT", arguments->experiment, "The experiment's JSON file")->required();
  add_out_option(app, arguments->out, "Folder for the records")->required();
  app.add_option("--profile", arguments->profile, "One of the profiles in the file");
  add_jobs_option(app, arguments->jobs);
  add_experiment_options(app, arguments->changes);
  return [arguments](const Invocation& invocation) { return run(*arguments, invocation); };
}

}  // namespace mapproof
