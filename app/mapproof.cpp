#include <algorithm>
#include <array>
#include <csignal>
#include <functional>
#include <iostream>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include "app/build_facts.hpp"
#include "app/commands.hpp"
#include "app/failures.hpp"
#include "core/base/errors.hpp"
#include "core/base/text/retired_names.hpp"
#include "core/base/text/spelling.hpp"

namespace mapproof {

namespace {

/// @param words  Of the command line, behind the program's name.
/// @throws InvalidInput with the new name of the first retired option among them (see
///         core/base/text/retired_names.hpp).
void refuse_retired_options(std::span<char* const> words) {
  for (const std::string_view word : words) {
    if (word == "--") return;
    const std::string_view name = word.substr(0, word.find('='));
    if (const std::string_view now = replacement_of(NameKind::kOption, name); !now.empty())
      throw InvalidInput(fmt::format("{}: this option is now called {}", name, now));
  }
}

constexpr const char* kExitCodes =
    "Exit codes:\n"
    "  0  done\n"
    "  1  the check that was asked for says no, or there is no map\n"
    "  2  usage or input\n"
    "  3  internal error\n"
    "  4  nightly: only seconds or memory grew\n";

constexpr const char* kFooter =
    "Every command takes --json (its result as one JSON object on standard output; diff and check "
    "take\n--json FILE, where - is standard output), --quiet and --verbose; messages go to "
    "standard "
    "error.\n\"mapproof COMMAND --help\" shows examples.\n";

struct Common {
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  std::string provenance = "reduced";
};

/// The commands that write where and by whom something was made.
constexpr std::array<std::string_view, 11> kWithProvenance = {
    "reproduce", "run",  "render", "report",  "map",    "slam",
    "evaluate",  "diff", "check",  "nightly", "history"};

void add_common_options(CLI::App& app, Common& common) {
  app.add_flag("--json", common.json, "Print the result as one JSON object");
  auto* quiet = app.add_flag("--quiet", common.quiet, "Only warnings and errors");
  app.add_flag("--verbose", common.verbose, "Details")->excludes(quiet);
  if (std::ranges::find(kWithProvenance, app.get_name()) != kWithProvenance.end())
    app.add_option("--provenance", common.provenance,
                   "reduced: records and pages name no user, host or home folder; full: they do")
        ->check(CLI::IsMember({"reduced", "full"}))
        ->capture_default_str();
}

/// What is wrong with the first word if it is meant as a command and is none; empty otherwise.
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return "";
  const std::string word = argv[1];
  std::vector<std::string_view> commands;
  for (const CLI::App* sub : app.get_subcommands({})) commands.push_back(sub->get_name());
  if (std::ranges::find(commands, word) != commands.end()) return "";
  const std::string_view meant = likely_word(word, commands);
  return "unknown command \"" + printable(word) + "\"" +
         (meant.empty() ? "; \"mapproof --help\" lists them"
                        : "; did you mean \"" + std::string(meant) + "\"?");
}

/// "help" and "help COMMAND" as "--help" and "COMMAND --help".
std::vector<char*> with_help(int argc, char** argv) {
  std::vector<char*> words(argv, argv + argc);
  static char help[] = "--help";
  if (argc < 2 || std::string_view(argv[1]) != "help") return words;
  words.erase(words.begin() + 1);
  words.push_back(help);
  return words;
}

/// Whether the words are --version and --json, in whatever order.
bool asks_for_version_json(std::span<char* const> words) {
  const auto has = [&](std::string_view word) {
    return std::ranges::any_of(words, [&](const char* one) { return one == word; });
  };
  return words.size() == 2 && has("--version") && has("--json");
}

int run_command_of(int argc, char** argv) {
  CLI::App app(
      "Maps from what a robot observed, without ever estimating its pose, with the evidence",
      "mapproof");
  app.footer(std::string(kExitCodes) + "\n" + kFooter);
  app.set_version_flag("--version", std::function<std::string()>(version_text),
                       "Version and libraries; with --json, licences too");
  app.require_subcommand(1);
  Common common;
  const std::vector<std::pair<const char*, AddCommand>> commands = {
      {"reproduce", reproduce_command}, {"run", run_command},         {"render", render_command},
      {"report", report_command},       {"map", map_command},         {"slam", slam_command},
      {"evaluate", evaluate_command},   {"diff", diff_command},       {"approve", approve_command},
      {"check", check_command},         {"example", example_command}, {"methods", methods_command},
      {"validate", validate_command},   {"nightly", nightly_command}, {"history", history_command},
  };
  std::vector<std::pair<CLI::App*, Action>> actions;
  for (const auto& [name, command] : commands) {
    CLI::App* sub = app.add_subcommand(name);
    add_common_options(*sub, common);
    actions.emplace_back(sub, command(*sub));
    sub->footer(sub->get_footer() + "\n" + kExitCodes);
  }

  if (const std::string complaint = unknown_command(app, argc, argv); !complaint.empty())
    throw InvalidInput(complaint);
  const std::span<char* const> words_given(argv, static_cast<std::size_t>(argc));
  refuse_retired_options(words_given);
  if (!words_given.empty() && asks_for_version_json(words_given.subspan(1))) {
    Console(Verbosity::kNormal, true, "version").result("", version_json());
    return kDone;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    std::cerr << "mapproof: " << printable(error.what(), 2000)
              << "\nmapproof: \"mapproof --help\" shows what it takes\n";
    return kUsage;
  }

  const Console console(common.quiet     ? Verbosity::kQuiet
                        : common.verbose ? Verbosity::kVerbose
                                         : Verbosity::kNormal,
                        common.json, app.get_subcommands().front()->get_name());
  std::vector<std::string> words{"mapproof"};
  words.insert(words.end(), argv + 1, argv + argc);
  const Disclosure disclosure(common.provenance == "full");
  const Invocation invocation{.console = console,
                              .command = quoted_command(disclosure.words(words)),
                              .disclosure = disclosure};
  for (const auto& [sub, action] : actions)
    if (sub->parsed()) return action(invocation);
  return kInternal;
}

/// Standard streams that the caller closed are /dev/null: no file or socket that is opened later
/// may get their numbers, which children take for their own streams.
void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0) (void)::open("/dev/null", O_RDWR);  // The lowest free number.
}

}  // namespace

}  // namespace mapproof

int main(int argc, char** argv) {
  using namespace mapproof;
  open_standard_streams();
  // A limit on file sizes then fails the write, which says so and cleans up, not the program.
  std::signal(SIGXFSZ, SIG_IGN);
  return exit_code_of([&] {
    std::vector<char*> words = with_help(argc, argv);
    return run_command_of(static_cast<int>(words.size()), words.data());
  });
}
