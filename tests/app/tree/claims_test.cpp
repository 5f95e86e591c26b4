#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace mapproof {
namespace {

namespace fs = std::filesystem;

std::string text_in(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// "0.054 m": the numbers with a unit behind them. Code between ` or indented by four is none.
std::set<std::string> figures_in(const std::string& text) {
  static const std::regex code("`[^`\n]*`|\n {4}[^\n]*");
  static const std::regex figure(
      R"(([0-9][0-9.,]*)( |\u00A0)?(m|km|cm|s|ms|minutes|min|hours|%|MB|MiB|GB|GiB)(?![a-zA-Z0-9]))");
  const std::string prose = std::regex_replace(text, code, "\n");
  std::set<std::string> figures;
  for (std::sregex_iterator match(prose.begin(), prose.end(), figure), end; match != end; ++match)
    figures.insert((*match)[1].str() + " " + (*match)[3].str());
  return figures;
}

TEST(Claims, EachFigureOfTheReadmeHasItsCommandInTheList) {
  const fs::path root = MAPPROOF_SOURCE_DIR;
  const std::set<std::string> listed = figures_in(text_in(root / "docs/claims.md"));
  const std::set<std::string> claimed = figures_in(text_in(root / "README.md"));
  EXPECT_GT(claimed.size(), 30U);
  for (const std::string& figure : claimed)
    EXPECT_TRUE(listed.contains(figure)) << figure << " of README.md is not in docs/claims.md";
}

TEST(Claims, TheCheckSeesFiguresOutsideOfCode) {
  EXPECT_EQ(figures_in("an error of 0.05 m, 12 % in 3 minutes; `--every 5s`\n\n    sleep 7 s\n"),
            (std::set<std::string>{"0.05 m", "12 %", "3 minutes"}));
}

}  // namespace
}  // namespace mapproof
