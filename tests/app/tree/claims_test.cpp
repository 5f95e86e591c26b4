#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace mapproof {
namespace {

namespace fs = std::filesystem;

using Figures = std::set<std::string>;

std::string text_in(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

const fs::path kRoot = MAPPROOF_SOURCE_DIR;

/// "0.054 m": the numbers with a unit behind them, in text and in blocks of code. Code between `
/// and the values of options are left out.
Figures figures_in(const std::string& text) {
  static const std::regex code("`[^`\n]*`|--[a-z-]+ [0-9][^ \n]*");
  static const std::regex figure(
      R"(([0-9][0-9.,]*|\.[0-9]+)( |\u00A0)?(km|cm|mm|m|s|ms|minutes|min|hours|%|kB|MB|MiB|GB|GiB)(?![a-zA-Z0-9²]))");
  const std::string prose = std::regex_replace(text, code, "`");
  Figures figures;
  for (std::sregex_iterator match(prose.begin(), prose.end(), figure), end; match != end; ++match)
    figures.insert((*match)[1].str() + " " + (*match)[3].str());
  return figures;
}

/// The cells of a row of a table, without the blanks around them; none of another line.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  if (!line.starts_with("| ") && !line.starts_with("||")) return cells;
  std::istringstream row(line.substr(1));
  for (std::string cell; std::getline(row, cell, '|');) {
    const auto begin = cell.find_first_not_of(' ');
    cells.push_back(
        begin == cell.npos ? "" : cell.substr(begin, cell.find_last_not_of(' ') - begin + 1));
  }
  return cells;
}

/// The rows of tables with two cells or more that are a figure and nothing else.
std::set<std::vector<std::string>> rows_of_figures(const std::string& text) {
  static const std::regex figure(R"([0-9.,]+ (m|km|s|%))");
  std::set<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> cells = cells_of(line);
    if (std::ranges::count_if(
            cells, [&](const std::string& cell) { return std::regex_match(cell, figure); }) > 1)
      rows.insert(cells);
  }
  return rows;
}

/// A page's text by its headings; "" before the first.
std::map<std::string, std::string> sections_of(const std::string& text) {
  std::map<std::string, std::string> sections;
  std::istringstream lines(text);
  std::string heading;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#'))
      heading = line.substr(std::min(line.find_first_not_of("# "), line.size()));
    else
      sections[heading] += line + "\n";
  }
  return sections;
}

/// The anchor that a heading has on GitHub.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ')
      anchor += '-';
    else if (std::isalnum(byte) || c == '-' || c == '_')
      anchor += static_cast<char>(std::tolower(byte));
  }
  return anchor;
}

bool matches(const std::string& text, const char* pattern) {
  return std::regex_search(text, std::regex(pattern, std::regex::icase));
}

/// Whether a text says how a figure is measured, when, and on which machine.
bool is_complete(const std::string& text) {
  return matches(text, "`[^`]*(mapproof|scripts/|_test|experiments/)[^`]*`") &&
         matches(text,
                 "(January|February|March|April|May|June|July|August|September|October|"
                 "November|December) 20\\d\\d|20\\d\\d-\\d\\d-\\d\\d|a setting") &&
         matches(text, "two\\s+cores|one\\s+core|any\\s+machine");
}

/// The figures of docs/claims.md with their command, date and machine: of a section that has the
/// three, or of a row of the first table that has them.
Figures claimed_in(const std::string& claims) {
  Figures figures;
  for (const auto& [heading, text] : sections_of(claims)) {
    if (heading == "Claims") {
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);)
        if (const auto cells = cells_of(line); cells.size() == 4 && is_complete(line))
          figures.merge(figures_in(cells[0]));
    } else if (heading != "Figures in docs" && is_complete(text)) {
      figures.merge(figures_in(text));
    }
  }
  return figures;
}

TEST(Claims, EachFigureOfTheReadmeIsListedWithCommandDateAndMachine) {
  const std::string readme = text_in(kRoot / "README.md");
  const Figures listed = claimed_in(text_in(kRoot / "docs/claims.md"));
  const Figures claimed = figures_in(readme);
  EXPECT_GT(claimed.size(), 30U);
  for (const std::string& figure : claimed)
    EXPECT_TRUE(listed.contains(figure)) << figure << " of README.md is not in docs/claims.md";
}

TEST(Claims, EachRowOfFiguresOfTheReadmeIsListedAsItIs) {
  const auto listed = rows_of_figures(text_in(kRoot / "docs/claims.md"));
  const auto claimed = rows_of_figures(text_in(kRoot / "README.md"));
  EXPECT_GE(claimed.size(), 13U);
  for (const auto& row : claimed)
    EXPECT_TRUE(listed.contains(row))
        << "the row \"" << row.front() << "\" of README.md is not in docs/claims.md as it is";
}

