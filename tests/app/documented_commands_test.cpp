// The commands of README, the documents and the help: those in lines of their own run as they
// stand; of all others, command and options exist.
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = MAPPROOF_SOURCE_DIR;

/// Commands in lines of their own that do not run here, and why. What stands in capitals is a
/// placeholder: such lines show a command's form.
const std::map<std::string, std::string> kNotRun = {
    {"mapproof reproduce yairi2007 --profile quick --methods methods.json --out out",
     "needs methods of your own; external_methods_test runs those of examples/methods"},
    {"mapproof import out files --out out-import", "needs maps made elsewhere"},
    {"mapproof reproduce mrclam --data FOLDER", "needs the MRCLAM sets"},
    {"mapproof reproduce yairi2007 --out out", "takes minutes; other tests run its profile quick"},
    {"mapproof render out --figure published-errors --out docs/images", "needs that study"},
    {"mapproof render out/yairi2007 --theme paper --figure fig-7 --as pdf,eps,latex",
     "needs the study of scripts/report, of 12 minutes"},
    {"mapproof render out/yairi2007 --animate scene-forming-bearing --as mp4",
     "needs the study of scripts/report, of 12 minutes"},
};

std::vector<fs::path> pages() {
  std::vector<fs::path> pages = {kRoot / "README.md", kRoot / "CONTRIBUTING.md",
                                 kRoot / "examples/README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs"))
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  std::ranges::sort(pages);
  return pages;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string without_comment(const std::string& line) {
  const std::string text = line.substr(0, line.find("  #"));
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

/// Lines of a page that are a command: indented by four spaces.
std::vector<std::string> command_lines(const fs::path& page) {
  std::vector<std::string> commands;
  for (const std::string& line : lines_of(read_file(page)))
    if (line.starts_with("    mapproof ") || line.starts_with("    range_sensor | mapproof "))
      commands.push_back(without_comment(line.substr(4)));
  return commands;
}

/// `mapproof map --incremental` within the sentences of a page.
std::vector<std::string> commands_in_text(const fs::path& page) {
  std::vector<std::string> commands;
  const std::string text = read_file(page);
  for (std::size_t at = text.find("`mapproof "); at != std::string::npos;
       at = text.find("`mapproof ", at + 1)) {
    const std::size_t end = text.find('`', at + 1);
    if (end != std::string::npos) commands.push_back(text.substr(at + 1, end - at - 1));
  }
  return commands;
}

std::vector<std::string> words_of(const std::string& command) {
  std::istringstream stream(command);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// Whether a word in capitals stands for something: `mapproof diff OLD NEW`.
bool shows_a_form(const std::string& command) {
  const auto is_placeholder = [](const std::string& word) {
    return word.size() > 1 && std::ranges::all_of(word, [](unsigned char c) {
             return std::isupper(c) != 0 || c == '[' || c == ']' || c == '_';
           });
  };
  return command.find("…") != std::string::npos || command.find(" [") != std::string::npos ||
         std::ranges::any_of(words_of(command), is_placeholder);
}

const std::string& help_of(const std::string& command) {
  static std::map<std::string, std::string> known;
  const auto [help, is_new] = known.emplace(command, "");
  if (is_new) {
    const Outcome outcome = mapproof({"help", command});
    help->second = outcome.exit_code == 0 ? outcome.out + " " : "";
  }
  return help->second;
}

/// The option of a word, without its value and what surrounds it; empty: it is none.
std::string option_in(std::string word) {
  while (!word.empty() && (word.front() == '[' || word.front() == '(')) word.erase(0, 1);
  if (!word.starts_with("--") || word.size() < 4) return "";
  const auto ends = [](unsigned char c) { return std::isalnum(c) == 0 && c != '-'; };
  return {word.begin(), std::ranges::find_if(word, ends)};
}

bool names_option(const std::string& help, const std::string& option) {
  for (std::size_t at = help.find(option); at != std::string::npos; at = help.find(option, at + 1))
    if (const char next = help[at + option.size()]; std::isalnum(next) == 0 && next != '-')
      return true;
  return false;
}

/// Expects that the commands of a line exist, with their options.
void expect_known(const std::string& line) {
  static const std::set<std::string> kShared = {"--help", "--json", "--quiet", "--verbose",
                                                "--version"};
  std::string command;
  const std::vector<std::string> words = words_of(line);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "mapproof" && i + 1 < words.size() && !words[i + 1].starts_with('-')) {
      command = words[++i];
      if (command == "generate" || command == "help" || command == "COMMAND") return;
      EXPECT_NE(help_of(command), "") << line;
    } else if (words[i] == "&&" || words[i] == "|" || words[i] == "#") {
      command.clear();
    } else if (const std::string option = option_in(words[i]);
               !option.empty() && !command.empty() && !kShared.contains(option)) {
      EXPECT_TRUE(names_option(help_of(command), option)) << option << " in: " << line;
    }
  }
}

