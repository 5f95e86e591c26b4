#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <functional>
#include <iostream>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include "app/build_facts.hpp"
#include "app/commands.hpp"
#include "app/exit_codes.hpp"
#include "app/failures.hpp"
#include "app/help/command_facts.hpp"
#include "app/help/help_text.hpp"
#include "core/base/errors.hpp"
#include "core/base/text/retired_names.hpp"
#include "core/base/text/spelling.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {

namespace {

constexpr const char* kFooter =
    "Every command takes --json (its result as one JSON object on standard output), --quiet and "
    "--verbose, before its name or after it. Messages go to standard error. \"mapproof help "
    "COMMAND\" shows the options and examples of a command.\n";

struct Common {
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  std::string provenance = "reduced";
};

/// The commands that write where and by whom something was made.
constexpr std::array<std::string_view, 12> kWithProvenance = {
    "reproduce", "run",    "render", "report", "map",     "slam",
    "evaluate",  "import", "diff",   "check",  "nightly", "history"};

void add_common_options(CLI::App& app, Common& common) {
  app.add_flag("--json", common.json, "Print the result as one JSON object");
  auto* quiet =
      app.add_flag("-q,--quiet", common.quiet, "Print warnings, errors and the result alone");
  app.add_flag("-v,--verbose", common.verbose, "Print details")->excludes(quiet);
  if (std::ranges::find(kWithProvenance, app.get_name()) != kWithProvenance.end())
    app.add_option("--provenance", common.provenance,
                   "reduced: records and pages name no user, host or home folder, and of paths in "
                   "commands the last name; full: all of them")
        ->transform(one_of({"reduced", "full"}))
        ->capture_default_str();
}

/// What is wrong with a first word that is not a command.
std::string unknown_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string_view> commands{"help"};
  for (const CLI::App* sub : app.get_subcommands({}))
    if (!sub->get_group().empty()) commands.push_back(sub->get_name());
  const std::string_view meant = likely_word(lower_case(word), commands);
  return "unknown command \"" + printable(word) + "\"" +
         (meant.empty() ? "; \"mapproof --help\" lists them"
                        : "; did you mean \"" + std::string(meant) + "\"?");
}

/// The words of a command line, "help" and "help COMMAND" as "--help" and "COMMAND --help", and
/// flags before the command behind it.
std::vector<std::string> ordered_words(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  std::vector<std::string> first;
  constexpr std::array kMoved = {"--json", "--quiet", "--verbose", "-q", "-v"};
  while (!words.empty() && std::ranges::find(kMoved, words.front()) != kMoved.end()) {
    first.push_back(words.front());
    words.erase(words.begin());
  }
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    words.emplace_back("--help");
  }
  words.insert(words.end() - (words.empty() ? 0 : std::ssize(words) - 1), first.begin(),
               first.end());
  return words;
}

/// Whether the words are --version (or -V) and --json, in whatever order.
bool asks_for_version_json(std::span<const std::string> words) {
  const auto has = [&](std::string_view word) {
    return std::ranges::find(words, word) != words.end();
  };
  return words.size() == 2 && (has("--version") || has("-V")) && has("--json");
}

/// Options and arguments of several words, by command, of which the first alone has to be filled:
/// an empty text removes what was said of a nightly run, and a command that is checked, behind --,
/// has arguments of its own.
constexpr std::pair<std::string_view, std::string_view> kMayEndEmpty[] = {{"history", "--accept"},
                                                                          {"history", "--known"},
                                                                          {"history", "--note"},
                                                                          {"check", "EXPERIMENT"}};

[[noreturn]] void refuse_empty_value(const CLI::App& command, const CLI::Option& option) {
  throw InvalidInput(fmt::format(
      "{}: an empty value is not a value: give one, or leave it out; \"mapproof help {}\" shows "
      "what it takes",
      option.get_name(), command.get_name()));
}

/// Refuses empty values of options and arguments, which would else be as if they were not there.
/// @param command  Parsed, or as far as it could be. @throws InvalidInput.
void check_values(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const bool may_end_empty = std::ranges::any_of(kMayEndEmpty, [&](const auto& one) {
      return one.first == command.get_name() && one.second == option->get_name();
    });
    for (const std::string& word : option->results()) {
      if (word.empty()) refuse_empty_value(command, *option);
      if (may_end_empty) break;
    }
  }
}

