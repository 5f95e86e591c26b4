#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace mapproof {
namespace {

namespace fs = std::filesystem;

using Modules = std::set<std::string>;

/// Which modules each module may include, itself apart. docs/architecture.md draws this.
const std::map<std::string, Modules>& allowed() {
  static const Modules leaves = {"core/model", "core/base", "core/statistics"};
  static const auto with_leaves = [](Modules more) {
    more.insert(leaves.begin(), leaves.end());
    return more;
  };
  static const std::map<std::string, Modules> table = {
      {"core/results", {"core/base"}},
      {"core/model", {"core/base", "core/statistics", "core/results"}},
      {"core/base", {}},
      {"core/statistics", {"core/base"}},
      {"core/linalg", with_leaves({})},
      {"core/graph", with_leaves({})},
      {"core/simulate", with_leaves({})},
      {"core/observe", with_leaves({"core/linalg"})},
      {"core/embed", with_leaves({"core/linalg", "core/graph", "core/observe"})},
      {"core/align", with_leaves({"core/linalg"})},
      {"core/range_slam", with_leaves({"core/linalg", "core/align"})},
      {"core/score", with_leaves({"core/align", "core/linalg"})},
      {"core/json", {"core/base"}},
      {"core/records", {"core/model", "core/results", "core/base", "core/json"}},
      {"core/experiment", with_leaves({"core/simulate", "core/observe", "core/embed", "core/align",
                                       "core/range_slam", "core/score", "core/records"})},
      {"core/pairs", with_leaves({"core/linalg", "core/graph", "core/observe", "core/embed"})},
      {"core/missing", with_leaves({"core/linalg", "core/graph", "core/observe", "core/embed"})},
      {"core/submaps", with_leaves({"core/linalg", "core/graph", "core/observe", "core/embed",
                                    "core/align", "core/pairs", "core/missing"})},
      {"core/labels", with_leaves({"core/linalg", "core/graph", "core/observe", "core/embed",
                                   "core/align", "core/pairs"})},
      {"core/mixed",
       with_leaves({"core/linalg", "core/graph", "core/observe", "core/embed", "core/pairs"})},
      {"core/certainty", with_leaves({"core/linalg", "core/observe", "core/embed", "core/align",
                                      "core/score", "core/pairs"})},
      {"core/choice", with_leaves({"core/linalg", "core/graph", "core/observe", "core/embed",
                                   "core/align", "core/score", "core/pairs", "core/certainty"})},
      {"core/follow", with_leaves({"core/linalg", "core/graph", "core/observe", "core/embed",
                                   "core/align", "core/pairs", "core/labels"})},
      {"core/trials",
       with_leaves({"core/results", "core/simulate", "core/observe", "core/embed", "core/align",
                    "core/score", "core/linalg", "core/graph", "core/records", "core/experiment",
                    "core/pairs", "core/missing", "core/submaps", "core/labels", "core/mixed",
                    "core/certainty", "core/choice", "core/follow"})},
      {"core/topics", with_leaves({"core/results", "core/json", "core/records", "core/range_slam",
                                   "core/experiment", "core/trials"})},
      {"render/base", with_leaves({})},
      {"render/image", with_leaves({"render/base"})},
      {"render/theme", with_leaves({"render/base"})},
      {"render/plot", with_leaves({"render/base", "render/theme", "render/image", "core/json"})},
      {"render/svg", with_leaves({"render/base", "render/plot", "render/theme", "render/image"})},
      {"render/cairo", with_leaves({"render/base", "render/plot", "render/theme", "render/image"})},
      {"render/figures", with_leaves({"render/base", "render/plot", "render/theme"})},
      {"render/scene",
       with_leaves({"render/base", "render/plot", "render/theme", "render/figures", "core/json"})},
      {"render/scene_client",
       with_leaves({"render/base", "render/theme", "render/image", "render/scene"})},
      {"render/vtk", with_leaves({"render/base", "render/theme", "render/image", "render/scene"})},
      {"render/animation", with_leaves({"render/image"})},
      {"render/output",
       with_leaves({"render/base", "render/plot", "render/theme", "render/image", "render/svg",
                    "render/cairo", "render/scene", "render/scene_client", "render/animation"})},
      {"reports/model", with_leaves({})},
      {"reports/sections", with_leaves({"core/results", "reports/model", "render/figures",
                                        "render/plot", "render/scene"})},
      {"reports/diff", with_leaves({"reports/model", "core/results", "core/json", "core/records",
                                    "core/topics", "core/align", "render/base", "render/image",
                                    "render/plot", "render/theme", "render/scene"})},
      {"reports/history", with_leaves({"reports/model", "core/results", "core/json", "core/records",
                                       "core/topics", "render/figures", "render/plot"})},
      {"reports/html",
       with_leaves({"reports/model", "reports/diff", "reports/tables", "render/image"})},
      {"reports/tables", with_leaves({"reports/model"})},
  };
  return table;
}

/// Headers of libraries that only these modules may see.
const std::map<std::string, Modules>& kept_in() {
  static const std::map<std::string, Modules> table = {
      {"cairo", {"render/cairo"}},
      {"nlohmann/",
       {"core/json", "core/records", "render/plot", "render/scene", "reports/diff",
        "reports/history"}},
      {"csdp/", {"core/embed"}},
      {"ceres/", {"core/range_slam"}},
      {"glog/", {"core/range_slam"}},
      {"expat", {"reports/diff"}},
      {"png.h", {"render/image"}},
      {"matio", {"core/records"}},
      {"sqlite3", {"reports/history"}},
      {"sha256.h", {"core/base"}},
      {"tbb/", {"core/base"}},
      {"zlib", {"core/base"}},
      {"lzma", {"core/base"}},
      {"hb", {"render/theme", "render/cairo"}},
      {"ft2build", {"render/theme", "render/cairo"}},
      {"kainjow/", {"reports/html"}},
      {"vtk", {"render/vtk"}},
      {"libav", {"render/animation"}},
      {"GL/", {"render/vtk"}},
  };
  return table;
}

/// "core/embed" of "core/embed/isomap.hpp".
std::string module_of(const std::string& path) {
  const std::size_t first = path.find('/');
  const std::size_t second = path.find('/', first + 1);
  return second == std::string::npos ? path : path.substr(0, second);
}

/// Why the module may not include that, or nothing.
std::string objection(const std::string& module, const std::string& included, bool is_ours) {
  if (is_ours) {
    const std::string other = module_of(included);
    if (other == module) return "";
    const auto row = allowed().find(module);
    if (row == allowed().end()) return "the module " + module + " has no place in the layers";
    return row->second.contains(other) ? "" : module + " may not include " + other;
  }
  for (const auto& [prefix, modules] : kept_in())
    if (included.starts_with(prefix) && !modules.contains(module))
      return module + " may not include <" + included + ">";
  return "";
}

std::vector<std::string> objections_in(const std::string& text, const std::string& module) {
  std::vector<std::string> objections;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("#include ")) continue;
    const bool is_ours = line[9] == '"';
    const std::size_t end = line.find(is_ours ? '"' : '>', 10);
    const std::string included = line.substr(10, end - 10);
    if (is_ours && included.ends_with(".inc")) continue;  // generated
    const std::string why = objection(module, included, is_ours);
    if (!why.empty()) objections.push_back(why);
  }
  return objections;
}