/// A folder with the files that the lines of a page name.
class Stage {
 public:
  Stage() {
    fs::copy(kRoot / "examples", folder_ / "examples", fs::copy_options::recursive);
    fs::create_directory(folder_ / "bin");
    write_file(folder_ / "bin/range_sensor",
               "#!/bin/sh\nawk -F, 'NR == 1 {print \"t,landmark,range\"; next} "
               "NR < 400 {print int($1) \",\" $2 \",\" $3}' drive/ranges.csv | "
               "awk -F, '!seen[$1 $2]++'\n");
    fs::permissions(folder_ / "bin/range_sensor", fs::perms::owner_all);
  }

  const fs::path path() const { return folder_.path(); }

  /// 127: a program is missing.
  Outcome run(const std::string& command) const {
    const std::string path = "PATH=" + fs::path(program()).parent_path().string() + ":" +
                             (folder_ / "bin").string() + ":/usr/bin:/bin";
    return run_program({"env", "-C", folder_.path(), path, "sh", "-c", command});
  }

 private:
  TemporaryFolder folder_;
};

/// What the lines of a page take for granted.
std::string preparation_of(const std::string& page) {
  if (page == "docs/figures.md")
    return "cd examples && for map in map map1 map2; do mapproof map hall/bearings.csv --sensor "
           "bearing --anchors hall/anchors.csv --out ../out/$map || exit 1; done";
  if (page == "docs/your-results.md")
    return "python3 examples/results/localisers.py mine && "
           "python3 examples/results/localisers.py baseline && mapproof report baseline";
  if (page == "docs/evaluate.md")
    return "python3 examples/trajectories/make_trajectories.py paths && cp -r paths/ground-truth "
           "gt "
           "&& set -- $(ls paths | grep -v -e ground-truth -e expected.json) && cp -r paths/$1 orb "
           "&& cp -r paths/$2 vins && file=$(ls gt | head -n 1) && cp gt/$file gt.txt && "
           "cp orb/$file orb.txt && cp vins/$file vins.txt && "
           "mapproof evaluate --ground-truth gt/ orb/ vins/ --align similarity --out baseline";
  if (page == "docs/ci.md")
    return R"(echo 'open("a.svg", "w").write("<svg xmlns=\"http://www.w3.org/2000/svg\"/>")' >plot.py)";
  if (page == "docs/report.md")
    return "mapproof reproduce yairi2007 --profile quick --out quick && "
           "cp quick/report.html A.html && cp A.html B.html";
  return "true";
}

TEST(DocumentedCommands, InLinesOfTheirOwnRunAsTheyStand) {
  std::set<std::string> left_out;
  std::size_t run = 0;
  for (const fs::path& page : pages()) {
    const std::string name = fs::relative(page, kRoot).string();
    // examples_test runs these, and looks at what they write.
    if (name == "examples/README.md") continue;
    SCOPED_TRACE(name);
    std::vector<std::string> commands;
    for (const std::string& command : command_lines(page)) {
      expect_known(command);
      if (kNotRun.contains(command))
        left_out.insert(command);
      else if (!shows_a_form(command))
        commands.push_back(command);
    }
    if (commands.empty()) continue;
    const Stage stage;
    const Outcome prepared = stage.run(preparation_of(name));
    if (prepared.exit_code == 127) GTEST_SKIP() << "python3 is not installed";
    ASSERT_EQ(prepared.exit_code, 0) << prepared.error;
    for (const std::string& command : commands) {
      const Outcome outcome = stage.run(command);
      // That figures differ, or that there is no baseline yet, is an answer.
      const bool compares =
          command.starts_with("mapproof diff") || command.starts_with("mapproof check");
      const int most = compares ? 1 : 0;
      EXPECT_TRUE(outcome.exit_code >= 0 && outcome.exit_code <= most) << command << '\n'
                                                                       << outcome.error;
      ++run;
    }
  }
  EXPECT_GE(run, 20U);
  EXPECT_EQ(left_out.size(), kNotRun.size()) << "a command that does not run here is no more";
}

