#include "app/commands.hpp"

#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <ctime>
#include <memory>
#include <set>
#include <span>
#include <stdexcept>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/build_facts.hpp"
#include "app/nightly/history_report.hpp"
#include "app/nightly/nightly_folders.hpp"
#include "app/nightly/nightly_outputs.hpp"
#include "app/nightly/nightly_study.hpp"
#include "app/nightly/tested_commit.hpp"
#include "app/study/embedded_experiments.hpp"
#include "app/study/folder_report.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/text/retired_names.hpp"
#include "core/base/version.hpp"
#include "core/json/record_writer.hpp"
#include "core/records/value_fields.hpp"
#include "reports/history/history_export.hpp"
#include "reports/history/history_prune.hpp"
#include "reports/history/judge_nightly_run.hpp"
#include "reports/history/nightly_scores.hpp"
#include "reports/history/nightly_standing.hpp"
#include "reports/history/nightly_summary.hpp"
#include "reports/history/pages/history_pages.hpp"
#include "reports/history/pages/nightly_links.hpp"
#include "reports/history/store/object_folder.hpp"

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
  std::vector<std::string> metrics;
  std::optional<std::string> better;
  CommitOptions commit;
  std::string build;
  std::optional<int> bisect;
  NightlyWishes wishes;
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

/// Seconds east of UTC, now.
int utc_offset_s() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  return ::localtime_r(&now, &local) == nullptr ? 0 : static_cast<int>(local.tm_gmtoff);
}

NightlyFacts begun(int number, int jobs, const SessionNames& names) {
  utsname system{};
  return {.number = number,
          .started_utc = now_utc(),
          .utc_offset_s = utc_offset_s(),
          .ended_utc = "",
          .command = names.command,
          .provenance = json_line(to_json_value(build_provenance())),
          .host = names.host,
          .processor = ::uname(&system) == 0 ? system.machine : "",
          .cores = static_cast<int>(std::thread::hardware_concurrency()),
          .jobs = jobs};
}

/// Makes the records of every study. @return The worst exit code.
int make_all(const std::vector<StudyRequest>& requests, const fs::path& folder,
             const NightlyFacts& facts, const Console& console) {
  const std::string of = fmt::format("nightly run {} is not recorded: ", facts.number);
  int worst = kDone;
  for (const StudyRequest& request : requests)
    worst = std::max(worst, make_apart(request, folder / request.name, facts.jobs,
                                       {facts.command, facts.host}, console, of));
  return worst;
}