/// Refuses words that look like options and are none of the command, and "--out=": the parser would
/// take the next word for its value.
/// @param words  Behind the command's name. @throws InvalidInput with the nearest option, or with
///               the new name of a retired one.
void check_options(const CLI::App& command, std::span<const std::string> words) {
  const std::vector<std::string> names = option_names(command);
  for (const std::string& word : words) {
    if (word == "--") return;
    const std::string name = word.substr(0, word.find('='));
    const bool is_option = name.size() > 1 && name[0] == '-' &&
                           (std::isalpha(static_cast<unsigned char>(name[1])) != 0 ||
                            (name[1] == '-' && name.size() > 2));
    if (!is_option) continue;
    if (std::ranges::find(names, name) != names.end()) {
      const CLI::Option& option = *command.get_option(name);
      const bool is_flag = option.get_items_expected_max() == 0;
      if (!is_flag && word == name + "=") refuse_empty_value(command, option);
      continue;
    }
    const std::string own = command.get_name() + " " + name;
    for (const std::string& retired : {lower_case(own), lower_case(name)})
      if (const auto now = replacement_of(NameKind::kOption, retired); !now.empty())
        throw InvalidInput(fmt::format("{}: this option is now called {}", name, now));
    // "-K6", "-jx": a short name with its value.
    if (name[1] != '-' && std::ranges::find(names, name.substr(0, 2)) != names.end()) continue;
    const std::vector<std::string_view> known(names.begin(), names.end());
    std::string meant(likely_word(lower_case(name), known));
    // Of an option with several names the first one.
    if (const CLI::Option* option = meant.empty() ? nullptr : command.get_option_no_throw(meant);
        option != nullptr && meant.starts_with("--") && !option->get_lnames().empty())
      meant = "--" + option->get_lnames().front();
    const bool is_program = command.get_parent() == nullptr;
    throw InvalidInput(fmt::format("{}: {} has no such option; {}\"mapproof {}\" lists them",
                                   printable(name), command.get_name(),
                                   meant.empty() ? "" : fmt::format("did you mean {}? ", meant),
                                   is_program ? "--help" : "help " + command.get_name()));
  }
}

/// What the parser has against the words, in one sentence.
std::string objection(const CLI::ParseError& error, const CLI::App& command) {
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr)
    return printable(error.what(), 2000);
  std::vector<std::string> extras = command.remaining();
  for (std::string& word : extras) word = "\"" + printable(word) + "\"";
  return fmt::format("{} takes no {}", command.get_name(), listed(extras, 4));
}

constexpr std::pair<const char*, AddCommand> kCommands[] = {
    {"reproduce", reproduce_command}, {"run", run_command},           {"merge", merge_command},
    {"render", render_command},       {"report", report_command},     {"map", map_command},
    {"slam", slam_command},           {"evaluate", evaluate_command}, {"export", export_command},
    {"import", import_command},       {"diff", diff_command},         {"approve", approve_command},
    {"check", check_command},         {"example", example_command},   {"methods", methods_command},
    {"results", results_command},     {"validate", validate_command}, {"nightly", nightly_command},
    {"history", history_command},     {"generate", generate_command},
};

/// Does a command's work. @param typed  The words of the command line.
int act(const Action& action, const std::string& name, const Common& common,
        std::vector<std::string> typed) {
  const Console console(common.quiet     ? Verbosity::kQuiet
                        : common.verbose ? Verbosity::kVerbose
                                         : Verbosity::kNormal,
                        common.json, name);
  typed.insert(typed.begin(), "mapproof");
  const Disclosure disclosure(common.provenance == "full");
  const Invocation invocation{.console = console,
                              .command = quoted_command(disclosure.words(typed)),
                              .disclosure = disclosure};
  say_when_stopped(kStoppedWord);
  return action(invocation);
}

