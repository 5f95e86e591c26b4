#include "app/commands.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/study/embedded_experiments.hpp"
#include "app/study/folder_report.hpp"
#include "app/study/study_outputs.hpp"
#include "app/study/study_request.hpp"
#include "app/study/study_run.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/records/studies/study_store.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAll = "all";                ///< Both papers.
constexpr const char* kExtensions = "extensions";  ///< The studies beyond them.

struct ReproduceArguments {
  std::string name;
  std::string out = "out";
  int jobs = 1;
  StudyOptions options{.profile = "full"};
  std::optional<std::string> templates;
  bool print = false;  ///< The experiment instead of its study.
};

/// The experiment of that name, or in that file.
ExperimentText text_of(const std::string& name, const ReproduceArguments& arguments) {
  return is_experiment_file(name) ? experiment_of(name)
                                  : experiment_text(name, arguments.templates);
}

/// The experiments that a name stands for.
std::vector<std::string> names_of(const ReproduceArguments& arguments) {
  if (arguments.name == kAll) return paper_names();
  if (arguments.name != kExtensions) return {arguments.name};
  const std::vector<std::string> papers = paper_names();
  std::vector<std::string> names;
  for (const std::string& name : experiment_names()) {
    if (std::ranges::find(papers, name) != papers.end()) continue;
    const bool of_data = needs_data(text_of(name, arguments));
    if (!of_data || arguments.options.data) names.push_back(name);
  }
  return names;
}

/// All requests, read and checked before anything is made.
std::vector<StudyRequest> read_requests(const ReproduceArguments& arguments,
                                        const Disclosure& disclosure) {
  const std::vector<std::string> names = names_of(arguments);
  StudyOptions options = arguments.options;
  options.one_of_several = options.profile_if_there = names.size() > 1;
  std::vector<StudyRequest> requests;
  for (const std::string& name : names)
    requests.push_back(read_study_request(text_of(name, arguments), options, disclosure));
  check_data_used(requests, options);
  return requests;
}

/// Throws if a folder for several studies holds anything else. @throws IoError.
void check_folder_of_all(const fs::path& folder) {
  std::error_code error;
  refuse_links_out(folder);
  if (is_study(folder))
    throw IoError(folder.string(), "holds a study; choose another folder for all of them");
  std::vector<std::string> ours = experiment_names();
  ours.insert(ours.end(),
              {"figures", "figures-paper", "figures-styled", "pages", "tables", "report.html"});
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const bool is_ours = std::ranges::any_of(
        ours, [&](const std::string& known) { return name.starts_with(known); });
    if (!is_ours)
      throw IoError(folder.string(), "is not empty and holds no studies; choose another folder");
  }
}

/// Prints the text of one experiment, to be changed and run.
int print_experiment(const ReproduceArguments& arguments, const Invocation& invocation) {
  if (arguments.name == kAll || arguments.name == kExtensions)
    throw InvalidInput("--print: prints one experiment; name it");
  invocation.console.print(text_of(arguments.name, arguments).text);
  return kDone;
}

/// The command that makes the same studies and report again, wherever it was typed.
std::string command_again(const ReproduceArguments& arguments,
                          const std::vector<StudyRequest>& requests, const Disclosure& disclosure) {
  std::vector<std::string> words = {"mapproof", "reproduce", arguments.name};
  const std::vector<std::string> more = words_of(requests, arguments.options);
  words.insert(words.end(), more.begin(), more.end());
  words.insert(words.end(), {"--out", arguments.out});
  return quoted_command(disclosure.words(words));
}

int reproduce(const ReproduceArguments& arguments, const Invocation& invocation) {
  if (arguments.print) return print_experiment(arguments, invocation);
  // First of all, so that a template or data that cannot be used cost no study.
  const Templates page = load_templates(arguments.templates);
  std::optional<ProgressLine> reading(std::in_place, invocation.console, "reading");
  const std::vector<StudyRequest> requests = read_requests(arguments, invocation.disclosure);
  const bool is_alone = requests.size() == 1;
  if (!is_alone) check_folder_of_all(arguments.out);
  const std::string command = command_again(arguments, requests, invocation.disclosure);
  reading.reset();
  std::string text;
  nlohmann::ordered_json object;
  for (const StudyRequest& request : requests) {
    const fs::path folder =
        is_alone ? fs::path(arguments.out) : arguments.out / fs::path(request.name);
    make_study(request, folder, arguments.jobs, {command, invocation.disclosure.host()},
               invocation.console);
    reading.emplace(invocation.console, "reading the results");
    StudyNumbers numbers = outputs_of_study(folder).numbers(folder);
    reading.reset();
    for (const std::string& missing : numbers.missing) invocation.console.warning(missing);
    text += numbers.text;
    if (is_alone)
      object = std::move(numbers.object);
    else
      object["studies"].push_back(std::move(numbers.object));
  }
  const FolderLock lock(arguments.out);
  reading.emplace(invocation.console, "reading the results");
  const FolderReport report = read_folder_report(arguments.out, command, "");
  reading.reset();
  const fs::path path = write_report(report,
                                     {.page = page,
                                      .jobs = arguments.jobs,
                                      .disclosure = invocation.disclosure,
                                      .progress = count_progress(invocation.console, "drawing"),
                                      .note = note_to(invocation.console)},
                                     lock);
  object["figures"] = report.figures.size();
  object["scenes"] = report.scenes.size();
  object["report"] = path.string();
  invocation.console.result(text + path.string() + "\n", object);
  return kDone;
}

}  // namespace

Action reproduce_command(CLI::App& app) {
  auto arguments = std::make_shared<ReproduceArguments>();
  app.description("Run an experiment, a known one or your own, and write its figures and report");
  app.footer(
      "Examples:\n"
      "  mapproof reproduce yairi2007\n"
      "  mapproof reproduce yairi2007 --profile quick --out out/quick --jobs 2\n"
      "  mapproof reproduce boots2013 --plaza plaza --out out/boots2013\n"
      "  mapproof reproduce yairi2007 --print > mine.json\n"
      "  mapproof reproduce mine.json --out out/mine\n"
      "  mapproof reproduce all --plaza plaza --out out\n"
      "  mapproof reproduce mrclam --data MRCLAM --out out/mrclam\n\n"
      "\"all\" makes each study in a folder of its own below DIR and puts them into one report.\n"
      "\"extensions\" does so with the studies beyond the papers.\n"
      "The Plaza data are not part of the program: without --plaza the simulated part of "
      "boots2013\n"
      "is made, and the report says how to get them.\n"
      "A study that was stopped is continued; a folder that holds another experiment is "
      "refused.\n");
  app.add_option("NAME", arguments->name,
                 fmt::format("An experiment's JSON file, or {}, all (both papers) or extensions",
                             fmt::join(experiment_names(), ", ")))
      ->required();
  add_out_option(app, arguments->out, "Folder for records, figures and report")
      ->capture_default_str();
  app.add_option("--profile", arguments->options.profile,
                 "One of the profiles of the experiment, such as quick; full is all of it")
      ->capture_default_str()
      ->group("Experiment");
  app.add_flag("--print", arguments->print, "Print the experiment's file, to be changed and run")
      ->group("Output");
  add_jobs_option(app, arguments->jobs);
  add_experiment_options(app, arguments->options.changes);
  app.add_option("--templates", arguments->templates,
                 "Folder whose templates and experiments replace the embedded ones")
      ->check(names_folder())
      ->group("Output");
  add_data_options(app, arguments->options);
  return [arguments](const Invocation& invocation) { return reproduce(*arguments, invocation); };
}

}  // namespace mapproof