/// Each study of a nightly run that is not recorded yet, over the nightly runs.
std::vector<StudyTrend> trends_with(HistoryStore& history, const NightlyRun& nightly_run) {
  std::vector<StudyTrend> trends;
  for (const NightlyStudy& study : nightly_run.studies) {
    trends.push_back(history.trend(study.name, study.experiment_digest, kTrendRuns,
                                   nightly_run.facts.number - 1));
    add_this_run(trends.back(), nightly_run.facts, study);
  }
  return trends;
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

/// Whether the store has the folder of a study of a nightly run.
bool has_folder(const fs::path& store, int nightly_run, const std::string& study) {
  std::error_code error;
  return fs::exists(nightly_folder(store, nightly_run) / study / "study.json", error);
}

/// A page that compares the nightly runs between which something new began in a study.
struct PlannedComparison {
  std::string study = {};
  CommitRange commits = {};

  std::string file() const {
    return comparison_file(commits.before.number, commits.since.number, study);
  }
};

/// The pages that are not there yet.
std::vector<PlannedComparison> planned_comparisons(std::span<const FindingGroup> groups,
                                                   const HistoryOutputs& outputs) {
  std::set<std::string> there = comparisons_in(outputs.out);
  std::vector<PlannedComparison> plan;
  for (const FindingGroup& group : groups) {
    const PlannedComparison comparison{group.study, group.commits};
    const int before = group.commits.before.number, since = group.commits.since.number;
    if (!group.known && before != 0 && has_folder(outputs.store, before, group.study) &&
        has_folder(outputs.store, since, group.study) && there.insert(comparison.file()).second)
      plan.push_back(comparison);
  }
  return plan;
}

/// Draws the reports of a nightly run that has been judged, and keeps their figures.
class ReportWriter {
 public:
  ReportWriter(NightlyRun& nightly_run, HistoryStore& history, fs::path folder,
               const HistoryOutputs& outputs, const Invocation& invocation)
      : nightly_run_(nightly_run),
        history_(history),
        folder_(std::move(folder)),
        outputs_(outputs),
        invocation_(invocation),
        lost_(history.nightly_runs().empty() ? lost_nightly_runs(outputs.store, {})
                                             : LostNightlyRuns{}),
        groups_(grouped(nightly_run.facts.number, nightly_run.findings,
                        trends_with(history, nightly_run), history.notes())),
        plan_(planned_comparisons(groups_, outputs)) {}

  const std::vector<PlannedComparison>& plan() const { return plan_; }

  /// Of each study, with links to all comparisons that are planned.
  /// @return Whether all scenes could be drawn.
  bool write_all() {
    std::set<std::string> comparisons = comparisons_in(outputs_.out);
    for (const PlannedComparison& comparison : plan_) comparisons.insert(comparison.file());
    bool scenes_drawn = true;
    for (NightlyStudy& study : nightly_run_.studies) scenes_drawn &= write(study, comparisons);
    return scenes_drawn;
  }

  /// Of each study again whose report links to a comparison that could not be made.
  void write_without_failed() {
    const std::set<std::string> there = comparisons_in(outputs_.out);
    for (NightlyStudy& study : nightly_run_.studies)
      if (std::ranges::any_of(plan_, [&](const PlannedComparison& comparison) {
            return comparison.study == study.name && !there.contains(comparison.file());
          }))
        write(study, there);
  }

 private:
  bool write(NightlyStudy& study, const std::set<std::string>& comparisons) {
    const std::optional<int> reference = nightly_run_.facts.reference;
    FolderReport report =
        read_folder_report(folder_ / study.name, invocation_.command, invocation_.command);
    NightlyLinks links(paths_from(folder_ / study.name, outputs_.out, outputs_.store));
    add_nightly_run(report.report,
                    {.nightly_run = nightly_run_,
                     .name = study.name,
                     .is_compared = reference && has_study(history_, *reference, study),
                     .lost = lost_,
                     .groups = groups_,
                     .figures = report.figures,
                     .comparisons = comparisons},
                    links);
    report.link_words = links.words();
    const bool scenes_drawn = draw(report, outputs_, invocation_.console);
    study.figures = ObjectFolder(outputs_.store / "objects").keep(folder_ / study.name / "figures");
    return scenes_drawn;
  }

  NightlyRun& nightly_run_;
  HistoryStore& history_;
  fs::path folder_;
  const HistoryOutputs& outputs_;
  const Invocation& invocation_;
  LostNightlyRuns lost_;
  std::vector<FindingGroup> groups_;
  std::vector<PlannedComparison> plan_;
};

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

/// Where to search for what got worse, once per nightly run in which something began.
std::string commits_text(const NightlySummary& summary) {
  std::string text;
  std::set<int> named;
  for (const FindingGroup& group : summary.groups)
    if (!group.known && group.commits.has_commits() &&
        named.insert(group.commits.since.number).second) {
      text += fmt::format("  {}: commits {}\n    {}\n", group.commits.words(), group.commits.text(),
                          group.commits.bisect());
      if (const std::string gaps = group.commits.bisect_gaps(); !gaps.empty())
        text += "    " + gaps + "\n";
    }
  return text;
}

/// The first findings of each study, and where all of them stand.
std::string nightly_text(const NightlyRun& nightly_run, const NightlySummary& summary,
                         const fs::path& pages) {
  std::string text = fmt::format("nightly run {}: {}\n", nightly_run.facts.number,
                                 verdict_sentence(nightly_run.facts, summary.groups));
  for (const FindingGroup& group : summary.groups)
    if (group.known)
      text +=
          fmt::format("  {}: {}, known: {}\n", group.study, group.headline(), group.known->text);
  for (const NightlyStudy& study : nightly_run.studies) {
    std::size_t count = 0;
    for (const FindingGroup& group : summary.groups)
      for (const std::string& sentence : group.sentences)
        if (group.study == study.name && !group.known && ++count <= kMostReported)
          text += fmt::format("  {}: {}\n", study.name, sentence);
    if (count > kMostReported)
      text +=
          fmt::format("  {}: and {} more: {}#section-findings\n", study.name, count - kMostReported,
                      (pages / "trends" / study.name / "report.html").string());
  }
  text += commits_text(summary);
  for (const std::string& remark : summary.remarks) text += fmt::format("  ({})\n", remark);
  return text;
}

/// Writes the pages that are planned. A failure is a warning: the nightly run is recorded already.
void compare_where_it_began(std::span<const PlannedComparison> plan, const IndexFacts& facts,
                            const HistoryOutputs& outputs, const Console& console) {
  for (const PlannedComparison& comparison : plan) {
    const auto& [before, since] = comparison.commits;
    try {
      write_comparisons(
          {before, since, {comparison.study}, groups_between(facts, before.number, since.number)},
          outputs);
    } catch (const std::runtime_error& error) {
      console.warning(error.what());
    }
  }
}

/// What a nightly run ended with.
struct NightlyEnd {
  int exit_code = kDone;
  NightlySummary summary = {};
  fs::path index = {};  ///< Empty: it is not recorded.
};

/// Writes the pages of a history, and those that compare. @return How its last nightly run ended.
NightlyEnd write_pages(HistoryStore& history, const std::vector<std::string>& remarks,
                       std::span<const PlannedComparison> plan, const HistoryOutputs& outputs,
                       const Console& console) {
  IndexFacts facts = read_index_facts(history, outputs, remarks);
  NightlyEnd end{.summary = last_summary(facts)};
  compare_where_it_began(plan, facts, outputs, console);
  facts.comparisons = comparisons_in(outputs.out);
  end.index = write_history_pages(history, outputs, facts);
  end.exit_code = exit_code(end.summary.verdict());
  return end;
}

void say(const NightlyRun& nightly_run, const NightlyEnd& end, const fs::path& pages,
         const Console& console) {
  nlohmann::ordered_json object = nightly_value(nightly_run.facts, nightly_run.findings);
  object["new_findings"] = end.summary.new_findings();
  object["remarks"] = end.summary.remarks;
  object["index"] = end.index.string();
  console.result(nightly_text(nightly_run, end.summary, pages) + end.index.string() + "\n", object);
}

/// The facts of a nightly run that begins, with the commit that it measures.
NightlyFacts facts_of(int number, const NightlyArguments& arguments, const SessionNames& names,
                      const TestedCommit& commit, const Disclosure& disclosure) {
  NightlyFacts facts = begun(number, arguments.jobs, names);
  facts.commit = commit.id;
  facts.repository = commit.repository;
  facts.build = disclosure.words({arguments.build}).front();
  return facts;
}

/// The commit that is asked for, else what a file of metrics says, else that of the folder here.
TestedCommit measured_commit(CommitOptions options, const TestedCommit& of_metrics) {
  if (!options.commit && !of_metrics.id.empty()) {
    options.commit = of_metrics.id;
    if (!options.repository && !of_metrics.repository.empty())
      options.repository = of_metrics.repository;
  }
  return tested_commit(options, {std::string(source_commit()), ""});
}

NightlyEnd make_nightly_run(const NightlyArguments& arguments, NightlyRequests requests,
                            const Invocation& invocation) {
  const Console& console = invocation.console;
  const Templates page = load_templates(arguments.templates);
  const std::optional<int> asked = asked_reference(arguments.reference);
  const fs::path store = arguments.store;
  const HistoryOutputs outputs{store, out_of(arguments), page, arguments.jobs,
                               invocation.disclosure};
  const SessionNames names{invocation.command, invocation.disclosure.host()};
  const TestedCommit commit = measured_commit(arguments.commit, requests.commit);
  make_folder(store);
  const FolderLock lock = lock_store(store, outputs.out, [&] {
    console.warning(store.string() +
                    ": another mapproof runs in it; waiting, since two at once would spoil "
                    "each other's seconds");
  });
  refuse_links_out(store);
  if (outputs.out != store) refuse_links_out(outputs.out);
  HistoryStore history = HistoryStore::open(store);
  for (const std::string& remark : history.remarks()) console.warning(remark);

  NightlyRun nightly_run{.facts = facts_of(next_nightly_run(history, store), arguments, names,
                                           commit, invocation.disclosure)};
  if (asked) {  // Refused before hours of work.
    nightly_run.studies = planned_studies(requests.studies);
    reference_nightly_run(history, nightly_run, asked);
  }
  const fs::path folder = nightly_folder(store, nightly_run.facts.number);
  say_when_stopped(kContinuesWord);
  begin_nightly_run(folder, requests.studies, console);
  const int made = make_all(requests.studies, folder, nightly_run.facts, console);
  if (made != kDone) return {.exit_code = made};
  for (StudyRequest& request : requests.studies) request.table.reset();  // It is in the folder now.
  nightly_run.studies = read_nightly_studies(requests.studies, folder);
  std::vector<std::string> remarks = judge_nightly_run(history, nightly_run, asked);
  remarks.insert(remarks.end(), requests.remarks.begin(), requests.remarks.end());
  ReportWriter reports(nightly_run, history, folder, outputs, invocation);
  const bool scenes_drawn = reports.write_all();
  nightly_run.facts.ended_utc = now_utc();
  history.append(nightly_run);
  end_nightly_run(folder, nightly_run);
  for (NightlyStudy& study : nightly_run.studies) study.scores.clear();  // They are in the history.
  NightlyEnd end = write_pages(history, remarks, reports.plan(), outputs, console);
  reports.write_without_failed();
  write_summaries(end.summary, arguments.wishes, outputs.disclosure);
  say(nightly_run, end, outputs.out, console);
  if (!scenes_drawn) end.exit_code = kInternal;
  return end;
}

int nightly(const NightlyArguments& arguments, const Invocation& invocation) {
  NightlyRequests requests = read_nightly_requests(
      {.experiments = arguments.experiments,
       .metrics = arguments.metrics,
       .better = arguments.better ? better_named(*arguments.better) : std::nullopt,
       .options = arguments.request},
      invocation.disclosure);
  if (arguments.bisect)
    return bisect(requests,
                  {arguments.store,
                   *arguments.bisect,
                   arguments.jobs,
                   {invocation.command, invocation.disclosure.host()}},
                  invocation.console);
  const NightlyEnd end = make_nightly_run(arguments, std::move(requests), invocation);
  // The history is free again: the command may ask it.
  if (!end.index.empty())
    run_on_worse(end.summary, arguments.wishes, end.index, invocation.console);
  return end.exit_code;
}

void add_commit_options(CLI::App& app, NightlyArguments& arguments) {
  app.add_option(
         "--commit", arguments.commit.commit,
         "Commit that is measured, or none; by default what --metrics says, else HEAD of the git "
         "repository here, else that of this program")
      ->type_name("ID");
  app.add_option("--repository-url", arguments.commit.repository,
                 "Address of the repository for links to commits, or none; by default that of the "
                 "remote origin")
      ->type_name("URL");
  app.add_option("--build", arguments.build,
                 "Command that builds what is measured, and makes its metrics, for the line of git "
                 "bisect")
      ->type_name("COMMAND");
  app.add_option("--bisect", arguments.bisect,
                 "For git bisect: record nothing; end with 0 if what got worse in nightly run N is "
                 "as before it, with 1 if not, with 125 if it cannot be tested")
      ->type_name("N")
      ->check(above_zero());
}

void add_wish_options(CLI::App& app, NightlyWishes& wishes) {
  app.add_option("--markdown", wishes.markdown, "Write a summary in Markdown, e.g. nightly.md")
      ->type_name("FILE");
  app.add_option("--junit", wishes.junit, "Write the verdicts as JUnit XML, e.g. nightly.junit.xml")
      ->type_name("FILE");
  app.add_option("--on-worse", wishes.on_worse,
                 "Run a command of the shell if something new got worse; it reads the summary in "
                 "Markdown")
      ->type_name("COMMAND");
}

}  // namespace

