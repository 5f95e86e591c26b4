#include "app/commands.hpp"

#include <array>
#include <memory>
#include <system_error>

#include <fmt/format.h>

#include "app/diff/diff_options.hpp"
#include "app/output_paths.hpp"
#include "app/study/folder_report.hpp"
#include "app/study/study_request.hpp"
#include "app/study/study_run.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/paths.hpp"
#include "reports/diff/folder_diff.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

struct CheckArguments {
  std::string experiment;
  std::string baseline;
  std::string out = "out/check";
  int jobs = 1;
  StudyOptions request{.profile = "full"};
  DiffOptions options;
};

/// Makes the records of the experiment, its figures and its report.
void make_candidate(const CheckArguments& arguments, const Invocation& invocation) {
  const StudyRequest request =
      read_study_request(experiment_of(arguments.experiment), arguments.request);
  check_data_used({&request, 1}, arguments.request);
  make_study(request, arguments.out, arguments.jobs,
             {invocation.command, invocation.disclosure.host()}, invocation.console);
  const FolderLock lock(arguments.out);
  write_report(read_folder_report(arguments.out, invocation.command, ""),
               {.page = load_templates(arguments.options.templates),
                .jobs = arguments.jobs,
                .disclosure = invocation.disclosure,
                .progress = count_progress(invocation.console, "drawing")},
               lock);
}

/// The candidate never writes over the baseline, nor an output over either.
void check_paths(const CheckArguments& arguments) {
  if (overlap(arguments.baseline, arguments.out))
    throw InvalidInput(fmt::format("--baseline {} and --out {}: one is the other or lies in it",
                                   printable(arguments.baseline), printable(arguments.out)));
  const std::array<fs::path, 4> inputs = {arguments.baseline, arguments.out,
                                          arguments.options.settings, arguments.experiment};
  check_output_paths(arguments.options, inputs);
}

int check(const CheckArguments& arguments, const Invocation& invocation) {
  check_paths(arguments);
  const DiffSettings settings =
      diff_settings(arguments.options, arguments.baseline, invocation.console);
  make_candidate(arguments, invocation);
  check_paths(arguments);  // Now that the candidate's files are there.
  std::error_code error;
  // An empty folder stands for a baseline that is not there yet: everything in the candidate is
  // new.
  if (!fs::exists(arguments.baseline, error)) {
    invocation.console.warning(fmt::format(
        "{}: there is no baseline. The candidate is kept in {}; check it, and if it is right: "
        "{}",
        arguments.baseline, arguments.out,
        quoted_command({"mapproof", "approve", arguments.baseline, arguments.out, "--all"})));
    if (!asks_for_outputs(arguments.options, invocation.console)) return kNo;
    return hand_out(no_baseline(arguments.baseline, arguments.out, settings), settings,
                    arguments.options, invocation);
  }
  return hand_out(folder_diff(arguments.baseline, arguments.out, settings), settings,
                  arguments.options, invocation);
}

}  // namespace

Action check_command(CLI::App& app) {
  auto arguments = std::make_shared<CheckArguments>();
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
  app.add_option("--baseline", arguments->baseline, "The study to compare with")
      ->required()
      ->check(names_folder());
  add_out_option(app, arguments->out, "Folder for records, figures and report")
      ->capture_default_str();
  app.add_option("--profile", arguments->request.profile,
                 "One of the profiles in the experiment, such as quick; full is all of it")
      ->capture_default_str()
      ->group("Experiment");
  group_options(app, {{"Comparison", {"--baseline"}}});
  add_jobs_option(app, arguments->jobs);
  add_experiment_options(app, arguments->request.changes);
  add_data_options(app, arguments->request);
  add_diff_options(app, arguments->options);
  return [arguments](const Invocation& invocation) { return check(*arguments, invocation); };
}

}  // namespace mapproof
