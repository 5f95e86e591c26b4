#include <memory>
#include <system_error>

#include <fmt/format.h>

#include "app/commands/verbs.hpp"
#include "app/diff_options.hpp"
#include "app/embedded_experiments.hpp"
#include "app/folder_report.hpp"
#include "app/study_run.hpp"
#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/records/experiment_json.hpp"
#include "core/records/slam_experiment_json.hpp"
#include "reports/diff/folder_diff.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string experiment;
  std::string baseline;
  std::string out = "out/check";
  std::string profile;
  int jobs = 1;
  ExperimentChanges changes;
  std::optional<std::string> plaza;
  DiffOptions options;
};

/// A file, or else the name of an experiment that the program knows.
ExperimentText text_of(const std::string& experiment) {
  std::error_code error;
  if (fs::is_regular_file(experiment, error))
    return {.text = read_file(experiment), .source = experiment};
  return experiment_text(experiment, std::nullopt);
}

/// Makes the records of the experiment, its figures and its report.
void make_candidate(const Arguments& arguments, const Invocation& invocation) {
  const ExperimentText file = text_of(arguments.experiment);
  if (is_slam_experiment(file.text, file.source)) {
    SlamExperiment experiment = parse_slam_experiment(file.text, file.source, arguments.profile);
    apply(arguments.changes, experiment);
    make_slam_records(experiment, read_slam_data(experiment, arguments.plaza), arguments.out,
                      arguments.jobs, invocation.command, invocation.console);
  } else {
    Experiment experiment = parse_experiment(file.text, file.source, arguments.profile);
    apply(arguments.changes, experiment);
    make_records(experiment, arguments.out, arguments.jobs, invocation.command, invocation.console);
  }
  write_report(read_folder_report(arguments.out, invocation.command, ""),
               load_templates(arguments.options.templates), arguments.jobs);
}

int check(const Arguments& arguments, const Invocation& invocation) {
  const DiffSettings settings = diff_settings(arguments.options, arguments.baseline);
  make_candidate(arguments, invocation);
  std::error_code error;
  // An empty folder stands for a baseline that is not there yet: everything in the candidate is
  // new.
  if (!fs::exists(arguments.baseline, error)) {
    invocation.console.warning(fmt::format(
        "{}: there is no baseline. The candidate is kept in {}; look at it, and if it is right: "
        "{}",
        arguments.baseline, arguments.out,
        quoted_command({"mapproof", "approve", arguments.baseline, arguments.out, "--all"})));
    return kNo;
  }
  return hand_out(folder_diff(arguments.baseline, arguments.out, settings), settings,
                  arguments.options, invocation.console);
}

}  // namespace

Action check_verb(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  app.description("Run an experiment and compare it with a baseline in one go");
  app.footer(
      "Examples:\n"
      "  mapproof check yairi2007 --profile quick --baseline baseline --out out/check\n"
      "  mapproof check experiment.json --baseline baseline --junit diff.junit.xml\n\n"
      "Exit codes as of \"mapproof diff\". Without a baseline it is 1, and what was made is "
      "kept.\n");
  app.add_option("EXPERIMENT", arguments->experiment,
                 "The experiment's JSON file, or a name that reproduce takes")
      ->required();
  app.add_option("--baseline", arguments->baseline, "The study to compare with")->required();
  add_out_option(app, arguments->out, "Folder for records, figures and report")
      ->capture_default_str();
  app.add_option("--profile", arguments->profile, "One of the profiles in the experiment");
  add_jobs_option(app, arguments->jobs);
  add_experiment_options(app, arguments->changes);
  add_plaza_option(app, arguments->plaza);
  app.add_option("--page", arguments->options.page,
                 "Write a page that shows what differs, diff.html for instance");
  add_diff_options(app, arguments->options);
  return [arguments](const Invocation& invocation) { return check(*arguments, invocation); };
}

}  // namespace mapproof