Action nightly_command(CLI::App& app) {
  auto arguments = std::make_shared<NightlyArguments>();
  app.description("Run experiments, add them to a history, and report what got worse");
  app.footer(
      "Examples:\n"
      "  mapproof nightly yairi2007 --store history\n"
      "  mapproof nightly mine.json boots2013 --profile quick --store history --reference 12\n"
      "  mapproof nightly --metrics bench.json --better lower --store history --markdown "
      "nightly.md\n"
      "  mapproof nightly bench/results.csv --better lower --store history\n"
      "  mapproof nightly --metrics bench.json --store history --on-worse 'mail -s worse me'\n\n"
      "Exit codes:\n"
      "  0  nothing got worse, or there was no run to compare with\n"
      "  1  accuracy got worse, or results are lost\n"
      "  2  wrong usage or input\n"
      "  3  internal error\n"
      "  4  only seconds or memory grew\n"
      "  125  with --bisect: the commit cannot be tested\n\n"
      "docs/nightly.md has the rules, and shows how to run it by a timer.\n");
  app.add_option(
      "EXPERIMENT", arguments->experiments,
      fmt::format(
          "Experiments' JSON files, a results.csv of any program or folders with one, or {}",
          fmt::join(experiment_names(), ", ")));
  app.add_option("--metrics", arguments->metrics,
                 "Numbers of another program: JSON of mapproof.metrics, github-action-benchmark, "
                 "Google Benchmark or pytest-benchmark; several times")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_option("--better", arguments->better,
                 "Which way metrics improve whose file does not say it, and quantities of a "
                 "results.csv without study.json")
      ->transform(one_of({"lower", "higher"}));
  add_commit_options(app, *arguments);
  add_wish_options(app, arguments->wishes);
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
  group_options(app,
                {{"Input", {"EXPERIMENT", "--metrics", "--better"}},
                 {"Experiment", {"--profile"}},
                 {"Comparison", {"--reference", "--bisect"}},
                 {"Commits", {"--commit", "--repository-url", "--build"}},
                 {"Output", {"--store", "--templates", "--markdown", "--junit", "--on-worse"}}});
  return [arguments](const Invocation& invocation) { return nightly(*arguments, invocation); };
}

}  // namespace mapproof
