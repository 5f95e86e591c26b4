#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// A word that is not to be used any more: a row of tests/words.txt.
struct Retired {
  std::string word;  ///< In lower case.
  std::regex contexts;
  bool has_contexts = false;
  std::string use_instead, fails, passes;

  /// In whatever context.
  bool is_written_in(const std::string& line) const {
    return lower(line).find(word) != std::string::npos;
  }

  bool is_in(const std::string& line) const {
    if (!is_written_in(line)) return false;
    if (!has_contexts) return true;
    return std::regex_replace(lower(line), contexts, " ").find(word) != std::string::npos;
  }

  static std::string lower(std::string line) {
    std::ranges::transform(line, line.begin(), [](unsigned char c) { return std::tolower(c); });
    return line;
  }
};

std::vector<Retired> retired_words() {
  std::vector<Retired> words;
  std::ifstream file(fs::path(MAPPROOF_SOURCE_DIR) / "tests/words.txt");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, '\t');) cells.push_back(cell);
    EXPECT_EQ(cells.size(), 5U) << line;
    if (cells.size() != 5) continue;
    words.push_back({.word = cells[0],
                     .contexts = std::regex(cells[1], std::regex::icase | std::regex::optimize),
                     .has_contexts = cells[1] != "-",
                     .use_instead = cells[2],
                     .fails = cells[3],
                     .passes = cells[4]});
  }
  return words;
}

/// Whether a person may read the file.
bool is_text(const fs::path& file) {
  static const std::set<std::string> endings = {
      ".cpp", ".hpp", ".md",   ".mustache", ".js", ".mjs", ".css", ".py",
      ".sh",  ".R",   ".json", ".txt",      ".m",  ".yml", ".cff", ".cmake"};
  const std::string name = file.filename().string();
  return (endings.contains(file.extension().string()) || !file.has_extension()) &&
         name != "words.txt" && name != "package-lock.json";
}

/// All texts of the project, below its folder.
std::vector<fs::path> texts() {
  const fs::path root = MAPPROOF_SOURCE_DIR;
  std::vector<fs::path> files = {"README.md",   "CONTRIBUTING.md", "CHANGELOG.md",
                                 "SECURITY.md", "CITATION.cff",    "CMakeLists.txt"};
  for (const char* folder : {"app", "core", "render", "reports", "templates", "experiments",
                             "examples", "docs", "scripts", "tests"})
    for (auto entry = fs::recursive_directory_iterator(root / folder); entry != fs::end(entry);
         ++entry) {
      const std::string name = entry->path().filename().string();
      if (entry->is_directory() &&
          (name == "node_modules" || name == "data" || name == "baselines" || name == "languages"))
        entry.disable_recursion_pending();
      else if (entry->is_regular_file() && is_text(entry->path()))
        files.push_back(fs::relative(entry->path(), root));
    }
  return files;
}

/// What a reader takes from a line: without the marks of comments and of texts that go on.
std::string words_of(const std::string& line) {
  static const std::regex marks(R"(^\s*(///?<?|#|\*|>|"|- )?\s*|\s*("|\\)?\s*$)");
  return std::regex_replace(line, marks, "");
}

/// The line as the test reads it: what the list of changes quotes may be a retired name.
std::string as_read(const fs::path& file, const std::string& line) {
  static const std::regex quoted("`[^`]*`");
  return file == "CHANGELOG.md" ? std::regex_replace(line, quoted, "``") : line;
}

TEST(Words, EachRowFailsAndPassesAsItsSentencesSay) {
  const std::vector<Retired> words = retired_words();
  ASSERT_FALSE(words.empty());
  for (const Retired& one : words) {
    EXPECT_TRUE(one.is_in(one.fails)) << one.fails;
    EXPECT_FALSE(one.is_in(one.passes)) << one.passes;
    // A context is needed only if a sentence with the word passes by it.
    if (one.has_contexts) {
      EXPECT_TRUE(one.is_written_in(one.passes)) << one.passes;
    }
  }
}

TEST(Words, NoTextHasARetiredOne) {
  const std::vector<Retired> words = retired_words();
  const std::vector<fs::path> files = texts();
  EXPECT_GT(files.size(), 1000U);
  for (const fs::path& file : files) {
    for (const Retired& one : words)
      if (one.is_in(file.string()))
        ADD_FAILURE() << file.string() << ": the name has " << one.word << " (use "
                      << one.use_instead << ")";
    std::ifstream text(fs::path(MAPPROOF_SOURCE_DIR) / file);
    int number = 0;
    std::string before;
    for (std::string line; std::getline(text, line); before = as_read(file, line)) {
      ++number;
      line = as_read(file, line);
      const std::string both = words_of(before) + ' ' + words_of(line);
      for (const Retired& one : words) {
        const bool over_lines = one.word.find(' ') != std::string::npos && one.is_in(both) &&
                                !one.is_in(before) && !one.is_in(words_of(line));
        if (one.is_in(line) || over_lines)
          ADD_FAILURE() << file.string() << ':' << number << ": " << one.word << " (use "
                        << one.use_instead << "): " << (over_lines ? both : line).substr(0, 200);
      }
    }
  }
}

}  // namespace
}  // namespace mapproof
