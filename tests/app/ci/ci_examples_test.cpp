#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/app/ci/plot_scripts.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = MAPPROOF_SOURCE_DIR;
const fs::path kExamples = kSource / "examples/ci";
const std::string kSmall = (kSource / "tests/data/experiments/small.json").string();

/// A PATH on which the program is found first.
std::string path_with_program() {
  return fs::path(program()).parent_path().string() + ":/usr/local/bin:/usr/bin:/bin";
}

/// Runs a command in a folder.
Outcome run_in(const fs::path& folder, std::vector<std::string> command) {
  command.insert(command.begin(), {"env", "-C", folder.string(), "PATH=" + path_with_program(),
                                   "PYTHONDONTWRITEBYTECODE=1"});
  return run_program(command);
}

TEST(CiExamples, AreThoseThatTheDocumentationShows) {
  const std::string page = read_file(kSource / "docs/ci.md");
  for (const char* name : {"github.yml", "gitlab-ci.yml"})
    EXPECT_NE(page.find("\n" + read_file(kExamples / name) + "```"), std::string::npos) << name;
  for (const auto& entry : fs::directory_iterator(kExamples))
    EXPECT_NE(page.find("ci/" + entry.path().filename().string()), std::string::npos)
        << entry.path();
}

TEST(CiExamples, ThePytestPluginFailsATestWhoseFigureChanged) {
  if (!has_matplotlib() || !has_module("pytest")) GTEST_SKIP() << "no matplotlib or pytest here";
  const TemporaryFolder folder;
  fs::copy_file(kExamples / "pytest_mapproof.py", folder / "pytest_mapproof.py");
  folder.file("conftest.py", "pytest_plugins = [\"pytest_mapproof\"]\n");
  folder.file("pytest.ini", "[pytest]\nmapproof_baseline = figures\n");
  folder.file("test_figures.py", R"(import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import os
import pytest

def draw():
    figure, axes = plt.subplots(figsize=(3, 2))
    axes.plot([0, 1, 2], [0, float(os.environ["HEIGHT"]), 1], marker="o")
    return figure

@pytest.mark.parametrize("name", ["a/b"])
def test_figure(figure_check, name):
    figure_check(draw())

def test_file(figure_check, tmp_path):
    draw().savefig(tmp_path / "drawn.svg")
    figure_check(tmp_path / "drawn.svg", "path.svg")
)");
  const auto run = [&](const std::string& height, const std::string& option = "--tb=short") {
    return run_in(folder.path(), {"HEIGHT=" + height, python(), "-m", "pytest", "-q", "-p",
                                  "no:cacheprovider", option});
  };
  const Outcome first = run("2");
  EXPECT_EQ(first.exit_code, 1) << first.out;
  EXPECT_NE(first.out.find("there is no baseline"), std::string::npos) << first.out;
  EXPECT_EQ(run("2", "--mapproof-approve").exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "figures/test_figure_a_b.png"));
  const Outcome same = run("2");
  EXPECT_EQ(same.exit_code, 0) << same.out;
  const Outcome moved = run("2.3");
  EXPECT_EQ(moved.exit_code, 1);
  EXPECT_NE(moved.out.find("2 failed"), std::string::npos) << moved.out;
  EXPECT_NE(moved.out.find("by its pixels alone"), std::string::npos) << moved.out;
  const Outcome none = run("2", "--mapproof=/no/such/program");
  EXPECT_NE(none.out.find("--mapproof names the program"), std::string::npos) << none.out;
}

