#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands/verbs.hpp"
#include "app/embedded_experiments.hpp"
#include "app/study_outputs.hpp"
#include "app/study_run.hpp"
#include "core/base/errors.hpp"
#include "core/records/experiment_json.hpp"
#include "reports/html/templates.hpp"

namespace mapproof {
namespace {

struct Arguments {
  std::string name;
  std::string out = "out";
  std::string profile = "full";
  int jobs = 1;
  ExperimentChanges changes;
  std::optional<std::string> templates;
  std::string plaza;
};

Experiment chosen_experiment(const Arguments& arguments) {
  const ExperimentText file = experiment_text(arguments.name, arguments.templates);
  Experiment experiment = parse_experiment(file.text, file.source, arguments.profile);
  apply(arguments.changes, experiment);
  return experiment;
}

/// The command that makes the same study and report again, wherever it was typed.
std::string command_again(const Arguments& arguments, const Experiment& experiment) {
  std::vector<std::string> words = {"mapproof", "reproduce", arguments.name, "--profile",
                                    arguments.profile};
  const std::vector<std::string> changes = words_of(arguments.changes, experiment);
  words.insert(words.end(), changes.begin(), changes.end());
  words.insert(words.end(), {"--out", arguments.out});
  return quoted_command(words);
}

int reproduce(const Arguments& arguments, const Invocation& invocation) {
  const Experiment experiment = chosen_experiment(arguments);
  // First of all, so that a template that cannot be used costs no study.
  const Templates page = load_templates(arguments.templates);
  if (!arguments.plaza.empty())
    invocation.console.warning("--plaza: the experiment " + arguments.name +
                               " uses no data from outside");
  const std::string command = command_again(arguments, experiment);
  make_records(experiment, arguments.out, arguments.jobs, command, invocation.console);
  const StudyView view = view_study(arguments.out);
  const std::filesystem::path report = write_report(view, command, page, arguments.jobs);

  nlohmann::ordered_json object = study_result(view.study);
  object["figures"] = all_figures(view.figures).size();
  object["report"] = report.string();
  invocation.console.result(study_text(view.study) + report.string() + "\n", object);
  return kDone;
}

}  // namespace

Action reproduce_verb(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  app.description("Run a paper's experiment and write its figures and report");
  app.footer(
      "Examples:\n"
      "  mapproof reproduce yairi2007\n"
      "  mapproof reproduce yairi2007 --profile quick --out out/quick --jobs 2\n\n"
      "A study that was stopped goes on where it was; a folder that holds another experiment is "
      "refused.\n");
  app.add_option("NAME", arguments->name,
                 fmt::format("Experiment: {}", fmt::join(experiment_names(), ", ")))
      ->required();
  add_out_option(app, arguments->out, "Folder for records, figures and report")
      ->capture_default_str();
  app.add_option("--profile", arguments->profile, "quick or full")->capture_default_str();
  add_jobs_option(app, arguments->jobs);
  add_experiment_options(app, arguments->changes);
  app.add_option("--templates", arguments->templates,
                 "Folder whose templates and experiments replace the embedded ones");
  app.add_option("--plaza", arguments->plaza, "Folder of the Plaza data, for experiments on them")
      ->check(CLI::ExistingDirectory);
  return [arguments](const Invocation& invocation) { return reproduce(*arguments, invocation); };
}

}  // namespace mapproof
