#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

// A unit is a header with its source: core/embed/isomap of isomap.hpp and isomap.cpp.

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSingleHeaders = 60;  ///< Headers that one other unit alone includes.
constexpr std::ptrdiff_t kMostFilesOfFolder = 36;

/// Headers whose functions are defined in a file each, which the header names.
const std::set<std::string> kRegisters = {
    "app/commands.hpp", "app/help/generated.hpp", "app/python/bindings.hpp",
    "core/records/ranges/range_log_forms.hpp",
    "core/records/tables/respelling.hpp", "reports/sections/figures/figure_builders.hpp"};

using Texts = std::map<std::string, std::string>;            ///< By path below the project.
using Users = std::map<std::string, std::set<std::string>>;  ///< Units by header, or by unit.

std::string source_text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// All sources and headers of the program and its libraries.
const Texts& sources() {
  static const Texts texts = [] {
    const fs::path root = MAPPROOF_SOURCE_DIR;
    Texts all;
    for (const char* folder : {"app", "core", "render", "reports"})
      for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".cpp" || extension == ".hpp")
          all[fs::relative(entry.path(), root).string()] = source_text_of(entry.path());
      }
    return all;
  }();
  return texts;
}

std::string unit_of(const std::string& path) { return path.substr(0, path.rfind('.')); }

/// The headers of `texts` that a text includes.
std::vector<std::string> included_by(const std::string& text, const Texts& texts) {
  static const std::regex include(R"re((?:^|\n)#include "([^"\n]+)")re");
  std::vector<std::string> headers;
  for (std::sregex_iterator match(text.begin(), text.end(), include), end; match != end; ++match)
    if (texts.contains((*match)[1])) headers.push_back((*match)[1]);
  return headers;
}

/// The other units that include each header.
Users users_of(const Texts& texts) {
  Users users;
  for (const auto& [path, text] : texts)
    for (const std::string& header : included_by(text, texts))
      if (unit_of(header) != unit_of(path)) users[header].insert(unit_of(path));
  return users;
}

/// The first circle of units that include one another, as "a > b > a"; empty if there is none.
std::string circle_among(const Texts& texts) {
  Users includes;
  for (const auto& [header, users] : users_of(texts))
    for (const std::string& user : users) includes[user].insert(unit_of(header));
  std::set<std::string> done;
  std::vector<std::string> path;
  const std::function<std::string(const std::string&)> visit =
      [&](const std::string& unit) -> std::string {
    if (const auto at = std::ranges::find(path, unit); at != path.end()) {
      std::string circle;
      for (auto one = at; one != path.end(); ++one) circle += *one + " > ";
      return circle + unit;
    }
    if (!done.insert(unit).second) return "";
    path.push_back(unit);
    for (const std::string& next : includes[unit])
      if (std::string circle = visit(next); !circle.empty()) return circle;
    path.pop_back();
    return "";
  };
  for (const auto& [path_of, text] : texts)
    if (std::string circle = visit(unit_of(path_of)); !circle.empty()) return circle;
  return "";
}

/// The text at the scope of namespaces alone: bodies of types and functions are "{}", comments and
/// directives are left out.
std::string outline(std::string text) {
  static const std::regex comment(R"(//[^\n]*|\n#[^\n]*)");
  text = std::regex_replace(text, comment, "");
  std::string out;
  int depth = 0, parentheses = 0;
  std::string_view rest = text;
  while (!rest.empty()) {
    if (depth == 0 && rest.starts_with("namespace ")) {
      rest.remove_prefix(std::min(rest.size(), rest.find('{') + 1));
      continue;
    }
    const char c = rest.front();
    rest.remove_prefix(1);
    if (c == '{') ++depth;
    if (depth == 0 && c != '}') out += c;
    if (depth == 0 && (c == '(' || c == ')')) parentheses += c == '(' ? 1 : -1;
    if (c == '}' && depth > 0 && --depth == 0) out += parentheses == 0 ? "{};" : "{}";
  }
  return out;
}

/// The functions that a header declares and does not define.
std::set<std::string> declared_in(const std::string& header) {
  static const std::regex function(
      R"(^\s*(?:\[\[\w+\]\]\s*)?[\w:]+(?:[<*&\s][\s\S]*)?[\s*&>]([a-z]\w*)\()");
  static const std::regex other(
      R"(^\s*(?:using|template|inline|constexpr|extern|struct|class|enum)\b)");
  std::set<std::string> names;
  const std::string text = outline(header);
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(';', begin)) != text.npos; begin = end + 1) {
    const std::string statement = text.substr(begin, end - begin);
    const std::string head = statement.substr(0, statement.find('('));
    std::smatch match;
    if (statement.ends_with("{}") || head == statement || head.find('=') != head.npos ||
        std::regex_search(statement, other))
      continue;
    const std::string declaration = head + "(";
    if (std::regex_search(declaration, match, function)) names.insert(match[1]);
  }
  return names;
}

