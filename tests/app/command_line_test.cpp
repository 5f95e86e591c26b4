#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/app/range_logs.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

/// As the help lists them.
std::vector<std::string> all_commands() {
  std::istringstream help(mapproof({"--help"}).out);
  std::vector<std::string> commands;
  std::string line;
  while (std::getline(help, line) && line != "Commands") {
  }
  while (std::getline(help, line) && line.starts_with("  ")) {
    const std::string command = line.substr(2, line.find(' ', 2) - 2);
    if (!command.empty()) commands.push_back(command);
  }
  std::ranges::sort(commands);
  return commands;
}

TEST(CommandLine, HelpShowsEveryCommandAndItsExamplesAndExitCodes) {
  const Outcome help = mapproof({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  const std::vector<std::string> commands = all_commands();
  EXPECT_GE(commands.size(), 13U) << help.out;
  for (const char* command : {"check", "history", "map", "nightly", "reproduce", "slam"})
    EXPECT_TRUE(std::ranges::binary_search(commands, command)) << command;
  for (const std::string& command : commands) {
    EXPECT_NE(help.out.find("\n  " + command), std::string::npos) << command;
    const Outcome own = mapproof({command, "--help"});
    EXPECT_EQ(mapproof({"help", command}).out, own.out) << command;
    EXPECT_EQ(own.exit_code, 0);
    for (const char* part :
         {"Example", "mapproof ", "Exit codes", "--json", "--quiet", "--verbose"})
      EXPECT_NE(own.out.find(part), std::string::npos) << command << " " << part;
  }
}

TEST(CommandLine, VersionNamesWhatItIsLinkedWithAndTheCommit) {
  const Outcome version = mapproof({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  for (const char* part :
       {"mapproof 1.", "commit ", "Eigen 3.", "Cairo 1.", "oneTBB ", "HarfBuzz "})
    EXPECT_NE(version.out.find(part), std::string::npos) << part;
}

/// An option or argument that takes a value, and the words before the value.
struct Valued {
  std::string name;
  std::vector<std::string> words;
};

/// All that the help of a command lists: its first long name, else its only one.
std::vector<Valued> valued_in_help(const std::string& command) {
  static const std::regex option(R"(  -.*?[^,] ([^-(\s]\S*)( \(required\))?)");
  static const std::regex long_name(R"( (--[a-z0-9-]+))"), short_name(R"( (-\w))");
  static const std::regex argument(R"(  ([A-Z]+)( \(required\))?)");
  const Environment wide{{"COLUMNS", "100"}};
  std::istringstream help(mapproof({command, "--help"}).out);
  std::vector<Valued> found;
  std::vector<std::string> before = {command};
  std::smatch match;
  for (std::string line; std::getline(help, line);) {
    if (std::regex_match(line, match, argument)) {
      found.push_back({match[1].str(), before});
      before.emplace_back("x");
    } else if (std::regex_match(line, option) && (std::regex_search(line, match, long_name) ||
                                                  std::regex_search(line, match, short_name))) {
      found.push_back({match[1].str(), {command, match[1].str()}});
    }
  }
  return found;
}

std::string refusal_of_empty(const std::string& command, const std::string& name) {
  return "mapproof: " + name +
         ": an empty value is not a value: give one, or leave it out; \"mapproof help " + command +
         "\" shows what it takes\n";
}

TEST(CommandLine, NoOptionAndNoArgumentTakesAnEmptyValue) {
  std::set<std::string> names;
  for (const std::string& command : all_commands())
    for (const Valued& valued : valued_in_help(command)) {
      names.insert(command + " " + valued.name);
      std::vector<std::string> words = valued.words;
      words.emplace_back("");
      const Outcome outcome = mapproof(words);
      EXPECT_EQ(outcome.exit_code, 2) << command << " " << valued.name;
      // A word behind an option whose value may be left out is an argument.
      const std::string named = valued.name == "--ellipses" ? "OBSERVATIONS" : valued.name;
      EXPECT_EQ(outcome.error, refusal_of_empty(command, named));
      EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    }
  for (const char* known :
       {"map OBSERVATIONS", "map --anchors", "map --neighbours", "map --ellipses", "slam --columns",
        "check --out", "check EXPERIMENT", "diff CURRENT", "history --known", "render --title",
        "run --seed", "validate FILE"})
    EXPECT_TRUE(names.contains(known)) << known;
  EXPECT_FALSE(names.contains("map --degrees")) << "a flag";
}

TEST(CommandLine, AnEmptyValueBehindAnEqualsSignDoesNotTakeTheNextWord) {
  const TemporaryFolder folder;
  const std::string seen = std::string(MAPPROOF_TEST_DATA) + "/mrclam";
  for (const char* option : {"--anchors", "--truth", "--neighbours", "--out"}) {
    const std::string first = option == std::string("--truth") ? "--ground-truth" : option;
    const Outcome outcome =
        mapproof({"map", seen, std::string(option) + "=", "--out", folder / "out"});
    EXPECT_EQ(outcome.exit_code, 2) << option;
    EXPECT_EQ(outcome.error, refusal_of_empty("map", first));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(CommandLine, TheTextOfANoteAndTheArgumentsOfACheckedCommandMayBeEmpty) {
  const TemporaryFolder folder;
  for (const char* option : {"--note", "--known", "--accept"}) {
    const Outcome removed = mapproof({"history", folder / "none", option, "1", ""});
    EXPECT_EQ(removed.exit_code, 2);
    EXPECT_NE(removed.error.find((folder / "none").string()), std::string::npos) << removed.error;
    EXPECT_EQ(mapproof({"history", folder / "none", option, "", "text"}).error,
              refusal_of_empty("history", option));
  }
  EXPECT_EQ(mapproof({"map", "x", "", "--out", folder / "out"}).error,
            "mapproof: map takes no \"\"; \"mapproof help map\" shows what it takes\n");
  write_file(folder / "baseline/a.txt", "");
  const std::string marked = folder / "marked";
  mapproof({"check", "--baseline", folder / "baseline", "--out", folder / "out", "--", "sh", "-c",
            "test $# = 1 && touch \"$0\"", marked, ""});
  EXPECT_TRUE(std::filesystem::exists(marked));
}

TEST(CommandLine, WrongUsageIsTwoAndOneClearLine) {
  const std::vector<std::vector<std::string>> wrong = {
      {"frobnicate"},
      {"--json"},
      {"map"},
      {"reproduce", "yairi2007", "--jobs", "none"},
      {"reproduce", "yairi2007", "--jobs", "0"},
      {"methods", "--quiet", "--verbose"},
      {"render"},
      {"reproduce", "unheard-of"},
      {"reproduce", "yairi2007", "--profile", "slow"},
      {"methods", "too", "many"},
      {"reproduce", "yairi2007", "--out", ""},
      {"run", "/nonexistent.json", "--out", "/tmp/mapproof-never-made"},
  };
  for (const auto& arguments : wrong) {
    const Outcome outcome = mapproof(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << ::testing::PrintToString(arguments) << outcome.error;
    EXPECT_FALSE(outcome.error.empty());
    EXPECT_TRUE(outcome.out.empty());
    EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  }
}

TEST(CommandLine, NumbersAreFiniteAndWithinBoundsThatAPersonCanRead) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> options = {
      {{"slam", "x", "--out", "o", "--range-sigma"}, "above 0"},
      {{"slam", "x", "--out", "o", "--odometry-sigma"}, "above 0"},
      {{"slam", "x", "--out", "o", "--heading-sigma"}, "above 0"},
      {{"slam", "x", "--out", "o", "--odometry-scale-sigma"}, "from 0 to 0.5"},
      {{"diff", "x", "y", "--page-size"}, "from 0.5 to 2000"},
      {{"evaluate", "x", "--ground-truth", "y", "--out", "o", "--largest-gap"}, "from 0 on"},
      {{"evaluate", "x", "--ground-truth", "y", "--out", "o", "--gate"}, "above 0"},
      {{"evaluate", "x", "--ground-truth", "y", "--out", "o", "--offset"}, "that is finite"},
      {{"render", "x", "--dpi"}, "from 30 to 1200"},
      {{"render", "x", "--height"}, ""},
      {{"map", "x", "--out", "o", "--stress-fall"}, "from 0 to 1"},
      {{"map", "x", "--out", "o", "--overlap"}, "from 0 to 0.8"},
      {{"map", "x", "--out", "o", "--sigma2"}, "that is finite"}};
  for (const auto& [words, bound] : options)
    for (const char* value : {"nan", "-nan", "inf", "-1e400"}) {
      std::vector<std::string> arguments = words;
      arguments.back() += std::string("=") + value;
      const Outcome outcome = mapproof(arguments);
      EXPECT_EQ(outcome.exit_code, 2) << arguments.back();
      EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
      EXPECT_NE(outcome.error.find(words.back()), std::string::npos) << outcome.error;
      EXPECT_NE(outcome.error.find(bound), std::string::npos) << outcome.error;
    }
  EXPECT_EQ(mapproof({"slam", "x", "--out", "o", "--range-sigma", "0"}).error,
            "mapproof: --range-sigma: \"0\" is not a number above 0; \"mapproof help slam\" shows "
            "what it takes\n");
}

TEST(CommandLine, HelpThatCannotBeWrittenIsAFailure) {
  for (const char* words : {"--help", "--version", "help map", "map --help", "--version --json"}) {
    const Outcome outcome =
        run_program({"sh", "-c", "\"$0\" " + std::string(words) + " > /dev/full", program()});
    EXPECT_EQ(outcome.exit_code, 2) << words;
    EXPECT_EQ(outcome.error, "mapproof: standard output: cannot be written\n") << words;
  }
}

TEST(CommandLine, ValidateReadsItsOwnFormatsAndNotTheirHeadingsAlone) {
  const TemporaryFolder folder;
  for (const char* format :
       {"metrics", "approvals", "diff_settings", "decisions", "page", "methods", "never_heard_of"})
    for (const char* rest : {R"("version": 99}})", R"("version": 1}, "items": 5})"}) {
      const std::string file = folder.file(
          "a.json", std::string(R"({"schema": {"name": "mapproof.)") + format + "\", " + rest);
      EXPECT_EQ(mapproof({"validate", file}).exit_code, 1) << format << rest;
    }
  for (const char* whole :
       {R"({"schema": {"name": "mapproof.approvals", "version": 1}, "ids": ["a"]})",
        R"({"schema": {"name": "mapproof.decisions", "version": 1}, "decisions": []})",
        R"({"schema": {"name": "mapproof.metrics", "version": 1}, "metrics":
            [{"name": "a", "value": 1, "better": "lower"}]})",
        R"({"schema": {"name": "mapproof.page", "version": 1}, "files":
            [{"name": "results.csv", "text": ""}]})"}) {
    const Outcome outcome = mapproof({"validate", folder.file("a.json", whole)});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.error;
  }
}

TEST(CommandLine, JsonIsOneObjectOnStandardOutputForEveryCommand) {
  const TemporaryFolder folder;
  const std::string study = folder / "study";
  const std::string data = MAPPROOF_TEST_DATA;
  const std::vector<std::vector<std::string>> calls = {
      {"run", data + "/experiments/small.json", "--out", study},
      {"run", data + "/experiments/small.json", "--shard", "1/1", "--out", folder / "shard"},
      {"merge", folder / "shard", "--out", folder / "merged"},
      {"render", study},
      {"report", study},
      {"results", study},
      {"reproduce", "yairi2007", "--profile", "quick", "--out", folder / "paper"},
      {"map", data + "/mrclam", "--method", "lpca", "--out", folder / "map"},
      {"slam", folder / "log", "--out", folder / "slam"},
      {"evaluate", "--ground-truth", folder / "path.tum", folder / "path.tum", "--out",
       folder / "evaluation"},
      {"example", "hall", "--out", folder / "hall"},
      {"methods"},
      {"validate", data + "/experiments/small.json", study},
      {"approve", folder / "baseline", study, "--all"},
      {"nightly", data + "/experiments/small.json", "--profile", "tiny", "--store",
       folder / "nightly_runs"},
      {"history", folder / "nightly_runs"},
      {"history", folder / "nightly_runs", "--pin", "1"},
      {"history", folder / "nightly_runs", "--verify"},
      {"history", folder / "nightly_runs", "--prune", "last=3"},
  };
  write_log(drive_log(), folder / "log");
  write_file(folder / "path.tum", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 1 1 0 0 0 0 1\n");
  // The --json of diff and check names a file; external_methods_test.cpp calls the others.
  std::set<std::string> called = {"check", "diff", "export", "import"};
  for (std::vector<std::string> call : calls) {
    called.insert(call[0]);
    if (call[0] == "approve")
      std::filesystem::copy(study, folder / "baseline", std::filesystem::copy_options::recursive);
    call.emplace_back("--json");
    const Outcome outcome = mapproof(call);
    EXPECT_EQ(outcome.exit_code, 0) << call[0] << ": " << outcome.error;
    const auto object = nlohmann::json::parse(outcome.out, nullptr, false);
    ASSERT_TRUE(object.is_object()) << call[0] << outcome.out;
    EXPECT_EQ(object["schema"]["name"], "mapproof.result." + call[0]);
    EXPECT_EQ(object["schema"]["version"], 1);
    call.back() = "--quiet";
    // Warnings about a map go there, too.
    const std::string said = mapproof(call).error;
    EXPECT_TRUE(said.empty() || said.starts_with("warning: ")) << call.front() << said;
    std::filesystem::remove_all(folder / "baseline");
  }
  const std::vector<std::string> commands = all_commands();
  EXPECT_EQ(std::vector<std::string>(called.begin(), called.end()), commands)
      << "a command without a call here";
}

TEST(CommandLine, JsonOfADiffHasAFormOfItsOwn) {
  const TemporaryFolder folder;
  const std::string study = folder / "study";
  const std::string small = std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json";
  ASSERT_EQ(mapproof({"run", small, "--profile", "tiny", "--out", study}).exit_code, 0);
  const std::vector<std::vector<std::string>> calls = {
      {"diff", study, study},
      {"check", small, "--profile", "tiny", "--baseline", study, "--out", folder / "check"}};
  for (std::vector<std::string> call : calls) {
    call.emplace_back("--json");
    const Outcome printed = mapproof(call);
    const auto object = nlohmann::json::parse(printed.out, nullptr, false);
    ASSERT_TRUE(object.is_object()) << printed.out << printed.error;
    EXPECT_EQ(object["schema"].dump(), R"({"name":"mapproof.diff","version":1})");
    call.insert(call.begin(), "--json");
    call.pop_back();
    EXPECT_EQ(mapproof(call).out, printed.out) << "before the command's name";
    call.erase(call.begin());
    EXPECT_FALSE(nlohmann::json::accept(mapproof(call).out)) << "the verdict in words";
  }
}

TEST(CommandLine, AloneIsItsHelp) {
  const Outcome alone = mapproof({});
  EXPECT_EQ(alone.exit_code, 0);
  EXPECT_EQ(alone.out, mapproof({"--help"}).out);
  EXPECT_EQ(mapproof({"-V"}).out, mapproof({"--version"}).out);
}

TEST(CommandLine, UnknownOptionsAndValuesAreNamedWithTheNearestOnes) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> slips = {
      {{"map", "a.csv", "--knd", "bearing", "--out", "o"}, "mapproof help map"},
      {{"map", "a.csv", "--sensr", "bearing", "--out", "o"}, "did you mean --sensor?"},
      {{"map", "a.csv", "--Sensor", "bearing", "--out", "o"}, "did you mean --sensor?"},
      {{"map", "a.csv", "--sensor", "baering", "--out", "o"}, "did you mean \"bearing\"?"},
      {{"render", "out", "--theme", "papr"}, "did you mean \"paper\"?"},
      {{"reproduce", "yairi207"}, "did you mean \"yairi2007\"?"},
      {{"Rendre", "out"}, "did you mean \"render\"?"},
      {{"mpa", "a.csv"}, "did you mean \"map\"?"},
      {{"map", "a.csv", "--trueth", "b.csv"}, "did you mean --ground-truth?"},
      {{"diff", "a", "b", "--out", "diff.html"}, "now called --page"},
      {{"methods", "too", "many"}, "methods takes no \"too\" and \"many\""}};
  for (const auto& [words, said] : slips) {
    const Outcome outcome = mapproof(words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.error.find(said), std::string::npos) << outcome.error;
  }
  // Values are taken in any case: the file is looked for.
  EXPECT_NE(
      mapproof({"map", "none.csv", "--sensor", "Bearing", "--out", "o"}).error.find("none.csv"),
      std::string::npos);
}

TEST(CommandLine, HelpIsWrappedAtTheWidthOfTheTerminalInGroupsOfPlainSentences) {
  for (const auto& [columns, width] : {std::pair{"60", 60U}, {"80", 80U}, {"300", 100U}}) {
    const Environment terminal{{"COLUMNS", columns}};
    for (const std::string& command : all_commands()) {
      const std::string help = mapproof({command, "--help"}).out;
      for (const char* notation : {"TEXT:", " in [", "Excludes", "REQUIRED", " ..."})
        EXPECT_EQ(help.find(notation), std::string::npos) << command << " " << notation;
      EXPECT_NE(help.find("\nOther\n"), std::string::npos) << command;
      // Commands stand as they are, to be copied; so do the schemas of JSON.
      std::istringstream lines(help);
      for (std::string line; std::getline(lines, line);)
        if (line.find("mapproof ") == std::string::npos && line.find('{') == std::string::npos) {
          EXPECT_LE(line.size(), width + 8) << line;
        }
    }
  }
}

TEST(CommandLine, CompletionsAndManualPagesNameEveryCommandAndOption) {
  const TemporaryFolder folder;
  ASSERT_EQ(mapproof({"generate", "completions", "--out", folder / ""}).exit_code, 0);
  ASSERT_EQ(mapproof({"generate", "man", "--out", folder / ""}).exit_code, 0);
  const std::string bash = read_file(folder / "bash-completion/completions/mapproof");
  EXPECT_EQ(run_program({"bash", "-n", folder / "bash-completion/completions/mapproof"}).exit_code,
            0);
  for (const std::string& command : all_commands()) {
    for (const char* file : {"zsh/site-functions/_mapproof",
                             "fish/vendor_completions.d/mapproof.fish", "man/man1/mapproof.1"})
      EXPECT_NE(read_file(folder / file).find(command), std::string::npos) << file << command;
    const std::string page = read_file(folder / ("man/man1/mapproof-" + command + ".1"));
    EXPECT_NE(page.find("\\-\\-json"), std::string::npos) << command;
    EXPECT_NE(bash.find("    " + command + ") words="), std::string::npos) << command;
  }
  const std::string completed =
      run_program({"bash", "-c",
                   "source \"$0\"; COMP_WORDS=(mapproof map --sensor b); COMP_CWORD=3; _mapproof; "
                   "echo \"${COMPREPLY[@]}\"",
                   folder / "bash-completion/completions/mapproof"})
          .out;
  EXPECT_EQ(completed, "bearing\n");
}

TEST(CommandLine, MethodsListsEachWithParameterRangeAndSource) {
  const auto object = nlohmann::json::parse(mapproof({"methods", "--json"}).out);
  ASSERT_GE(object["methods"].size(), 4U);
  for (const auto& method : object["methods"]) {
    EXPECT_FALSE(method["source"].get<std::string>().empty());
    if (!method["parameter"].is_null()) {
      EXPECT_LT(method["parameter"]["minimum"], method["parameter"]["maximum"]);
    }
  }
}

TEST(CommandLine, ValidateSaysNoToABrokenFileAndNamesThePlace) {
  const TemporaryFolder folder;
  const std::string broken = folder.file("broken.json", R"({"schema": {"name": )");
  const std::string good = std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json";
  const Outcome outcome = mapproof({"validate", good, broken});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("broken.json: line 1"), std::string::npos) << outcome.out;
  const Outcome missing = mapproof({"validate", folder / "none", good});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_NE(missing.out.find("none: cannot be opened: No such file"), std::string::npos)
      << missing.out;
  EXPECT_NE(missing.out.find("small.json: mapproof.experiment 1"), std::string::npos);
}

TEST(CommandLine, ValidateKnowsEveryFileThatAStudyAndAMapLeaveAndWhenOneIsCut) {
  const TemporaryFolder folder;
  ASSERT_EQ(mapproof({"reproduce", "yairi2007", "--profile", "quick", "--out", folder / "study"})
                .exit_code,
            0);
  ASSERT_EQ(mapproof({"map", std::string(MAPPROOF_TEST_DATA) + "/mrclam", "--method", "lpca",
                      "--out", folder / "map"})
                .exit_code,
            0);
  for (const char* name : {"study", "map"}) {
    const Outcome whole = mapproof({"validate", folder / name, "--json"});
    EXPECT_EQ(whole.exit_code, 0) << whole.out;
    const auto files = contents(folder / name);
    EXPECT_GE(nlohmann::json::parse(whole.out)["files"].size(), files.size());
    for (const auto& [file, bytes] : files) {
      if (bytes.size() < 2 || file.ends_with(".md") || file.ends_with(".csv") ||
          file.ends_with(".jsonl"))
        continue;  // A cut may leave these whole.
      std::filesystem::resize_file(folder / name / file, bytes.size() / 2);
      const Outcome cut = mapproof({"validate", (folder / name / file).string()});
      EXPECT_EQ(cut.exit_code, 1) << file;
      EXPECT_NE(cut.out.find(file), std::string::npos) << cut.out;
    }
  }
}

TEST(CommandLine, ASeedThatIsNoneIsRefusedNotWrappedRound) {
  const TemporaryFolder folder;
  for (const char* seed : {"-1", "18446744073709551616", "1.5", "seven", ""}) {
    const Outcome outcome = mapproof({"reproduce", "yairi2007", "--profile", "quick", "--seed",
                                      seed, "--out", folder / "study"});
    EXPECT_EQ(outcome.exit_code, 2) << seed;
    EXPECT_NE(outcome.error.find("--seed"), std::string::npos) << outcome.error;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "study"));
}

TEST(CommandLine, AMisspeltCommandIsMetWithTheOneMeant) {
  EXPECT_NE(mapproof({"reprodcue"}).error.find("did you mean \"reproduce\"?"), std::string::npos);
}

}  // namespace
}  // namespace mapproof::test
