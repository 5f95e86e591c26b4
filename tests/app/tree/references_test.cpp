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
using Keys = std::set<std::string>;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The first group of each match.
Keys found(const std::string& text, const std::regex& pattern) {
  Keys keys;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    keys.insert((*match)[1]);
  return keys;
}

/// Keys cited in comments: "[yairi2007]" or "[yairi2007, section 4.1]".
Keys cited_in(const std::string& text) {
  static const std::regex comment(R"(//([^\n]*))");
  static const std::regex key(R"(\[([A-Za-z]+[0-9][0-9-]*|[A-Z][a-z]+)(?:,[^\]]*)?\])");
  Keys keys;
  for (const std::string& line : found(text, comment)) keys.merge(found(line, key));
  return keys;
}

TEST(References, EveryKeyThatACommentCitesIsInTheListAndTheOtherWayRound) {
  const fs::path root = MAPPROOF_SOURCE_DIR;
  static const std::regex entry(R"(@[a-z]+\{([^,\s]+),)");
  const Keys listed = found(text_of(root / "docs" / "references.bib"), entry);
  std::string sources;
  for (const char* part : {"core", "render", "reports", "app"})
    for (const auto& file : fs::recursive_directory_iterator(root / part)) {
      const std::string extension = file.path().extension().string();
      if (extension != ".hpp" && extension != ".cpp") continue;
      const std::string text = text_of(file.path());
      for (const std::string& key : cited_in(text))
        EXPECT_TRUE(listed.contains(key)) << file.path() << " cites [" << key << "]";
      sources += text;
    }
  for (const std::string& key : listed)  // Cited in a comment or in what the program says.
    EXPECT_NE(sources.find("[" + key), std::string::npos) << key << " is cited nowhere";
}

TEST(References, TheCheckSeesKeysInCommentsAlone) {
  EXPECT_EQ(cited_in("/// Base64 [rfc4648, section 4], SHA [fips180-4].\nint a[kMost2];"),
            (Keys{"rfc4648", "fips180-4"}));
  EXPECT_EQ(cited_in("// Lanczos [Spectra], x [m], [0, 1], \"x[7]\""), Keys{"Spectra"});
}

}  // namespace
}  // namespace mapproof
