#include "app/commands.hpp"

#include <algorithm>
#include <ctime>
#include <iostream>
#include <iterator>
#include <memory>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "app/nightly/history_report.hpp"
#include "app/nightly/nightly_folders.hpp"
#include "app/nightly/nightly_outputs.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/files/paths.hpp"
#include "core/base/text/words.hpp"
#include "core/json/json_text.hpp"
#include "reports/history/finding_groups.hpp"
#include "reports/history/history_export.hpp"
#include "reports/history/history_prune.hpp"
#include "reports/history/judge_nightly_run.hpp"
#include "reports/history/store/object_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

struct HistoryArguments {
  std::string store;
  std::optional<std::string> prune;
  std::optional<std::string> format;
  std::optional<int> pin;
  bool verify = false;
  std::vector<std::string> note, known, accept;  ///< A target and a text each.
  std::optional<std::string> decisions;          ///< File.
  std::vector<int> compare;
};

int list(HistoryStore& history, const Console& console) {
  std::string text;
  const std::vector<NightlyNote> notes = history.notes();
  for (const NightlyFacts& nightly_run : history.nightly_runs()) {
    text += fmt::format("{:>5}  {}  {:<9}  {:<12}{}", nightly_run.number, nightly_run.started_utc,
                        short_commit(nightly_run.commit), verdict_word(nightly_run),
                        nightly_run.pinned ? "  pinned" : "");
    for (const NightlyStudy& study : history.studies(nightly_run.number))
      text += fmt::format("  {} ({})", study.name, counted(study.runs, "run"));
    text += "\n";
    int index = 0;
    for (const NightlyFinding& finding : history.findings(nightly_run.number)) {
      const NightlyNote* known = known_by(notes, finding);
      text += fmt::format("{:>8}.{}  {}: {}{}\n", nightly_run.number, ++index, finding.study,
                          finding.sentence, known == nullptr ? "" : "; known: " + known->text);
    }
    for (const NightlyNote& note : notes_on(nightly_run.number, notes))
      if (note.kind != NoteKind::kKnown)
        text += fmt::format(
            "         {}{}: {}\n", name(note.kind),
            note.finding == 0 ? "" : fmt::format(" on {}.{}", note.nightly_run, note.finding),
            note.text);
  }
  if (text.empty()) text = "no nightly run yet\n";
  // The result of a command; the exported file names its own schema.
  nlohmann::ordered_json object = history_json(history);
  object.erase("schema");
  console.result(text, object);
  return kDone;
}

int verify(HistoryStore& history, const fs::path& store, const Console& console) {
  const std::vector<std::string> digests = history.digests();
  const std::vector<std::string> problems = ObjectFolder(store / "objects").problems(digests);
  std::string text;
  for (const std::string& problem : problems) text += printable(problem, 4000) + "\n";
  if (problems.empty())
    text =
        fmt::format("{} and {} are whole\n",
                    counted(static_cast<long long>(history.nightly_runs().size()), "nightly run"),
                    counted(static_cast<long long>(digests.size()), "figure file"));
  console.result(text, {{"whole", problems.empty()}, {"problems", problems}});
  return problems.empty() ? kDone : kNo;
}

/// Writes the pages again where there are some: they are to show what changed.
void write_pages_again(HistoryStore& history, const HistoryArguments& arguments,
                       const Invocation& invocation) {
  std::error_code error;
  if (!fs::exists(fs::path(arguments.store) / "index.html", error)) return;
  const Templates page = load_templates();
  const HistoryOutputs outputs{arguments.store, arguments.store, page, 1, invocation.disclosure};
  write_history_pages(history, outputs, read_index_facts(history, outputs, {}));
}

FolderLock locked(const HistoryArguments& arguments, const Console& console) {
  return lock_store(arguments.store, arguments.store, [&] {
    console.warning(arguments.store + ": a nightly run is being made in it; waiting for its end");
  });
}

