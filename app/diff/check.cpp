#include "app/commands.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "app/diff/diff_options.hpp"
#include "app/diff/git_baseline.hpp"
#include "app/diff/plot_command.hpp"
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
  std::vector<std::string> words;  ///< The experiment; or a command and its arguments.
  bool is_command = false;
  std::string baseline;
  std::string baseline_ref;
  std::string writes;
  std::string out = "out/check";
  int jobs = 1;
  StudyOptions request{.profile = "full"};
  DiffOptions options;

  std::string experiment() const { return is_command ? "" : words.front(); }
};

/// What an experiment has and a command has not.
constexpr std::array kOfExperiments = {"--profile", "--jobs",  "--seed", "--layouts",
                                       "--poses",   "--plaza", "--data", "--methods"};

/// Finds out what is checked, and refuses options that are not of it.
void read_words(CheckArguments& arguments, const CLI::App& app) {
  // The parser keeps the "--" that ended the options.
  arguments.is_command = std::ranges::count(app.remaining(), "--") > 0;
  if (!arguments.is_command && arguments.words.size() > 1)
    throw InvalidInput(
        fmt::format("check takes one experiment, not \"{}\" as well; a command "
                    "stands behind --",
                    printable(arguments.words[1])));
  if (arguments.is_command)
    for (const char* option : kOfExperiments)
      if (app.get_option(option)->count() > 0)
        throw InvalidInput(fmt::format("{} is of an experiment, and a command is checked", option));
  if (!arguments.is_command && !arguments.writes.empty())
    throw InvalidInput("--writes is of a command: mapproof check --writes DIR -- COMMAND");
  if (arguments.baseline.empty() == arguments.baseline_ref.empty())
    throw InvalidInput("give --baseline DIR or --baseline-ref REF:PATH");
}

