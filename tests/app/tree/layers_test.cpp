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

/// The text of a file. Empty if there is none.
std::string source_text(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The words behind USES in a call of mapproof_module (scripts/cmake/Module.cmake).
Modules uses_in(const std::string& cmake) {
  std::istringstream words(cmake);
  Modules uses;
  bool in_uses = false;
  for (std::string word; words >> word;) {
    if (word == "USES")
      in_uses = true;
    else if (word == "PACKAGES" || word == "SOURCES" || word == "HEADERS")
      in_uses = false;
    else if (in_uses)
      uses.insert(word.ends_with(')') ? word.substr(0, word.size() - 1) : word);
  }
  return uses;
}

/// Which modules each module may include, itself apart: as its CMakeLists.txt declares. CMake
/// refuses circles.
const std::map<std::string, Modules>& allowed() {
  static const std::map<std::string, Modules> table = [] {
    std::map<std::string, Modules> modules;
    for (const char* library : {"core", "render", "reports"})
      for (const auto& entry : fs::directory_iterator(fs::path(MAPPROOF_SOURCE_DIR) / library))
        if (entry.is_directory())
          modules[std::string(library) + "/" + entry.path().filename().string()] =
              uses_in(source_text(entry.path() / "CMakeLists.txt"));
    // It is not a module of the library but a program that draws 3-D figures.
    modules["render/vtk"] = {"core/base", "render/image", "render/scene", "render/theme"};
    return modules;
  }();
  return table;
}

/// Headers of libraries that only these modules may see.
const std::map<std::string, Modules>& kept_in() {
  static const std::map<std::string, Modules> table = {
      {"cairo", {"render/cairo"}},
      {"nlohmann/",
       {"core/external", "core/json", "core/records", "render/plot", "render/scene", "reports/diff",
        "reports/history"}},
      {"csdp/", {"core/embed"}},
      {"ceres/", {"core/range_slam"}},
      {"glog/", {"core/range_slam"}},
      {"expat", {"reports/diff"}},
      {"png.h", {"render/image"}},
      {"matio", {"core/records"}},
      {"zip.h", {"core/records"}},
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

/// Packages that only these modules may link, as CMake names them.
const std::map<std::string, Modules>& linked_in() {
  static const std::map<std::string, Modules> table = {
      {"PkgConfig::CAIRO", {"render/cairo"}},
      {"PkgConfig::FREETYPE", {"render/theme", "render/cairo"}},
      {"PkgConfig::HARFBUZZ", {"render/theme", "render/cairo"}},
      {"PkgConfig::DEFLATE", {"core/base", "render/image", "render/cairo"}},
      {"PkgConfig::PNG", {"render/image"}},
      {"PkgConfig::FFMPEG", {"render/animation"}},
      {"VTK_LIBRARIES", {"render/vtk"}},
      {"OSMESA_LIBRARY", {"render/vtk"}},
      {"OpenGL::EGL", {"render/vtk"}},
      {"PkgConfig::EXPAT", {"reports/diff"}},
      {"PkgConfig::SQLITE", {"reports/history"}},
      {"PkgConfig::MATIO", {"core/records"}},
      {"PkgConfig::MD", {"core/base"}},
      {"LibLZMA::LibLZMA", {"core/base"}},
      {"TBB::tbb", {"core/base"}},
      {"ZLIB::ZLIB", {"core/base"}},
      {"CSDP::sdp", {"core/embed"}},
      {"Ceres::ceres", {"core/range_slam"}},
      {"Boost::headers", {"core/statistics", "reports/history"}},
      {"CLI11::CLI11", {}},
      {"spdlog::spdlog", {}},
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

/// One for each line that includes what it may not.
std::vector<std::string> objections_in(const std::string& text, const std::string& module) {
  std::vector<std::string> objections;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (!line.starts_with("#include ")) continue;
    const bool is_ours = line[9] == '"';
    const std::size_t end = line.find(is_ours ? '"' : '>', 10);
    const std::string included = line.substr(10, end - 10);
    if (is_ours && included.ends_with(".inc")) continue;  // generated
    const std::string why = objection(module, included, is_ours);
    if (!why.empty()) objections.push_back("line " + std::to_string(number) + ": " + why);
  }
  return objections;
}

/// Why a folder's CMakeLists.txt may not link that word of it, or nothing. Which modules a module
/// uses is held by CMake itself (scripts/cmake/Module.cmake); what is linked past that is not.
std::string objection_to_link(const std::string& module, std::string word) {
  std::erase_if(word, [](char c) { return c == '$' || c == '{' || c == '}' || c == ')'; });
  for (const auto& [package, modules] : linked_in())
    if (word.ends_with(package) && !modules.contains(module))
      return module + " may not link " + package;
  static const std::vector<std::string> libraries = {"core", "render", "reports", "app"};
  const auto layer = [](std::string_view name) {
    return std::ranges::find(libraries, name.substr(0, name.find_first_of("/_"))) -
           libraries.begin();
  };
  for (const std::string_view prefix : {"mapproof::", "mapproof_"})
    if (word.starts_with(prefix)) {
      const std::string_view name = std::string_view(word).substr(prefix.size());
      const auto other = layer(name);
      // A library may name those below it; a module links others by USES alone.
      const bool is_module = name.find('_') != name.npos && module.find('/') != module.npos;
      if (other < std::ssize(libraries) && (other > layer(module) || is_module))
        return module + " may not link " + word;
    }
  return "";
}

/// One for each line of a CMakeLists.txt that links what its module may not.
std::vector<std::string> objections_to_links(const std::string& cmake, const std::string& module) {
  std::vector<std::string> objections;
  std::istringstream lines(cmake);
  int number = 0;
  bool links = false;  // Within target_link_libraries(), or behind PACKAGES.
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line.substr(0, line.find('#')));
    for (std::string word; words >> word;) {
      if (const std::size_t open = word.find('('); open != word.npos) {
        links = word.starts_with("target_link_libraries");
        continue;  // Its own name follows the parenthesis.
      }
      if (word.ends_with("PACKAGES")) links = true;
      if (word == "SOURCES" || word == "HEADERS" || word == "USES") links = false;
      if (const std::string why = links ? objection_to_link(module, word) : ""; !why.empty())
        objections.push_back("line " + std::to_string(number) + ": " + why);
    }
  }
  return objections;
}

TEST(Layers, NoModuleLinksWhatItsLayerMayNotSee) {
  int files = 0;
  for (const char* library : {"core", "render", "reports"})
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(MAPPROOF_SOURCE_DIR) / library)) {
      if (entry.path().filename() != "CMakeLists.txt") continue;
      ++files;
      const std::string folder =
          fs::relative(entry.path().parent_path(), MAPPROOF_SOURCE_DIR).string();
      for (const std::string& why : objections_to_links(source_text(entry.path()), folder))
        ADD_FAILURE() << folder << "/CMakeLists.txt: " << why;
    }
  EXPECT_GT(files, 30);
}