int run_command_of(int argc, char** argv) {
  CLI::App app(
      "Maps from what a robot observed, without ever estimating its pose, with the evidence",
      "mapproof");
  app.formatter(help_formatter());
  app.footer(std::string(kExitCodes) + "\n" + kFooter);
  app.set_help_flag("-h,--help", "Print this help");
  app.set_version_flag("-V,--version", std::function<std::string()>(version_text),
                       "Print the versions of the program and its libraries; with --json, their "
                       "licences too");
  Common common;
  std::vector<std::pair<CLI::App*, Action>> actions;
  for (const auto& [name, command] : kCommands) {
    CLI::App* sub = app.add_subcommand(name);
    actions.emplace_back(sub, command(*sub));
    add_common_options(*sub, common);
    const bool has_codes = sub->get_footer().find("Exit codes:") != std::string::npos;
    sub->footer(sub->get_footer() + (has_codes ? "" : std::string("\n") + kExitCodes));
  }
  app.require_subcommand(0, 1);  // "map" is an ID, too: "approve BASELINE CURRENT map".

  std::vector<std::string> words = ordered_words(argc, argv);
  if (asks_for_version_json(words)) {
    Console(Verbosity::kNormal, true, "version").result("", version_json());
    return kDone;
  }
  if (words.empty()) words = {"--help"};
  CLI::App* command = nullptr;
  if (!words.front().starts_with("-")) {
    for (const auto& [sub, action] : actions)
      if (sub->get_name() == words.front()) command = sub;
    if (command == nullptr) throw InvalidInput(unknown_command(app, words.front()));
    check_options(*command, std::span(words).subspan(1));
  } else {
    check_options(app, std::span(words).first(1));
  }
  const std::string about = command == nullptr ? "--help" : "help " + command->get_name();
  try {
    std::vector<std::string> backwards(words.rbegin(), words.rend());
    app.parse(backwards);
  } catch (const CLI::Success& asked) {  // --help, --version
    const int code = app.exit(asked);
    std::cout.flush();
    if (!std::cout) throw IoError("standard output", "cannot be written");
    return code;
  } catch (const CLI::ParseError& error) {
    if (command != nullptr) check_values(*command);
    throw InvalidInput(fmt::format("{}; \"mapproof {}\" shows what it takes",
                                   objection(error, command == nullptr ? app : *command), about));
  }
  if (command == nullptr) throw InvalidInput("no command; \"mapproof --help\" lists them");
  check_values(*command);

  for (const auto& [sub, action] : actions)
    if (sub == command) return act(action, command->get_name(), common, {argv + 1, argv + argc});
  return kInternal;
}

/// Standard streams that the caller closed are /dev/null: no file or socket that is opened later
/// may get their numbers, which children take for their own streams. What is written to standard
/// output fails there, as on a full disk, since it would be lost; a message may be.
void open_standard_streams() {
  constexpr std::pair<int, int> kModes[] = {
      {STDIN_FILENO, O_RDONLY}, {STDOUT_FILENO, O_RDONLY}, {STDERR_FILENO, O_RDWR}};
  for (const auto& [stream, mode] : kModes)
    if (::fcntl(stream, F_GETFD) < 0) (void)::open("/dev/null", mode);  // The lowest free number.
}

/// Raises the limit of the stack to what is usual, as far as it may be raised, for this thread, those
/// that follow and programs that are started. Eigen keeps arrays of up to 128 KiB on the stack.
/// @throws InvalidInput if the stack stays too small.
void take_stack() {
  constexpr rlim_t kUsual = rlim_t{8} << 20;
  constexpr rlim_t kLeast = rlim_t{512} << 10;  // `slam` of Plaza 1 takes between 224 and 256 KiB.
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kUsual) return;
  limit.rlim_cur = std::min(kUsual, limit.rlim_max);
  if (limit.rlim_cur < kLeast)
    throw InvalidInput(fmt::format("a stack of {} KiB (ulimit -s) is too small: {} are needed",
                                   limit.rlim_cur >> 10, kLeast >> 10));
  ::setrlimit(RLIMIT_STACK, &limit);
  pthread_attr_t threads;
  if (::pthread_getattr_default_np(&threads) != 0) return;
  ::pthread_attr_setstacksize(&threads, limit.rlim_cur);
  ::pthread_setattr_default_np(&threads);
  ::pthread_attr_destroy(&threads);
}

}  // namespace

}  // namespace mapproof

int main(int argc, char** argv) {
  using namespace mapproof;
  open_standard_streams();
  // A limit on file sizes then fails the write, which says so and cleans up, not the program.
  std::signal(SIGXFSZ, SIG_IGN);
  return exit_code_of([&] {
    take_stack();
    return run_command_of(argc, argv);
  });
}