/// Makes the records of the experiment, its figures and its report.
void make_study_candidate(const CheckArguments& arguments, const Invocation& invocation) {
  const StudyRequest request =
      read_study_request(experiment_of(arguments.experiment()), arguments.request);
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

void make_candidate(const CheckArguments& arguments, const Invocation& invocation) {
  if (!arguments.is_command) return make_study_candidate(arguments, invocation);
  run_plot_command({.words = arguments.words,
                    .writes = arguments.writes,
                    .candidate = arguments.out,
                    .baseline = arguments.baseline});
}

/// The candidate never writes over the baseline, nor an output over either.
void check_paths(const CheckArguments& arguments) {
  if (!arguments.baseline.empty() && overlap(arguments.baseline, arguments.out))
    throw InvalidInput(fmt::format("--baseline {} and --out {}: one is the other or lies in it",
                                   printable(arguments.baseline), printable(arguments.out)));
  const std::array<fs::path, 4> inputs = {arguments.baseline, arguments.out,
                                          arguments.options.settings, arguments.experiment()};
  check_output_paths(arguments.options, inputs);
}

/// The baseline of a check.
struct Baseline {
  std::string folder;  ///< What is compared.
  std::string text;    ///< As the user named it.
  std::string target;  ///< The folder that `approve` changes.
  bool exists = false;
};

Baseline baseline_of(const CheckArguments& arguments, const std::optional<GitBaseline>& git) {
  if (git)
    return {git->folder().string(), arguments.baseline_ref, git->working_folder(),
            git->exists() && holds_items(git->folder())};
  std::error_code error;
  const std::string& folder = arguments.baseline;
  return {folder, folder, folder, fs::exists(folder, error) && holds_items(folder)};
}

/// Names the baseline of a result by the folder in the working tree, which `approve` takes, and its
/// commit in a remark.
void name_baseline(DiffResult& result, const Baseline& baseline, const GitBaseline& git) {
  constexpr std::size_t kShortHash = 10;
  const auto rename = [&](std::string& text) {
    for (std::size_t at = 0; (at = text.find(baseline.folder, at)) != std::string::npos;)
      text.replace(at, baseline.folder.size(), baseline.text);
  };
  rename(result.judgement.cause);
  for (DiffItem& item : result.items) {
    rename(item.judgement.cause);
    for (ImageFile& image : item.images) rename(image.diff.reason);
  }
  result.baseline = baseline.target;
  result.remarks.push_back(fmt::format("The baseline is {}, commit {}.", printable(baseline.text),
                                       git.commit().substr(0, kShortHash)));
  if (!git.left_out().empty())
    result.remarks.push_back(fmt::format("Links and submodules in it are not compared:  {}{}.",
                                         printable(git.left_out().front()),
                                         git.left_out().size() > 1 ? ", …" : ""));
}

int hand_out_without_baseline(const CheckArguments& arguments, const Baseline& baseline,
                              const DiffSettings& settings, const Invocation& invocation) {
  invocation.console.warning(fmt::format(
      "{}: there is no baseline. The candidate is kept in {}; check it, and if it is right: {}",
      printable(baseline.text), printable(arguments.out),
      quoted_command({"mapproof", "approve", baseline.target, arguments.out, "--all"})));
  DiffResult result = no_baseline(baseline.target, arguments.out, settings);
  return hand_out(result, settings, arguments.options, invocation);
}

int check(CheckArguments arguments, const CLI::App& app, const Invocation& invocation) {
  read_words(arguments, app);
  check_paths(arguments);
  std::optional<GitBaseline> git;
  if (!arguments.baseline_ref.empty()) git.emplace(parse_git_folder(arguments.baseline_ref));
  const std::string settings_folder = !git            ? arguments.baseline
                                      : git->exists() ? git->folder().string()
                                                      : git->working_folder();
  const DiffSettings settings =
      diff_settings(arguments.options, settings_folder, invocation.console);
  make_candidate(arguments, invocation);
  check_paths(arguments);  // Now that the candidate's files are there.
  const Baseline baseline = baseline_of(arguments, git);
  arguments.options.folder = baseline.target;
  if (!baseline.exists) return hand_out_without_baseline(arguments, baseline, settings, invocation);
  DiffResult result = folder_diff(baseline.folder, arguments.out, settings);
  if (git) name_baseline(result, baseline, *git);
  return hand_out(result, settings, arguments.options, invocation);
}

void add_check_options(CLI::App& app, CheckArguments& arguments) {
  app.add_option("EXPERIMENT", arguments.words,
                 "The experiment's JSON file, or a name that reproduce takes; behind -- a command "
                 "that draws figures")
      ->required();
  auto* baseline = app.add_option("--baseline", arguments.baseline,
                                  "The folder to compare with: a study, or images")
                       ->check(names_folder());
  app.add_option("--baseline-ref", arguments.baseline_ref,
                 "The same from a commit of the git repository here: origin/main:plots")
      ->type_name("REF:PATH")
      ->excludes(baseline);
  app.add_option("--writes", arguments.writes,
                 "The folder that the command writes to; by default it runs in a new one")
      ->check(names_folder());
  add_out_option(app, arguments.out, "Folder in which what was made is kept: the candidate")
      ->capture_default_str();
  app.add_option("--profile", arguments.request.profile,
                 "One of the profiles in the experiment, such as quick; full is all of it")
      ->capture_default_str()
      ->group("Experiment");
  group_options(app, {{"Comparison", {"--baseline", "--baseline-ref"}}, {"Input", {"--writes"}}});
  add_jobs_option(app, arguments.jobs);
  add_experiment_options(app, arguments.request.changes);
  add_data_options(app, arguments.request);
  add_diff_options(app, arguments.options);
}

}  // namespace

Action check_command(CLI::App& app) {
  auto arguments = std::make_shared<CheckArguments>();
  app.description("Run an experiment or a plot script and compare it with a baseline in one go");
  app.footer(
      "Examples:\n"
      "  mapproof check yairi2007 --profile quick --baseline baseline --out out/check\n"
      "  mapproof check experiment.json --baseline baseline --junit diff.junit.xml\n"
      "  mapproof check --baseline baseline -- python3 plot.py\n"
      "  mapproof check --baseline-ref origin/main:plots --writes plots -- make plots\n\n"
      "Exit codes as of \"mapproof diff\". Without a baseline it is 1, and what was made is "
      "kept. It\n"
      "is 2 if the command fails or writes nothing that can be compared.\n");
  add_check_options(app, *arguments);
  return [arguments, &app](const Invocation& invocation) {
    return check(*arguments, app, invocation);
  };
}

}  // namespace mapproof
