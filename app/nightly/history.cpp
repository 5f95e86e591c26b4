#include "app/commands.hpp"

#include <iostream>
#include <memory>

#include <fmt/format.h>

#include "app/nightly/history_report.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/text/words.hpp"
#include "core/json/json_text.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "reports/history/history_export.hpp"
#include "reports/history/history_prune.hpp"
#include "reports/history/object_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

struct HistoryArguments {
  std::string store;
  std::optional<std::string> prune;
  std::optional<std::string> format;
  std::optional<int> pin;
  bool verify = false;
};

int list(HistoryStore& history, const Console& console) {
  std::string text;
  for (const NightlyFacts& nightly_run : history.nightly_runs()) {
    text += fmt::format("{:>5}  {}  {:<12}{}", nightly_run.number, nightly_run.started_utc,
                        verdict_word(nightly_run), nightly_run.pinned ? "  pinned" : "");
    for (const NightlyStudy& study : history.studies(nightly_run.number))
      text += fmt::format("  {} ({})", study.name, counted(study.runs, "run"));
    text += "\n";
    for (const NightlyFinding& finding : history.findings(nightly_run.number))
      text += fmt::format("         {}: {}\n", finding.study, finding.sentence);
  }
  if (text.empty()) text = "no nightly run yet\n";
  // The result of a command; the exported file names its own schema.
  nlohmann::ordered_json object = history_json(history, false);
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

int prune_by(HistoryStore& history, const HistoryArguments& arguments,
             const Invocation& invocation) {
  const Console& console = invocation.console;
  const FolderLock lock(arguments.store, [&] {
    console.warning(arguments.store + ": a nightly run is being made in it; waiting for its end");
  });
  const Pruned pruned = prune(history, arguments.store, parse_prune_rule(*arguments.prune));
  std::error_code error;
  if (fs::exists(fs::path(arguments.store) / "index.html", error))  // Its links are to be true.
    write_history_pages(
        history, {arguments.store, arguments.store, load_templates(), 1, invocation.disclosure},
        {});
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
  std::error_code error;
  if (!fs::exists(history_file(arguments.store), error))
    throw IoError(arguments.store, "holds no history.sqlite; mapproof nightly makes one");
  refuse_links_out(arguments.store);
  HistoryStore history = HistoryStore::open_existing(arguments.store);
  if (arguments.prune) return prune_by(history, arguments, invocation);
  if (arguments.verify) return verify(history, arguments.store, console);
  if (arguments.pin) {
    history.pin(*arguments.pin);
    console.result(fmt::format("nightly run {} is pinned\n", *arguments.pin),
                   {{"pinned", *arguments.pin}});
    return kDone;
  }
  if (!arguments.format) return list(history, console);
  std::cout << (*arguments.format == "csv" ? history_csv(history)
                                           : json_text(history_json(history, true)));
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
      "  mapproof history history --export csv > nightly_runs.csv\n\n"
      "Later nightly runs are compared with a pinned one: pin a nightly run to accept its "
      "changes.\n"
      "--verify ends with 1 if the history or a figure in it is not whole.\n");
  app.add_option("STORE", arguments->store, "Folder of the history, the --store of nightly")
      ->required()
      ->check(names_folder());
  auto* what = app.add_option_group("what");
  what->add_option(
      "--prune", arguments->prune,
      "Remove all nightly runs except the last N, those whose number K divides, the pinned ones "
      "and their reference runs: last=N,every=K");
  what->add_option("--export", arguments->format,
                   "Every value of every nightly run, to standard output")
      ->transform(one_of({"csv", "json"}));
  what->add_option("--pin", arguments->pin, "Compare with this nightly run from now on")
      ->check(CLI::PositiveNumber);
  what->add_flag("--verify", arguments->verify, "Check the history and every figure's bytes");
  what->require_option(0, 1);
  group_options(app, {{"Task", {"--prune", "--export", "--pin", "--verify"}}});
  return [arguments](const Invocation& invocation) { return history_of(*arguments, invocation); };
}

}  // namespace mapproof