bool defines(const std::string& source, const std::string& function) {
  return std::regex_search(source,
                           std::regex(R"((?:^|\n)[^\s;=/#][^;=\n]*\b)" + function + R"(\()"));
}

TEST(Units, AtMostSixtyHeadersAreIncludedByOneOtherUnitAlone) {
  std::string single;
  std::size_t count = 0;
  for (const auto& [header, users] : users_of(sources()))
    if (users.size() == 1) {
      ++count;
      single += "  " + header + " by " + *users.begin() + "\n";
    }
  EXPECT_GT(count, 10U);
  EXPECT_LE(count, kMostSingleHeaders) << "Merge what is one concept:\n" << single;
}

TEST(Units, DoNotIncludeEachOtherInCircles) { EXPECT_EQ(circle_among(sources()), ""); }

TEST(Units, DefineWhatTheirHeaderDeclares) {
  int functions = 0;
  for (const auto& [path, text] : sources()) {
    if (!path.ends_with(".hpp") || kRegisters.contains(path)) continue;
    const auto source = sources().find(unit_of(path) + ".cpp");
    for (const std::string& name : declared_in(text)) {
      ++functions;
      EXPECT_TRUE(source != sources().end() && defines(source->second, name))
          << path << " declares " << name << ", which " << unit_of(path) << ".cpp does not define";
    }
  }
  EXPECT_GT(functions, 500);
}

TEST(Units, AreNotNamedAsPartsOfAWhole) {
  static const std::regex part(R"((_parts|_words|_values|_files|_set_\w+)\.[a-z]+$)");
  for (const auto& [path, text] : sources())
    EXPECT_FALSE(std::regex_search(path, part)) << path << ": name the concept that it holds";
}

TEST(Folders, HoldSomeThirtyFiles) {
  const fs::path root = MAPPROOF_SOURCE_DIR;
  // Data: a file per figure, record or input, which scripts make and tests find by name.
  const std::set<std::string> data = {"tests/baselines", "tests/data", "tests/fuzz/corpus",
                                      "docs/schemas"};
  for (const char* top : {"app", "core", "render", "reports", "tests", "docs", "scripts",
                          "templates", "experiments", "examples"})
    for (auto entry = fs::recursive_directory_iterator(root / top); entry != fs::end(entry);
         ++entry) {
      const std::string name = entry->path().filename().string();
      if (!entry->is_directory()) continue;
      if (name == "node_modules" || name == "__pycache__" ||
          data.contains(fs::relative(entry->path(), root).string())) {
        entry.disable_recursion_pending();
        continue;
      }
      const auto files = std::count_if(fs::directory_iterator(entry->path()), {},
                                       [](const auto& file) { return file.is_regular_file(); });
      EXPECT_LE(files, kMostFilesOfFolder) << entry->path() << ": make folders of it";
    }
}

TEST(Units, TheChecksSeeWhatTheyShould) {
  const Texts texts = {{"core/a.hpp", "#include \"core/b.hpp\"\n"},
                       {"core/a.cpp", "#include \"core/a.hpp\"\n#include <vector>\n"},
                       {"core/b.hpp", "\n"},
                       {"core/b.cpp", "#include \"core/b.hpp\"\n\n#include \"core/c.hpp\"\n"},
                       {"core/c.hpp", "#include \"core/a.hpp\"\n"}};
  EXPECT_EQ(users_of(texts).at("core/b.hpp"), std::set<std::string>{"core/a"});
  EXPECT_EQ(circle_among(texts), "core/a > core/b > core/c > core/a");
  const std::string header =
      "#pragma once\n#define X(a) f(a)\nnamespace m {\n/// Says so (see g()).\n"
      "struct S { int h(int); };\ninline int i(int x) { return x; }\nextern int (*k)(int);\n"
      "std::vector<int>* make_it(const S& s = {},\n  int n = g(2));\nS& of(int);\n"
      "[[nodiscard]] bool is_there();\ninline constexpr int kX = f(3);\n}  // namespace m\n";
  EXPECT_EQ(declared_in(header), (std::set<std::string>{"make_it", "of", "is_there"}));
  EXPECT_TRUE(defines("\nS& of(int x) {\n  return s;\n}\n", "of"));
  EXPECT_FALSE(defines("\nint main() {\n  return of(3);\n}\nint x = of(2);\n", "of"));
}

}  // namespace
}  // namespace mapproof