/// Notes on the other settings of the method that a note is about: pages show them as one finding.
void add_settings(HistoryStore& history, std::vector<NightlyNote>& notes) {
  std::vector<NightlyNote> more;
  for (const NightlyNote& note : notes) {
    if (note.finding == 0) continue;
    std::vector<StudyTrend> trends;
    for (const NightlyStudy& study : history.studies(note.nightly_run))
      trends.push_back(
          history.trend(study.name, study.experiment_digest, kTrendRuns, note.nightly_run));
    const std::vector<NightlyFinding> findings = history.findings(note.nightly_run);
    for (const FindingGroup& group : grouped(note.nightly_run, findings, trends, {}))
      if (std::ranges::find(group.numbers, note.finding) != group.numbers.end())
        for (const int number : group.numbers)
          if (number != note.finding) {
            more.push_back(note);
            more.back().finding = number;
          }
  }
  notes.insert(notes.end(), more.begin(), more.end());
}

/// What the options say, as notes; one per finding of what is known of a whole nightly run.
std::vector<NightlyNote> asked_notes(HistoryStore& history, const HistoryArguments& arguments) {
  std::vector<NightlyNote> asked;
  const auto add = [&](const std::vector<std::string>& words, NoteKind kind,
                       std::string_view option) {
    if (!words.empty()) asked.push_back(note_of({words[0], kind, words[1]}, option));
  };
  add(arguments.known, NoteKind::kKnown, "--known");
  add_settings(history, asked);
  add(arguments.note, NoteKind::kNote, "--note");
  add(arguments.accept, NoteKind::kAccepted, "--accept");
  if (arguments.decisions)  // They name each setting.
    std::ranges::move(parse_decisions(read_file(*arguments.decisions), *arguments.decisions),
                      std::back_inserter(asked));
  std::vector<NightlyNote> notes;
  for (const NightlyNote& note : asked) {
    const std::vector<NightlyFinding> findings = history.findings(note.nightly_run);
    if (note.kind == NoteKind::kKnown && findings.empty())
      throw InvalidInput(fmt::format("nightly run {} has no finding", note.nightly_run));
    std::ranges::move(by_finding(note, findings), std::back_inserter(notes));
  }
  for (NightlyNote& note : notes)
    note.written_utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  return notes;
}

int note_in(HistoryStore& history, const HistoryArguments& arguments,
            const Invocation& invocation) {
  const FolderLock lock = locked(arguments, invocation.console);
  const std::vector<NightlyNote> notes = asked_notes(history, arguments);
  history.add_notes(notes);
  write_pages_again(history, arguments, invocation);
  invocation.console.result(counted(std::ssize(notes), "note") + " written\n",
                            {{"notes", notes.size()}});
  return kDone;
}

/// Compares each study that both nightly runs have.
int compare(HistoryStore& history, const HistoryArguments& arguments,
            const Invocation& invocation) {
  const std::vector<NightlyFacts> all = history.nightly_runs();
  const auto facts_of = [&](int number) {
    const auto found = std::ranges::find(all, number, &NightlyFacts::number);
    if (found == all.end())
      throw InvalidInput(fmt::format("--compare: there is no nightly run {}", number));
    return *found;
  };
  const int before = arguments.compare[0], after = arguments.compare[1];
  NightlyPair pair{.before = facts_of(before), .after = facts_of(after)};
  const std::vector<NightlyStudy> others = history.studies(after);
  for (const NightlyStudy& study : history.studies(before))
    if (std::ranges::find(others, study.name, &NightlyStudy::name) != others.end())
      pair.studies.push_back(study.name);
  const FolderLock lock = locked(arguments, invocation.console);
  const Templates page = load_templates();
  const HistoryOutputs outputs{arguments.store, arguments.store, page, 1, invocation.disclosure};
  pair.groups = groups_between(read_index_facts(history, outputs, {}), before, after);
  const std::vector<std::string> written = write_comparisons(pair, outputs);
  if (written.empty())
    throw InvalidInput(
        fmt::format("--compare: nightly runs {} and {} have no study in common whose "
                    "files are still there",
                    before, after));
  write_pages_again(history, arguments, invocation);
  std::string text;
  for (const std::string& file : written) text += (outputs.out / file).string() + "\n";
  invocation.console.result(text, {{"pages", written}});
  return kDone;
}

int prune_by(HistoryStore& history, const HistoryArguments& arguments,
             const Invocation& invocation) {
  const Console& console = invocation.console;
  const FolderLock lock = locked(arguments, console);
  const Pruned pruned = prune(history, arguments.store, parse_prune_rule(*arguments.prune));
  write_pages_again(history, arguments, invocation);
  console.result(
      fmt::format("{} and {} removed\n",
                  counted(static_cast<long long>(pruned.nightly_runs.size()), "nightly run"),
                  counted(pruned.files, "figure file")),
      {{"removed_nightly_runs", pruned.nightly_runs}, {"removed_files", pruned.files}});
  return kDone;
}

