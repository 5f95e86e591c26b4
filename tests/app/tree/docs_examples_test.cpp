// The pages of docs/examples, which README shows to those who have not built the program.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

const fs::path kExamplesRoot = MAPPROOF_SOURCE_DIR;
const fs::path kExamplesFolder = kExamplesRoot / "docs/examples";

constexpr std::uintmax_t kMostExampleBytes = 3'000'000;

std::vector<fs::path> example_pages() {
  std::vector<fs::path> pages;
  for (const auto& entry : fs::recursive_directory_iterator(kExamplesFolder))
    if (entry.path().extension() == ".html") pages.push_back(entry.path());
  return pages;
}

/// Where links and images of a page or a document lead, without those to other hosts, data and
/// parts of the same page.
std::set<std::string> relative_links(const std::string& text, const std::regex& link) {
  static const std::regex absolute("^(?:[a-z]+:|#|//)");
  std::set<std::string> links;
  for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
    const std::string target = (*it)[1].str();
    if (!target.empty() && !std::regex_search(target, absolute))
      links.insert(target.substr(0, target.find_first_of("#?")));
  }
  return links;
}

TEST(DocsExamples, AreAReportAComparisonAndANightlyRunOfAtMostThreeMegabytes) {
  for (const char* page : {"report.html", "comparison.html", "nightly/index.html"})
    EXPECT_TRUE(fs::is_regular_file(kExamplesFolder / page)) << page;
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kExamplesFolder))
    if (entry.is_regular_file()) bytes += entry.file_size();
  EXPECT_LE(bytes, kMostExampleBytes) << "scripts/docs-examples makes them";
}

TEST(DocsExamples, StateTheVersionAndShowNoPathOfAMachine) {
  static const std::regex version(R"re(mapproof \d+\.\d+\.\d+)re");
  static const std::regex path(R"re(/(?:home|tmp|root|work)/[A-Za-z0-9])re");
  for (const fs::path& page : example_pages()) {
    const std::string text = read_file(page);
    EXPECT_TRUE(std::regex_search(text, version)) << page << ": made by an old program";
    std::smatch found;
    EXPECT_FALSE(std::regex_search(text, found, path)) << page << ": " << found.str();
  }
}

/// A page without its scripts and styles, which hold text that looks like links.
std::string markup_of(const std::string& page) {
  std::string markup;
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t open = std::min(page.find("<script", at), page.find("<style", at));
    if (open == std::string::npos) return markup + page.substr(at);
    markup += page.substr(at, open - at);
    at = page.find(page[open + 2] == 'c' ? "</script>" : "</style>", open);
  }
  return markup;
}

TEST(DocsExamples, HaveNoRelativeLinkThatIsBroken) {
  static const std::regex link(R"re(<a\s[^>]*href="([^"]*)")re");
  std::size_t links = 0;
  for (const fs::path& page : example_pages())
    for (const std::string& target : relative_links(markup_of(read_file(page)), link)) {
      ++links;
      EXPECT_TRUE(fs::exists(page.parent_path() / target)) << page << " leads to " << target;
    }
  EXPECT_GT(links, 3U) << "from the index of nightly runs to their pages, and back";
}

TEST(DocsExamples, AreLinkedBelowReadmesFirstImages) {
  static const std::regex link(R"re(\]\(([^)]+)\))re"), image(R"re(<img[^>]*src="([^"]+)")re");
  const std::string readme = read_file(kExamplesRoot / "README.md");
  const std::size_t first_table = readme.find("\n| ");
  ASSERT_NE(first_table, std::string::npos);
  const std::string hero = readme.substr(0, first_table);
  const std::set<std::string> links = relative_links(hero, link);
  for (const char* page : {"report.html", "comparison.html", "nightly/index.html"})
    EXPECT_TRUE(links.contains(std::string("docs/examples/") + page)) << page;
  for (const std::string& one : relative_links(hero, image)) {
    ASSERT_TRUE(fs::is_regular_file(kExamplesRoot / one)) << one;
    EXPECT_LE(fs::file_size(kExamplesRoot / one), 2'000'000U) << one;
  }
  EXPECT_GE(relative_links(hero, image).size(), 2U);
}

}  // namespace
}  // namespace mapproof::test
