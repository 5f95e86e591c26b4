#include "app/commands.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "app/diff/diff_options.hpp"
#include "app/diff/git_baseline.hpp"
#include "app/output_paths.hpp"
#include "app/study/folder_report.hpp"
#include "app/study/study_request.hpp"
#include "app/study/study_run.hpp"
#include "core/base/child_process.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/files/paths.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "reports/diff/folder_diff.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// A command that draws figures, and the folders around it.
struct PlotCommand {
  std::vector<std::string> words;   ///< The program and its arguments.
  std::filesystem::path writes;     ///< Where it writes; empty: in a new folder, its current one.
  std::filesystem::path candidate;  ///< Where what it wrote is kept.
  std::filesystem::path baseline;   ///< Never taken for something that it wrote.
};

/// Identifies a folder that may be emptied.
constexpr const char* kMark = ".mapproof-candidate";

/// Changes whenever a file is written.
using Stamp = std::array<std::int64_t, 6>;

Stamp stamp_of(const struct stat& status) {
  return {static_cast<std::int64_t>(status.st_ino),
          status.st_size,
          status.st_mtim.tv_sec,
          status.st_mtim.tv_nsec,
          status.st_ctim.tv_sec,
          status.st_ctim.tv_nsec};
}

/// The regular files below a folder.
std::map<fs::path, Stamp> files_below(const PlotCommand& command) {
  std::map<fs::path, Stamp> files;
  const std::array skipped = {real_path(command.candidate), real_path(command.baseline)};
  std::error_code error;
  if (!fs::exists(command.writes, error)) return files;
  fs::recursive_directory_iterator entry(command.writes, error), end;
  for (; !error && entry != end; entry.increment(error)) {
    struct stat status {};
    if (::lstat(entry->path().c_str(), &status) != 0) continue;
    if (S_ISDIR(status.st_mode)) {
      const bool is_hidden = entry->path().filename().string().starts_with('.');
      if (is_hidden || std::ranges::find(skipped, real_path(entry->path())) != skipped.end())
        entry.disable_recursion_pending();
    } else if (S_ISREG(status.st_mode)) {
      files[entry->path()] = stamp_of(status);
    }
  }
  if (error) throw IoError(command.writes.string(), "cannot be listed: " + error.message());
  return files;
}

void empty_candidate(const fs::path& candidate) {
  std::error_code error;
  if (fs::exists(candidate, error) && !fs::is_directory(candidate, error))
    throw IoError(candidate.string(), "is not a folder");
  const bool is_ours = fs::is_regular_file(candidate / kMark, error);
  if (!is_ours && fs::exists(candidate, error) && !fs::is_empty(candidate, error))
    throw InvalidInput(
        fmt::format("--out {}: holds files that no earlier \"mapproof check -- COMMAND\" wrote; "
                    "name another folder",
                    printable(candidate.string())));
  make_folder(candidate);
  const FolderLock lock(candidate);
  const OutputFolder folder(candidate);
  folder.write(kMark, "The next \"mapproof check\" empties this folder.\n");
  for (const fs::directory_entry& entry : fs::directory_iterator(candidate))
    if (entry.path().filename() != kMark) folder.remove(entry.path().filename());
}

void check_folders(const PlotCommand& command) {
  if (command.writes.empty()) return;
  const fs::path writes = real_path(command.writes);
  if (lies_in(writes, real_path(command.candidate)))
    throw InvalidInput(fmt::format("--writes {} is --out or lies in it, which is emptied",
                                   printable(command.writes.string())));
  if (!command.baseline.empty() && lies_in(writes, real_path(command.baseline)))
    throw InvalidInput(
        fmt::format("--writes {} is the baseline or lies in it. What git has of it can be the "
                    "baseline: --baseline-ref HEAD:{}",
                    printable(command.writes.string()), printable(command.writes.string())));
}

/// An argument for a program that runs in another folder.
std::string argument_elsewhere(const std::string& word) {
  std::error_code error;
  const fs::path path(word);
  if (word.empty() || path.is_absolute() || !fs::is_regular_file(path, error)) return word;
  return (fs::current_path() / path).string();
}