int history_of(const HistoryArguments& arguments, const Invocation& invocation) {
  const Console& console = invocation.console;
  if (arguments.prune) parse_prune_rule(*arguments.prune);
  if (!is_there(history_file(arguments.store)))
    throw IoError(arguments.store, "holds no history.sqlite; mapproof nightly makes one");
  refuse_links_out(arguments.store);
  HistoryStore history = HistoryStore::open_existing(arguments.store);
  if (arguments.prune) return prune_by(history, arguments, invocation);
  if (arguments.verify) return verify(history, arguments.store, console);
  if (!arguments.note.empty() || !arguments.known.empty() || !arguments.accept.empty() ||
      arguments.decisions)
    return note_in(history, arguments, invocation);
  if (!arguments.compare.empty()) return compare(history, arguments, invocation);
  if (arguments.pin) {
    history.pin(*arguments.pin);
    write_pages_again(history, arguments, invocation);
    console.result(fmt::format("nightly run {} is pinned\n", *arguments.pin),
                   {{"pinned", *arguments.pin}});
    return kDone;
  }
  if (!arguments.format) return list(history, console);
  const TextSink write = [](std::string_view text) { std::cout << text; };
  *arguments.format == "csv" ? export_history_csv(history, write)
                             : export_history_json(history, write);
  std::cout.flush();
  if (!std::cout) throw IoError("standard output", "cannot be written");
  return kDone;
}

}  // namespace

Action history_command(CLI::App& app) {
  auto arguments = std::make_shared<HistoryArguments>();
  app.description("List, check, export or prune the nightly runs of a history");
  app.footer(
      "Examples:\n"
      "  mapproof history history\n"
      "  mapproof history history --prune last=30,every=7\n"
      "  mapproof history history --export csv > nightly_runs.csv\n"
      "  mapproof history history --known 7.2 \"broken sensor, issue 12\"\n"
      "  mapproof history history --accept 7 \"new solver\"\n"
      "  mapproof history history --compare 5 6\n\n"
      "Later nightly runs are compared with a pinned one: accept or pin a nightly run to "
      "accept its changes.\n"
      "A finding that is known fails no nightly run until it gets worse. An empty text removes "
      "what was said.\n"
      "--verify ends with 1 if the history or a figure in it is not whole.\n");
  app.add_option("STORE", arguments->store, "Folder of the history, the --store of nightly")
      ->required()
      ->check(names_folder());
  app.add_option(
      "--prune", arguments->prune,
      "Remove all nightly runs except the last N, those whose number K divides, the pinned ones "
      "and their reference runs: last=N,every=K");
  app.add_option("--export", arguments->format,
                 "Every value of every nightly run, to standard output")
      ->transform(one_of({"csv", "json"}));
  app.add_option("--pin", arguments->pin, "Compare with this nightly run from now on")
      ->check(above_zero());
  const auto add_note = [&](const char* option, std::vector<std::string>& words, const char* text) {
    app.add_option(option, words, text)->expected(2)->type_name("N TEXT");
  };
  add_note("--note", arguments->note,
           "Keep a text with nightly run N, or with finding K of it: N.K");
  add_note("--known", arguments->known,
           "Mark the findings of nightly run N, or finding N.K, as known, with a text");
  add_note("--accept", arguments->accept, "Pin nightly run N, with a text");
  app.add_option("--from", arguments->decisions,
                 "Take the decisions in a file that the index page saved")
      ->type_name("FILE");
  app.add_option("--compare", arguments->compare,
                 "Compare nightly runs A and B study by study, and write a page of each")
      ->expected(2)
      ->type_name("A B")
      ->check(above_zero());
  app.add_flag("--verify", arguments->verify, "Check the history and every figure's bytes");
  const std::vector<std::string> tasks = {"--prune",  "--export", "--pin",     "--note",  "--known",
                                          "--accept", "--from",   "--compare", "--verify"};
  exclude_one_another(app, tasks);
  group_options(app, {{"Task", tasks}});
  return [arguments](const Invocation& invocation) { return history_of(*arguments, invocation); };
}

}  // namespace mapproof