TEST(Layers, TheCheckRefusesLinksThatItShould) {
  const auto objections = [](const std::string& cmake, const std::string& module) {
    return objections_to_links(cmake, module);
  };
  EXPECT_EQ(objections("mapproof_module(core/embed\n  USES core/base\n  PACKAGES "
                       "PkgConfig::CAIRO\n  SOURCES\n    a.cpp)\n",
                       "core/embed"),
            std::vector<std::string>{"line 3: core/embed may not link PkgConfig::CAIRO"});
  EXPECT_EQ(objections("target_link_libraries(mapproof_core_embed PRIVATE mapproof_render_plot)\n",
                       "core/embed"),
            std::vector<std::string>{"line 1: core/embed may not link mapproof_render_plot"});
  EXPECT_EQ(objections("target_link_libraries(x\n  PRIVATE mapproof_core_model)\n", "core/embed"),
            std::vector<std::string>{"line 2: core/embed may not link mapproof_core_model"});
  EXPECT_EQ(objections("mapproof_library(core\n  HEADER_PACKAGES mapproof::render)\n", "core"),
            std::vector<std::string>{"line 2: core may not link mapproof::render"});
  EXPECT_TRUE(objections("mapproof_library(reports\n  HEADER_PACKAGES mapproof::core)\n", "reports")
                  .empty());
  EXPECT_TRUE(objections("mapproof_module(x\n  PACKAGES TBB::tbb)\n", "core/base").empty());
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
      for (const std::string& why : objections_in(source_text(entry.path()), module_of(path)))
        ADD_FAILURE() << path << ": " << why;
    }
  EXPECT_GT(sources, 100);
}

TEST(Layers, TheCheckRefusesWhatItShould) {
  const auto objections = objections_in("\n#include \"core/embed/isomap.hpp\"\n", "core/records");
  ASSERT_EQ(objections.size(), 1U);
  EXPECT_EQ(objections[0], "line 2: core/records may not include core/embed");
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