TEST(DocumentedCommands, OfReadmeForMrclamRunWithItsSets) {
  const char* folder = std::getenv("MAPPROOF_MRCLAM");
  if (folder == nullptr) GTEST_SKIP() << "set MAPPROOF_MRCLAM to the folder of the sets";
  const Stage stage;
  fs::create_directory_symlink(fs::path(folder) / "dataset3", stage.path() / "MRCLAM_Dataset3");
  const std::vector<std::string> commands = commands_in_text(kRoot / "README.md");
  const auto command = std::ranges::find_if(commands, [](const std::string& text) {
    return text.starts_with("mapproof map MRCLAM_Dataset3");
  });
  ASSERT_NE(command, commands.end());
  const Outcome outcome = stage.run(*command + " --out out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
}

TEST(DocumentedCommands, WithinSentencesAndInTheHelpExist) {
  std::size_t checked = 0;
  for (const fs::path& page : pages()) {
    SCOPED_TRACE(page.filename());
    for (const std::string& command : commands_in_text(page)) {
      expect_known(command);
      ++checked;
    }
  }
  EXPECT_GE(checked, 80U);
  for (const char* command :
       {"reproduce", "run", "merge", "render", "report", "map", "slam", "evaluate", "diff",
        "approve", "check", "example", "methods", "validate", "nightly", "history"}) {
    SCOPED_TRACE(command);
    for (const std::string& line : lines_of(help_of(command)))
      if (line.starts_with("  mapproof ") && line.find("[OPTIONS]") == std::string::npos)
        expect_known(line);
  }
}

/// Expects the parts of a message between "…", which stands for what differs.
void expect_message(const std::string& sources, const std::string& message) {
  const std::string gap = " … ";
  for (std::size_t begin = 0; begin < message.size();) {
    const std::size_t end = std::min(message.find(gap, begin), message.size());
    const std::string part = message.substr(begin, end - begin);
    EXPECT_NE(sources.find(part), std::string::npos) << part;
    begin = end + gap.size();
  }
}

TEST(DocumentedCommands, MessagesOfTroubleshootingAreThoseOfTheProgram) {
  std::string sources;
  for (const char* folder : {"app", "core", "render", "reports"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
      if (const fs::path extension = entry.path().extension();
          extension == ".cpp" || extension == ".hpp")
        for (const std::string& line : lines_of(read_file(entry.path()))) {
          // A sentence may go on in the next literal.
          const std::size_t first = line.find_first_not_of(' ');
          std::string text = first == std::string::npos ? "" : line.substr(first);
          if (text.starts_with('"') && sources.ends_with('"')) {
            sources.pop_back();
            text.erase(0, 1);
          }
          sources += text;
          if (!text.ends_with('"')) sources += '\n';
        }
  std::size_t rows = 0;
  for (const std::string& line : lines_of(read_file(kRoot / "docs/troubleshooting.md"))) {
    if (!line.starts_with("| `")) continue;
    const std::string cell = line.substr(0, line.find(" | "));
    for (std::size_t at = cell.find('`'); at != std::string::npos;) {
      const std::size_t end = cell.find('`', at + 1);
      expect_message(sources, cell.substr(at + 1, end - at - 1));
      at = cell.find('`', end + 1);
    }
    ++rows;
  }
  EXPECT_GE(rows, 20U);
}

}  // namespace
}  // namespace mapproof::test
