#include "app/commands.hpp"

#include <memory>
#include <optional>

#include <fmt/format.h>

#include "app/study/study_outputs.hpp"
#include "app/study/study_request.hpp"
#include "app/study/study_run.hpp"
#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/studies/shard.hpp"

namespace mapproof {
namespace {

struct RunArguments {
  std::string experiment;
  std::string out;
  int jobs = 1;
  std::optional<Shard> shard;
  StudyOptions options{.profile = "full"};
};

/// The two commands that make the same study and a report of it, wherever they are typed; of a
/// shard the one that makes it.
std::string command_again(const RunArguments& arguments, const StudyRequest& request,
                          const Disclosure& disclosure) {
  std::vector<std::string> words = {"mapproof", "run", arguments.experiment};
  const std::vector<std::string> more = words_of({&request, 1}, arguments.options);
  words.insert(words.end(), more.begin(), more.end());
  if (request.shard) words.insert(words.end(), {"--shard", text_of(request.shard->shard)});
  words.insert(words.end(), {"--out", arguments.out});
  if (request.shard) return quoted_command(disclosure.words(words));
  return quoted_command(disclosure.words(words)) + " && " +
         quoted_command(disclosure.words({"mapproof", "report", arguments.out}));
}

int run(const RunArguments& arguments, const Invocation& invocation) {
  std::optional<ProgressLine> reading(std::in_place, invocation.console, "reading");
  StudyRequest request = read_study_request(experiment_of(arguments.experiment), arguments.options,
                                            invocation.disclosure);
  check_data_used({&request, 1}, arguments.options);
  reading.reset();
  if (arguments.shard) {
    request.shard = shard_session(request.plan, *arguments.shard);
    request.plan = share_of(request.plan, *arguments.shard);
  }
  make_study(
      request, arguments.out, arguments.jobs,
      {command_again(arguments, request, invocation.disclosure), invocation.disclosure.host()},
      invocation.console);
  StudyNumbers numbers = outputs_of_study(arguments.out).numbers(arguments.out);
  numbers.object["study"] = arguments.out;
  if (request.shard) {
    numbers.object["shard"] = text_of(request.shard->shard);
    invocation.console.info(fmt::format(
        "shard {} ran {} of {}; the numbers cover these alone, mapproof merge puts all "
        "shards together",
        text_of(request.shard->shard), share_size(request.shard->shard, request.shard->tasks),
        counted(request.shard->tasks, "task")));
  } else {
    invocation.console.info(fmt::format("next: {} draws its figures and writes the report",
                                        quoted_command({"mapproof", "report", arguments.out})));
  }
  invocation.console.result(numbers.text + arguments.out + "\n", numbers.object);
  return kDone;
}

}  // namespace

Action run_command(CLI::App& app) {
  auto arguments = std::make_shared<RunArguments>();
  app.description("Run an experiment and write its records, nothing else");
  app.footer(
      "Examples:\n"
      "  mapproof run yairi2007 --profile quick --out out/study\n"
      "  mapproof run boots2013 --plaza plaza --out out/range\n"
      "  mapproof run yairi2007 --shard 2/8 --out out/shards/2\n\n"
      "mapproof reproduce NAME --print prints an experiment to begin with. docs/file-formats.md "
      "says what its file holds.\n");
  app.add_option("EXPERIMENT", arguments->experiment,
                 "The experiment's JSON file, or the name of one")
      ->required();
  add_out_option(app, arguments->out, "Folder for the records")->required();
  app.add_option("--profile", arguments->options.profile,
                 "One of the profiles in the file, such as quick; full is all of it")
      ->capture_default_str()
      ->group("Experiment");
  app.add_option_function<std::string>(
         "--shard",
         [arguments](const std::string& text) {
           arguments->shard = shard_of_text(text);
           if (!arguments->shard)
             throw CLI::ValidationError(
                 "--shard", "\"" + printable(text) + "\" is not I/N, 1 <= I <= N, such as 2/8");
         },
         "Run every N-th task from the I-th on; mapproof merge puts the shards together")
      ->type_name("I/N")
      ->group("Experiment");
  add_jobs_option(app, arguments->jobs);
  add_experiment_options(app, arguments->options.changes);
  add_data_options(app, arguments->options);
  return [arguments](const Invocation& invocation) { return run(*arguments, invocation); };
}

}  // namespace mapproof