/// The command as env takes it: env finds the program by PATH, and starts it in a folder.
ProgramCall call_of(const PlotCommand& command) {
  const bool here = !command.writes.empty();
  ProgramCall call{.program = "/usr/bin/env",
                   .arguments = {"-C", here ? "." : command.candidate.string(), "--",
                                 "MAPPROOF_SOURCE=" + fs::current_path().string()}};
  for (std::size_t i = 0; i < command.words.size(); ++i) {
    const std::string& word = command.words[i];
    // A program without a slash is found by PATH, whatever lies here.
    const bool by_path = i == 0 && word.find('/') == std::string::npos;
    call.arguments.push_back(here || by_path ? word : argument_elsewhere(word));
  }
  return call;
}

void run(const PlotCommand& command) {
  constexpr int kNotFound = 127;  // As env and shells end then.
  constexpr std::size_t kLongest = 500;
  const Descriptor nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  const std::string shown = printable(quoted_command(command.words), kLongest);
  ProcessEnd end;
  try {
    ChildProcess process(call_of(command), {.input = nothing.get(), .output = STDERR_FILENO});
    end = process.wait();
  } catch (const ProcessError& error) {
    throw InvalidInput(fmt::format("{}: {}", shown, error.what()));
  }
  if (end.is_success()) return;
  throw InvalidInput(fmt::format("{}: {}{}; nothing was compared", shown, end.text(),
                                 end.exit_code == kNotFound ? " (no such program)" : ""));
}

void copy_written(const PlotCommand& command, const std::map<fs::path, Stamp>& before) {
  for (const auto& [file, stamp] : files_below(command)) {
    const auto earlier = before.find(file);
    if (earlier != before.end() && earlier->second == stamp) continue;
    const fs::path target = command.candidate / file.lexically_relative(command.writes);
    make_folder(target.parent_path());
    std::error_code error;
    fs::copy_file(file, target, fs::copy_options::overwrite_existing, error);
    if (error) throw IoError(file.string(), "cannot be copied: " + error.message());
  }
}

/// Runs the command without a shell and without standard input; its output goes to standard error.
/// Without `writes` its current folder is `candidate`, and arguments that name files here are given
/// to it as absolute paths. With `writes` it runs here, and the files below that folder that it
/// wrote, also if with the bytes of before, are copied to `candidate`; hidden folders and links are
/// not. The environment variable MAPPROOF_SOURCE is the current folder of this process.
///
/// `candidate` is emptied first: a folder that is not an earlier candidate is refused.
/// @throws InvalidInput if the folders overlap, if the command fails, or if it wrote nothing that
///         can be compared; IoError. What it wrote stays in `candidate`.
void run_plot_command(const PlotCommand& command) {
  check_folders(command);
  empty_candidate(command.candidate);
  const FolderLock lock(command.candidate);
  const std::map<fs::path, Stamp> before =
      command.writes.empty() ? std::map<fs::path, Stamp>() : files_below(command);
  run(command);
  if (!command.writes.empty()) copy_written(command, before);
  if (holds_items(command.candidate)) return;
  const std::string shown = printable(quoted_command(command.words));
  throw InvalidInput(
      command.writes.empty()
          ? fmt::format("{}: it wrote no figure, image or table in its folder {}. If it writes "
                        "elsewhere, name that folder with --writes",
                        shown, printable(command.candidate.string()))
          : fmt::format("{}: it wrote no figure, image or table below {}", shown,
                        printable(command.writes.string())));
}

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
  const StudyRequest request = read_study_request(experiment_of(arguments.experiment()),
                                                  arguments.request, invocation.disclosure);
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

/// Names the baseline as the user did.
FileNaming naming_of(const Baseline& baseline) {
  if (baseline.folder == baseline.text) return {};
  return [&baseline](std::string text) {
    for (std::size_t at = 0; (at = text.find(baseline.folder, at)) != std::string::npos;)
      text.replace(at, baseline.folder.size(), baseline.text);
    return text;
  };
}

/// Names the baseline of a result by the folder in the working tree, which `approve` takes, and its
/// commit in a remark.
void name_baseline(DiffResult& result, const Baseline& baseline, const GitBaseline& git) {
  constexpr std::size_t kShortHash = 10;
  rename_files(result, naming_of(baseline));
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
  return hand_out(result, settings, arguments.options, invocation, naming_of(baseline));
}

void add_check_options(CLI::App& app, CheckArguments& arguments) {
  app.add_option("EXPERIMENT", arguments.words,
                 "The experiment's JSON file, or the name of one; behind -- a command "
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