TEST(Layers, NoSourceIncludesWhatItsLayerMayNotSee) {
  int sources = 0;
  for (const char* library : {"core", "render", "reports"})
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(MAPPROOF_SOURCE_DIR) / library)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".hpp") continue;
      ++sources;
      const std::string path = fs::relative(entry.path(), MAPPROOF_SOURCE_DIR).string();
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      for (const std::string& why : objections_in(text.str(), module_of(path)))
        ADD_FAILURE() << path << ": " << why;
    }
  EXPECT_GT(sources, 100);
}

TEST(Layers, TheCheckRefusesWhatItShould) {
  EXPECT_EQ(objections_in("#include \"core/embed/isomap.hpp\"\n", "core/records").size(), 1U);
  EXPECT_EQ(objections_in("#include \"render/plot/figure.hpp\"\n", "core/embed").size(), 1U);
  EXPECT_EQ(objections_in("#include \"render/cairo/x.hpp\"\n", "reports/html").size(), 1U);
  EXPECT_EQ(objections_in("#include <cairo.h>\n", "render/svg").size(), 1U);
  EXPECT_EQ(objections_in("#include <nlohmann/json.hpp>\n", "core/embed").size(), 1U);
  EXPECT_EQ(objections_in("#include \"core/model/points.hpp\"\n", "somewhere/new").size(), 1U);
  EXPECT_TRUE(objections_in("#include \"core/model/points.hpp\"\n#include <vector>\n", "core/embed")
                  .empty());
}

}  // namespace
}  // namespace mapproof