/// "methods/sde.md#limits" of each section of docs with a figure, blocks of code left out.
std::set<std::string> sections_with_figures() {
  static const std::regex code("(^|\n)(    [^\n]*|```[\\s\\S]*?\n```)");
  std::set<std::string> sections;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs")) {
    const std::string page = fs::relative(entry.path(), kRoot / "docs").string();
    if (entry.path().extension() != ".md" || page == "claims.md") continue;
    for (const auto& [heading, text] : sections_of(text_in(entry.path())))
      if (!figures_in(std::regex_replace(text, code, "\n")).empty())
        sections.insert(page + "#" + anchor_of(heading));
  }
  return sections;
}

TEST(Claims, EachSectionOfDocsWithFiguresIsListedWithItsSource) {
  static const std::regex link(R"(^\[[^\]]*\]\(([^)]+)\)$)");
  std::set<std::string> listed;
  std::istringstream lines(sections_of(text_in(kRoot / "docs/claims.md"))["Figures in docs"]);
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> cells = cells_of(line);
    std::smatch match;
    if (cells.empty() || !std::regex_match(cells[0], match, link)) continue;
    listed.insert(match[1]);
    if (cells.size() == 3)  // A setting.
      EXPECT_TRUE(matches(cells[2], "^`")) << line;
    else
      EXPECT_TRUE(cells.size() == 4 && !cells[2].empty() &&
                  matches(cells[3], "(two cores|one core|any machine)"))
          << line;
  }
  const std::set<std::string> with_figures = sections_with_figures();
  EXPECT_GT(with_figures.size(), 40U);
  for (const std::string& section : with_figures)
    EXPECT_TRUE(listed.contains(section)) << "docs/claims.md does not list docs/" << section;
  for (const std::string& section : listed)
    EXPECT_TRUE(with_figures.contains(section)) << "docs/" << section << " has no figure";
}

TEST(Claims, TheCommandsFilesAndTestsThatTheListNamesAreThere) {
  std::string tests;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests"))
    if (entry.path().filename() == "CMakeLists.txt") tests += text_in(entry.path());
  const std::string claims = text_in(kRoot / "docs/claims.md");
  static const std::regex code("`([^`\n]+)`");
  static const std::regex experiment("mapproof (?:reproduce|run) ([a-z0-9]+)");
  int named = 0;
  for (std::sregex_iterator match(claims.begin(), claims.end(), code), end; match != end; ++match) {
    const std::string word = (*match)[1];
    std::smatch inner;
    if (matches(word, "^[a-z_]+_tests?$")) {
      EXPECT_NE(tests.find("(" + word), tests.npos) << word;
    } else if (matches(word, "^(core|render|reports|app|experiments|tests)/[^ ]*\\.[a-z]+$")) {
      EXPECT_TRUE(fs::exists(kRoot / word)) << word;
    } else if (std::regex_search(word, inner, experiment)) {
      EXPECT_TRUE(fs::exists(kRoot / "experiments" / (inner[1].str() + ".json"))) << word;
    } else {
      continue;
    }
    ++named;
  }
  EXPECT_GT(named, 30);
}

TEST(Claims, TheChecksSeeWhatTheyShould) {
  EXPECT_EQ(
      figures_in(
          "an error of 0.05 m, \u00B14 to \u00B134 %; `--every 5s`\n\n    x --every 5s (12 min)\n"),
      (Figures{"0.05 m", "34 %", "12 min"}));
  EXPECT_EQ(rows_of_figures("| A | 1 m | 2 m |\n| B | 1 m | x |\n").size(), 1U);
  EXPECT_NE(rows_of_figures("| A | 1 m | 2 m |\n"), rows_of_figures("| A | 2 m | 1 m |\n"));
  // A figure counts only where its command, date and machine stand.
  EXPECT_EQ(claimed_in("# Claims\n| 3 m | side | `mapproof map` | 2026-11-23, any machine |\n"),
            Figures{"3 m"});
  EXPECT_TRUE(claimed_in("# Claims\n| 3 m | side | `mapproof map` | |\n").empty());
  EXPECT_TRUE(claimed_in("# Claims\n\n3 m.\n\n## Plaza\n\n5 m, two cores, 2026-11-23.\n").empty());
  EXPECT_EQ(anchor_of("Choice without ground truth (`auto`)"), "choice-without-ground-truth-auto");
}

}  // namespace
}  // namespace mapproof