TEST(CiExamples, TheCtestFunctionFailsATestWhoseFigureChanged) {
  const TemporaryFolder folder;
  const std::string images = (kSource / "tests/baselines").string();
  fs::create_directories(folder / "baseline");
  fs::copy_file(images + "/map-usual.png", folder / "baseline/map.png");
  folder.file("copy.cmake", "file(COPY_FILE ${FROM} map.png)\n");
  folder.file("CMakeLists.txt", R"(cmake_minimum_required(VERSION 3.21)
project(figures NONE)
enable_testing()
list(APPEND CMAKE_MODULE_PATH ")" + kExamples.string() +
                                    R"(")
include(MapproofFigureTest)
foreach(image map-usual curve-log)
  mapproof_add_figure_test(NAME ${image}
    COMMAND ${CMAKE_COMMAND} "-DFROM=)" +
                                    images + R"(/${image}.png" -P ${CMAKE_SOURCE_DIR}/copy.cmake
    BASELINE ${CMAKE_SOURCE_DIR}/baseline EXCLUDE "*.pdf" ALLOW better new LABELS figures)
endforeach()
)");
  const Outcome configured = run_in(folder.path(), {"cmake", "-S", ".", "-B", "build"});
  ASSERT_EQ(configured.exit_code, 0) << configured.out << configured.error;
  const Outcome outcome =
      run_in(folder / "build", {"ctest", "--output-on-failure", "-L", "figures"});
  EXPECT_NE(outcome.out.find("50% tests passed, 1 tests failed out of 2"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("map: png, by its pixels alone"), std::string::npos) << outcome.out;
  EXPECT_TRUE(fs::exists(folder / "build/figures/curve-log/images/map.png/current.png"));
  EXPECT_TRUE(fs::exists(folder / "build/figures/curve-log/diff.html"));
}

/// The command of an example, in one line.
std::string command_of(const char* example) {
  std::string text = read_file(kExamples / example);
  text = text.substr(text.find("mapproof check"));
  text = text.substr(0, text.find("plot.py") + std::string("plot.py").size());
  std::ranges::replace(text, '\n', ' ');
  return text;
}

TEST(CiExamples, TheirCommandsCompareAChangeWithTheBranchItIsFor) {
  if (!has_matplotlib()) GTEST_SKIP() << "no matplotlib here";
  const TemporaryFolder folder;
  const std::string plot =
      "import pathlib, runpy, sys, os\n"
      "os.chdir(pathlib.Path(__file__).parent / 'plots')\n"
      "sys.argv = ['draw.py', '2']\nrunpy.run_path('../draw.py')\n";
  const auto shell = [&](const fs::path& where, const std::string& command) {
    const Outcome outcome = run_in(where, {"bash", "-e", "-o", "pipefail", "-c", command});
    EXPECT_EQ(outcome.exit_code, 0) << command << outcome.out << outcome.error;
  };
  folder.file("upstream/draw.py", kMatplotlibScript);
  folder.file("upstream/plot.py", plot);
  fs::create_directories(folder / "upstream/plots");
  shell(folder / "upstream",
        "python3=/usr/bin/python3; $python3 plot.py && git init -q -b main . && git add -A && "
        "git -c user.name=S -c user.email=s@example.org commit -q -m Plots");
  shell(folder.path(), "git clone -q upstream clone && cd clone && git fetch -q origin main");
  const fs::path clone = folder / "clone";
  const Environment hub{{"GITHUB_BASE_REF", "main"},
                        {"GITHUB_STEP_SUMMARY", (folder / "summary.md").c_str()}};
  for (const char* example : {"github.yml", "gitlab-ci.yml"}) {
    write_file(clone / "plot.py", plot);
    std::string command = command_of(example);
    command.replace(command.find("python3 plot.py"), 7, python());
    shell(clone, command);
    std::string moved = plot;
    moved.replace(moved.find("'2'"), 3, "'2.3'");
    write_file(clone / "plot.py", moved);
    const Outcome outcome = run_in(clone, {"bash", "-e", "-c", command});
    EXPECT_EQ(outcome.exit_code, 1) << example << outcome.out << outcome.error;
    EXPECT_TRUE(fs::exists(clone / "out/images/path.png/difference.png"));
    EXPECT_TRUE(fs::exists(clone / "out/diff.html"));
  }
  EXPECT_NE(read_file(folder / "summary.md").find("#### path, png"), std::string::npos);
  EXPECT_NE(read_file(clone / "out/diff.junit.xml").find("[[ATTACHMENT|"), std::string::npos);
}

TEST(OurCi, HasStepsThatAreScriptsOfTheProjectWithOptionsThatExist) {
  const Outcome outcome =
      run_program({"python3", (kSource / "tests/app/ci/ci_files.py").string(), kSource.string()});
  if (outcome.exit_code == 77 || outcome.exit_code == 127) GTEST_SKIP() << "no PyYAML here";
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.error;
}

TEST(OurCi, ComparesTheFiguresOfAChange) {
  const TemporaryFolder folder;
  const std::string out = folder / "figures";
  const Environment hub{{"GITHUB_STEP_SUMMARY", (folder / "summary.md").c_str()}};
  const Outcome outcome =
      run_program({(kSource / "scripts/check").string(), "figures", "--program", program(),
                   "--base-program", program(), "--profile", "tiny", "--out", out, kSmall});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.error;
  EXPECT_TRUE(fs::exists(out + "/diff.html"));
  EXPECT_TRUE(fs::exists(out + "/diff.junit.xml"));
  EXPECT_NE(read_file(folder / "summary.md").find("### mapproof diff: passes"), std::string::npos);
  EXPECT_EQ(run_program({(kSource / "scripts/check").string(), "figures", "--bsae", "x"}).exit_code,
            2);
}

/// Programs that stand for those of a build: each notes how it was called; cmake "builds" mapproof.
TEST(OurCi, BuildsTheBaseAndTheChangeAndComparesTheirFigures) {
  if (run_program({"git", "-C", kSource.string(), "rev-parse", "--verify", "HEAD"}).exit_code != 0)
    GTEST_SKIP() << "the source is not a git repository here";
  const TemporaryFolder folder;
  const std::string bin = folder / "bin", log = folder / "log", out = folder / "out";
  const std::string note = "#!/bin/sh\necho \"$(basename \"$0\") $*\" >>'" + log + "'\n";
  write_file(bin + "/ninja", note);
  write_file(bin + "/mapproof", note);
  write_file(bin + "/cmake", note + "[ \"$1\" != --build ] || { mkdir -p \"$2/app\"; ln -sf '" +
                                 bin + "/mapproof' \"$2/app/mapproof\"; }\n");
  for (const char* name : {"ninja", "mapproof", "cmake"})
    fs::permissions(bin + "/" + name, fs::perms::owner_all);
  const std::string path = bin + ":/usr/local/bin:/usr/bin:/bin";
  const std::string build = folder / "build";
  const Environment stubs{
      {"PATH", path.c_str()}, {"BUILD", build.c_str()}, {"GITHUB_STEP_SUMMARY", nullptr}};
  const Outcome outcome = run_program(
      {(kSource / "scripts/check").string(), "figures", "--base", "HEAD", "--out", out});
  if (outcome.error.find("installing") != std::string::npos || outcome.exit_code == 2)
    GTEST_SKIP() << "packages are missing here: " << outcome.error;
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_TRUE(fs::exists(build + "/base/source/CMakeLists.txt"));
  const std::string calls = read_file(log);
  for (const std::string& call :
       {"cmake -S " + build + "/base/source -B " + build + "/base/build",
        "mapproof reproduce all --profile quick --quiet --out " + out + "/base",
        "mapproof reproduce all --profile quick --quiet --out " + out + "/change",
        "mapproof diff " + out + "/base " + out + "/change"})
    EXPECT_NE(calls.find(call), std::string::npos) << call << "\n" << calls;
}

TEST(OurCi, KeepsTheHistoryOfNightlyRuns) {
  const TemporaryFolder folder;
  const Environment built{{"MAPPROOF", program().c_str()}};
  for (int run = 0; run < 2; ++run) {
    const Outcome outcome = run_program({(kSource / "scripts/nightly").string(), "--profile",
                                         "tiny", "--store", folder / "history", kSmall});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.error;
  }
  EXPECT_TRUE(fs::exists(folder / "history/index.html"));
  EXPECT_EQ(run_program({(kSource / "scripts/nightly").string(), "--stroe", "x"}).exit_code, 2);
}

}  // namespace
}  // namespace mapproof::test
