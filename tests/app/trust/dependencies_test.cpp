#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

const std::string kScripts = std::string(MAPPROOF_SOURCE_DIR) + "/scripts/";

/// Packages that the program is built with and that are no part of it.
const std::set<std::string> kTools = {
    "ca-certificates", "cmake",      "g++",          "git",
    "ninja-build",     "pkg-config", "libgtest-dev", "librapidcheck-dev",
    "libvalijson-dev"};

/// Other names of what is listed under its own.
const std::set<std::string> kAliases = {"liblapack-dev",   "libosmesa6-dev", "libavfilter-dev",
                                        "libavformat-dev", "libavutil-dev",  "libswscale-dev"};

/// The packages of the program's parts.
std::set<std::string> packages() {
  std::ifstream file(kScripts + "packages.txt");
  std::set<std::string> found;
  bool is_part = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#') || line.empty()) continue;
    if (line.starts_with('['))
      is_part =
          line == "[core]" || line == "[program]" || line == "[scenes]" || line == "[animation]";
    else if (is_part)
      found.insert(line.ends_with('?') ? line.substr(0, line.size() - 1) : line);
  }
  return found;
}

TEST(Dependencies, EveryPackageOfTheProgramIsListedWithItsLicence) {
  std::ifstream file(kScripts + "dependencies.txt");
  std::stringstream text;
  text << file.rdbuf();
  const std::string listed = text.str();
  for (const std::string& package : packages())
    if (!kTools.contains(package) && !kAliases.contains(package)) {
      EXPECT_NE(listed.find(package), std::string::npos) << package;
    }
}

TEST(Dependencies, OfTheProgramHaveNamesVersionsAndLicences) {
  for (const auto& words :
       {std::vector<std::string>{"--version", "--json"}, {"--json", "--version"}}) {
    const Outcome outcome = mapproof(words);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
    const auto object = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(object["schema"]["name"], "mapproof.result.version");
    std::set<std::string> names;
    for (const auto& one : object["dependencies"]) {
      names.insert(one["name"]);
      EXPECT_FALSE(one["version"].get<std::string>().empty()) << one;
      EXPECT_FALSE(one["licence"].get<std::string>().empty()) << one;
    }
    for (const char* name : {"Eigen", "VTK", "Mesa", "cairo", "FFmpeg", "SQLite"})
      EXPECT_TRUE(names.contains(name)) << name;
  }
}

}  // namespace
}  // namespace mapproof::test
