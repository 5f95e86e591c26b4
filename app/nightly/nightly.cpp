#include "app/commands.hpp"

#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <ctime>
#include <memory>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/build_facts.hpp"
#include "app/nightly/history_report.hpp"
#include "app/nightly/nightly_folders.hpp"
#include "app/nightly/nightly_study.hpp"
#include "app/study/embedded_experiments.hpp"
#include "app/study/folder_report.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/text/retired_names.hpp"
#include "core/json/record_writer.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "core/records/value_fields.hpp"
#include "reports/history/history_export.hpp"
#include "reports/history/history_prune.hpp"
#include "reports/history/judge_nightly_run.hpp"
#include "reports/history/nightly_scores.hpp"
#include "reports/history/nightly_standing.hpp"
#include "reports/history/object_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLastPassing = "last-passing";

struct NightlyArguments {
  std::vector<std::string> experiments;
  std::string store;
  std::string out;
  std::string reference = kLastPassing;
  int jobs = 1;
  std::optional<std::string> templates;
  StudyOptions request;
};

std::string now_utc() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

std::optional<int> asked_reference(const std::string& text) {
  if (text == kLastPassing) return std::nullopt;
  if (const std::string_view now = replacement_of(NameKind::kValue, text); !now.empty())
    throw InvalidInput(fmt::format("--reference: {} is now called {}", text, now));
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 1)
    throw InvalidInput("--reference: \"" + printable(text) +
                       "\" is not a nightly run's number and not " + kLastPassing);
  return number;
}

NightlyFacts begun(int number, int jobs, const SessionNames& names) {
  utsname system{};
  return {.number = number,
          .started_utc = now_utc(),
          .ended_utc = "",
          .command = names.command,
          .provenance = json_line(to_json_value(build_provenance())),
          .host = names.host,
          .processor = ::uname(&system) == 0 ? system.machine : "",
          .cores = static_cast<int>(std::thread::hardware_concurrency()),
          .jobs = jobs};
}

/// Makes the records of every study. @return The worst exit code.
int make_all(const std::vector<StudyRequest>& requests, const fs::path& folder, int jobs,
             const SessionNames& names, const Console& console) {
  int worst = kDone;
  for (const StudyRequest& request : requests)
    worst = std::max(worst, make_apart(request, folder / request.name, jobs, names, console));
  return worst;
}

/// What each study is, from its records.
std::vector<NightlyStudy> read_all(const std::vector<StudyRequest>& requests,
                                   const fs::path& folder) {
  std::vector<NightlyStudy> studies;
  for (const StudyRequest& request : requests)
    studies.push_back(read_nightly_study(folder / request.name, request.name));
  return studies;
}

/// Draws a study's report. @return Whether all of its scenes could be drawn; a warning if not.
bool draw(const FolderReport& report, const HistoryOutputs& outputs, const Console& console) {
  try {
    write_report(report,
                 {.page = outputs.page,
                  .jobs = outputs.jobs,
                  .disclosure = outputs.disclosure,
                  .progress = count_progress(console, "drawing")},
                 FolderLock(report.folder));
    return true;
  } catch (const SceneError& error) {
    console.warning(error.what());
    return false;
  }
}

/// Where index and trends go.
fs::path out_of(const NightlyArguments& arguments) {
  return arguments.out.empty() ? arguments.store : arguments.out;
}

/// Draws the report of each study of a nightly run that has been judged, and keeps its figures.
/// @return Whether all scenes could be drawn.
bool write_all(NightlyRun& nightly_run, HistoryStore& history, const fs::path& folder,
               const HistoryOutputs& outputs, const Invocation& invocation) {
  const ObjectFolder objects(outputs.store / "objects");
  const bool begins = history.nightly_runs().empty();
  const LostNightlyRuns lost = begins ? lost_nightly_runs(outputs.store, {}) : LostNightlyRuns{};
  bool scenes_drawn = true;
  for (NightlyStudy& study : nightly_run.studies) {
    FolderReport report =
        read_folder_report(folder / study.name, invocation.command, invocation.command);
    const bool is_compared =
        nightly_run.facts.reference && has_study(history, *nightly_run.facts.reference, study);
    NightlyLinks links(paths_from(folder / study.name, outputs.out, outputs.store));
    add_nightly_run(
        report.report,
        {.nightly_run = nightly_run, .name = study.name, .is_compared = is_compared, .lost = lost},
        links);
    report.link_words = links.words();
    scenes_drawn &= draw(report, outputs, invocation.console);
    study.figures = objects.keep(folder / study.name / "figures");
  }
  return scenes_drawn;
}

int exit_code(NightlyVerdict verdict) {
  switch (verdict) {
    case NightlyVerdict::kPassed:
      return kDone;
    case NightlyVerdict::kCost:
      return kCostGrew;
    default:
      return kNo;
  }
}

