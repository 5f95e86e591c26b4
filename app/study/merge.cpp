#include <memory>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands.hpp"
#include "app/failures.hpp"
#include "app/study/study_outputs.hpp"
#include "app/study/study_run.hpp"
#include "core/base/errors.hpp"
#include "core/studies/shard.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

struct MergeArguments {
  std::vector<std::string> shards;
  std::string out;
  bool check = false;
};

void check_out(const MergeArguments& arguments) {
  if (arguments.check != arguments.out.empty())
    throw InvalidInput(arguments.check ? "--check: writes nothing; leave --out away"
                                       : "--out: name a folder for the study, or give --check");
  std::error_code error;
  for (const std::string& shard : arguments.shards)
    if (!arguments.out.empty() && fs::equivalent(shard, arguments.out, error))
      throw InvalidInput("--out: " + arguments.out + " is one of the shards");
}

nlohmann::ordered_json shards_object(const ShardUnion& shards) {
  auto list = nlohmann::ordered_json::array();
  for (const ShardFolder& shard : shards.shards)
    list.push_back({{"folder", shard.folder.string()},
                    {"shard", text_of(shard.session.shard)},
                    {"processors", shard.processors}});
  return list;
}

std::vector<std::string> texts_of(const std::vector<Shard>& shards) {
  std::vector<std::string> texts;
  for (const Shard& shard : shards) texts.push_back(text_of(shard));
  return texts;
}

void warn_of(const ShardUnion& shards, const Console& console) {
  for (const std::string& damaged : shards.damaged) console.warning(damaged);
  if (shards.processors.size() > 1)
    console.warning(
        fmt::format("the shards were made on {} kinds of processor ({}): their records are those "
                    "of one run within the tolerance across processors, not to the byte",
                    shards.processors.size(), fmt::join(shards.processors, "; ")));
}

/// The commands that make the same study and its report in one run.
std::string command_again(const MergeArguments& arguments, const ShardUnion& shards,
                          const Disclosure& disclosure) {
  return command_of_one_run(shards.shards.front().session) + " " +
         quoted_command(disclosure.words({"--out", arguments.out})) + " && " +
         quoted_command(disclosure.words({"mapproof", "report", arguments.out}));
}

/// Prints the shards that have to be run.
int check(const ShardUnion& shards, const Console& console) {
  const std::vector<std::string> open = texts_of(shards.open);
  console.info(fmt::format("{} of {} tasks are there, in {} folders", shards.found.size(),
                           shards.tasks, shards.shards.size()));
  console.result(open.empty() ? "" : fmt::format("{}\n", fmt::join(open, "\n")),
                 {{"tasks", shards.tasks},
                  {"found", shards.found.size()},
                  {"open", open},
                  {"processors", shards.processors},
                  {"shards", shards_object(shards)}});
  return open.empty() ? kDone : kNo;
}

int merge(const MergeArguments& arguments, const Invocation& invocation) {
  check_out(arguments);
  const SessionClock clock;
  const Console& console = invocation.console;
  const std::vector<fs::path> folders(arguments.shards.begin(), arguments.shards.end());
  ShardUnion shards;
  {
    const CountProgress progress = count_progress(console, "reading");
    shards = read_shards(folders, [&](std::size_t read) { progress(read, folders.size()); });
  }
  for (const std::string& refusal : shards.refusals) report_failure(refusal, kUsage);
  if (!shards.refusals.empty()) return kUsage;
  warn_of(shards, console);
  for (const std::string& missing : shards.missing) console.warning(missing);
  if (arguments.check) return check(shards, console);
  if (!shards.open.empty())
    return report_failure(
        fmt::format("{}: not written: {} of {} tasks are missing", arguments.out,
                    shards.tasks - static_cast<int>(shards.found.size()), shards.tasks),
        kNo);
  const SessionNames names{command_again(arguments, shards, invocation.disclosure),
                           invocation.disclosure.host()};
  say_when_stopped(kContinuesWord);
  {
    const ProgressLine line(console, "writing");
    merge_shards(shards, arguments.out, [&] { return clock.session(names, 1); });
  }
  StudyNumbers numbers = outputs_of_study(arguments.out).numbers(arguments.out);
  numbers.object["study"] = arguments.out;
  numbers.object["processors"] = shards.processors;
  numbers.object["shards"] = shards_object(shards);
  console.info(fmt::format("next: {} draws its figures and writes the report",
                           quoted_command({"mapproof", "report", arguments.out})));
  console.result(numbers.text + arguments.out + "\n", numbers.object);
  return kDone;
}

}  // namespace

Action merge_command(CLI::App& app) {
  auto arguments = std::make_shared<MergeArguments>();
  app.description("Put the shards of an experiment together into the study that one run makes");
  app.footer(
      "Examples:\n"
      "  mapproof run yairi2007 --shard 1/2 --out out/shards/1\n"
      "  mapproof run yairi2007 --shard 2/2 --out out/shards/2\n"
      "  mapproof merge out/shards/* --out out/study\n"
      "  mapproof merge out/shards/* --check\n\n"
      "On one kind of processor the study has the bytes of one run, its seconds apart. Shards of\n"
      "other seeds, versions or data are refused; those that are missing, damaged or half done "
      "are\n"
      "named with the command that makes them, and nothing is written. docs/clusters.md shows it\n"
      "with Slurm, GNU parallel and a CI.\n");
  app.add_option("SHARD", arguments->shards, "Folders of run --shard, in any order")->required();
  add_out_option(app, arguments->out, "Folder for the study");
  app.add_flag("--check", arguments->check,
               "Write nothing; print the shards that have to be run, a line each")
      ->group("Output");
  return [arguments](const Invocation& invocation) { return merge(*arguments, invocation); };
}

}  // namespace mapproof