/// The first findings of each study, and where all of them stand.
std::string nightly_text(const NightlyRun& nightly_run, const std::vector<std::string>& remarks,
                         const fs::path& pages) {
  std::string text = fmt::format("nightly run {}: {}\n", nightly_run.facts.number,
                                 verdict_sentence(nightly_run.facts, nightly_run.findings.size()));
  for (const NightlyStudy& study : nightly_run.studies) {
    std::size_t count = 0;
    for (const NightlyFinding& finding : nightly_run.findings)
      if (finding.study == study.name && ++count <= kMostReported)
        text += fmt::format("  {}: {}\n", finding.study, finding.sentence);
    if (count > kMostReported)
      text +=
          fmt::format("  {}: and {} more: {}#section-findings\n", study.name, count - kMostReported,
                      (pages / "trends" / study.name / "report.html").string());
  }
  for (const std::string& remark : remarks) text += fmt::format("  ({})\n", remark);
  return text;
}

int nightly(const NightlyArguments& arguments, const Invocation& invocation) {
  const Console& console = invocation.console;
  const Templates page = load_templates(arguments.templates);
  const std::optional<int> asked = asked_reference(arguments.reference);
  const std::vector<StudyRequest> requests =
      read_nightly_requests(arguments.experiments, arguments.request);
  const fs::path store = arguments.store;
  const HistoryOutputs outputs{store, out_of(arguments), page, arguments.jobs,
                               invocation.disclosure};
  const SessionNames names{invocation.command, invocation.disclosure.host()};
  make_folder(store);
  const FolderLock lock(store, [&] {
    console.warning(store.string() +
                    ": another mapproof runs in it; waiting, since two at once would spoil "
                    "each other's seconds");
  });
  for (const fs::path& folder : {store, outputs.out}) refuse_links_out(folder);
  HistoryStore history = HistoryStore::open(store);
  for (const std::string& remark : history.remarks()) console.warning(remark);

  NightlyRun nightly_run{.facts = begun(next_nightly_run(history, store), arguments.jobs, names)};
  if (asked) {  // Refused before hours of work.
    nightly_run.studies = planned_studies(requests);
    reference_nightly_run(history, nightly_run, asked);
  }
  const fs::path folder = nightly_folder(store, nightly_run.facts.number);
  say_when_stopped(kContinuesWord);
  begin_nightly_run(folder, requests, console);
  const int made = make_all(requests, folder, arguments.jobs, names, console);
  if (made != kDone) {
    console.warning(fmt::format("nightly run {}: not recorded, since a study was not finished",
                                nightly_run.facts.number));
    return made;
  }
  nightly_run.studies = read_all(requests, folder);
  const std::vector<std::string> remarks = judge_nightly_run(history, nightly_run, asked);
  const bool scenes_drawn = write_all(nightly_run, history, folder, outputs, invocation);
  nightly_run.facts.ended_utc = now_utc();
  history.append(nightly_run);
  end_nightly_run(folder, nightly_run);
  const fs::path index = write_history_pages(history, outputs, remarks);

  nlohmann::ordered_json object = nightly_value(nightly_run.facts, nightly_run.findings);
  object["remarks"] = remarks;
  object["index"] = index.string();
  console.result(nightly_text(nightly_run, remarks, out_of(arguments)) + index.string() + "\n",
                 object);
  return scenes_drawn ? exit_code(nightly_run.facts.verdict) : kInternal;
}

}  // namespace

Action nightly_command(CLI::App& app) {
  auto arguments = std::make_shared<NightlyArguments>();
  app.description("Run experiments, add them to a history, and report what got worse");
  app.footer(
      "Examples:\n"
      "  mapproof nightly yairi2007 --store history\n"
      "  mapproof nightly mine.json boots2013 --profile quick --store history --reference 12\n\n"
      "Exit codes:\n"
      "  0  nothing got worse, or there was no run to compare with\n"
      "  1  accuracy got worse, or results are lost\n"
      "  2  wrong usage or input\n"
      "  3  internal error\n"
      "  4  only seconds or memory grew\n\n"
      "docs/nightly.md has the rules, and shows how to run it by a timer.\n");
  app.add_option(
         "EXPERIMENT", arguments->experiments,
         fmt::format("Experiments' JSON files, folders with a results.csv of your own, or {}",
                     fmt::join(experiment_names(), ", ")))
      ->required();
  app.add_option("--store", arguments->store, "Folder of the history; made if it is not there")
      ->required()
      ->check(names_folder());
  add_out_option(app, arguments->out, "Folder for index and trend pages, instead of the store");
  app.add_option("--reference", arguments->reference,
                 "Reference run: its number, refused if it had other settings or another seed, or "
                 "last-passing (the pinned one if there is one)")
      ->capture_default_str();
  app.add_option("--profile", arguments->request.profile,
                 "Profile of those experiments that have it");
  add_jobs_option(app, arguments->jobs);
  app.add_option("--templates", arguments->templates,
                 "Folder whose templates replace the embedded ones")
      ->check(names_folder());
  add_data_options(app, arguments->request);
  group_options(app, {{"Input", {"EXPERIMENT"}},
                      {"Experiment", {"--profile"}},
                      {"Comparison", {"--reference"}},
                      {"Output", {"--store", "--templates"}}});
  return [arguments](const Invocation& invocation) { return nightly(*arguments, invocation); };
}

}  // namespace mapproof
