#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "tests/app/two_studies.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

const std::string kSmallOrder =
    std::string(MAPPROOF_SOURCE_DIR) + "/tests/data/experiments/small.json";
const std::string kBearings = std::string(MAPPROOF_SOURCE_DIR) + "/examples/hall/bearings.csv";

/// A file and a folder that nothing which was handed over may reach.
class Trap {
 public:
  explicit Trap(const TemporaryFolder& folder) : outside_(folder / "outside") {
    write_file(outside_ / "mine.txt", "mine");
    write_file(outside_ / "layout-1-pose-1.json", "mine");
    before_ = contents(outside_);
  }

  /// Puts a link in place of the path, to the file or the folder outside.
  void put_at(const fs::path& path, bool is_folder) const {
    fs::remove_all(path);
    fs::create_directories(path.parent_path());
    if (is_folder)
      fs::create_directory_symlink(outside_, path);
    else
      fs::create_symlink(outside_ / "mine.txt", path);
  }

  void expect_untouched() const { expect_same(contents(outside_), before_); }

 private:
  fs::path outside_;
  Contents before_;
};

/// Expects one line that names the link; on a slow machine the progress of drawing stands before
/// it.
void expect_named(const Outcome& outcome, const fs::path& link) {
  EXPECT_EQ(outcome.exit_code, 2) << link << ": " << outcome.out;
  const auto lines = std::ranges::count(outcome.error, '\n');
  EXPECT_EQ(lines, outcome.error.starts_with("drawing ") ? 2 : 1) << outcome.error;
  EXPECT_NE(outcome.error.find(link.filename().string()), std::string::npos) << outcome.error;
  EXPECT_NE(outcome.error.find(" link"), std::string::npos) << outcome.error;
}

struct Place {
  const char* path;
  bool is_folder;
};

TEST(HandedOverStudy, LeadsNoReportOutOfItsFolder) {
  for (const Place& place :
       {Place{"report.html", false}, Place{"figures", true}, Place{"tables", true},
        Place{"runs", true}, Place{"maps", true}, Place{"timings.jsonl", false},
        Place{"study.json", false}, Place{"runs/layout-1-pose-1.json", false}}) {
    const TemporaryFolder folder;
    const Trap trap(folder);
    const fs::path study = folder / "study";
    fs::copy(kStudy, study, fs::copy_options::recursive);
    trap.put_at(study / place.path, place.is_folder);
    for (const std::vector<std::string>& command : {std::vector<std::string>{"report", study},
                                                    {"render", study, "--figure", "none"},
                                                    {"diff", kStudy, study}})
      expect_named(mapproof(command), place.path);
    EXPECT_NE(mapproof({"validate", study}).exit_code, 0);
    EXPECT_NE(mapproof({"approve", folder / "new", study, "--all"}).exit_code, 0);
    EXPECT_FALSE(fs::exists(folder / "new"));
    trap.expect_untouched();
  }
}

TEST(HandedOverStudy, LeadsNoReportToWhereNothingIsOutOfItsFolder) {
  const TemporaryFolder folder;
  const Trap trap(folder);
  const fs::path study = folder / "study";
  fs::copy(kStudy, study, fs::copy_options::recursive);
  fs::create_directories(study / "figures");
  fs::create_symlink("../../outside/new.svg", study / "figures/fig-new.svg");
  for (const std::vector<std::string>& command : {std::vector<std::string>{"report", study},
                                                  {"render", study, "--figure", "none"},
                                                  {"diff", kStudy, study}})
    expect_named(mapproof(command), "fig-new.svg");
  const Outcome checked = mapproof({"validate", study});
  EXPECT_NE(checked.exit_code, 0);
  EXPECT_NE((checked.out + checked.error).find("fig-new.svg: is a link that leads out"),
            std::string::npos)
      << checked.out << checked.error;
  trap.expect_untouched();
}

TEST(HandedOverStudy, LeadsNoReportToAnotherOfItsFiles) {
  const TemporaryFolder folder;
  const fs::path study = folder / "study";
  fs::copy(kStudy, study, fs::copy_options::recursive);
  write_file(study / "notes.txt", "mine");
  fs::create_symlink("notes.txt", study / "report.html");
  expect_named(mapproof({"report", study}), "report.html");
  EXPECT_EQ(read_file(study / "notes.txt"), "mine");
}

TEST(HandedOverStudy, LeadsNoRunOutOfItsFolder) {
  const std::vector<std::string> run = {"run",    kSmallOrder, "--profile", "tiny",
                                        "--jobs", "1",         "--out"};
  for (const Place& place : {Place{"runs", true}, Place{"maps", true}, Place{"details", true},
                             Place{"timings.jsonl", false}, Place{"results.csv", false}}) {
    const TemporaryFolder folder;
    const Trap trap(folder);
    const fs::path study = folder / "study";
    std::vector<std::string> command = run;
    command.push_back(study);
    ASSERT_EQ(mapproof(command).exit_code, 0);
    trap.put_at(study / place.path, place.is_folder);
    expect_named(mapproof(command), place.path);
    trap.expect_untouched();
  }
}

TEST(HandedOverMap, LeadsNoOtherMapOutOfItsFolder) {
  for (const Place& place :
       {Place{"map.json", false}, Place{"map.csv", false}, Place{"figures", true},
        Place{"tables", true}, Place{"report.html", false}}) {
    const TemporaryFolder folder;
    const Trap trap(folder);
    const fs::path out = folder / "map";
    write_file(out / "map.json", "{}");
    trap.put_at(out / place.path, place.is_folder);
    expect_named(
        mapproof({"map", kBearings, "--sensor", "bearing", "--method", "lpca", "--out", out}),
        place.path);
    trap.expect_untouched();
  }
}

TEST(HandedOverStore, LeadsNoNightlyRunOutOfItsFolder) {
  for (const Place& place :
       {Place{"history.sqlite", false}, Place{"objects", true}, Place{"nightly_runs", true},
        Place{"trends", true}, Place{"index.html", false}}) {
    const TemporaryFolder folder;
    const Trap trap(folder);
    const fs::path store = folder / "store";
    trap.put_at(store / place.path, place.is_folder);
    expect_named(
        mapproof({"nightly", kSmallOrder, "--profile", "tiny", "--jobs", "1", "--store", store}),
        place.path);
    trap.expect_untouched();
  }
}

TEST(HandedOverResults, AreReadFromTheirFolderAlone) {
  for (const char* file : {"results.csv", "study.json", "paths"}) {
    const TemporaryFolder folder;
    const Trap trap(folder);
    const fs::path study = folder / "mine";
    write_file(study / "study.json",
               R"({"schema": {"name": "mapproof.results_study", "version": 1}, "title": "t"})");
    write_file(study / "results.csv", "setup,method,quantity,value\na,b,mpe_m,0.5\n");
    trap.put_at(study / file, std::string(file) == "paths");
    expect_named(mapproof({"report", study}), file);
    expect_named(mapproof({"nightly", study, "--store", folder / "store"}), file);
    trap.expect_untouched();
  }
}

/// A map with its figures.
fs::path map_in(const TemporaryFolder& folder) {
  const fs::path map = folder / "map";
  EXPECT_EQ(mapproof({"map", kBearings, "--sensor", "bearing", "--method", "lpca", "--out", map})
                .exit_code,
            0);
  return map;
}

TEST(HandedOverMap, LeadsNoFigureOutOfItsFolder) {
  const TemporaryFolder folder;
  const fs::path map = map_in(folder), all = folder / "all";
  fs::create_directory(all);
  fs::copy(map / "figures/map.figure.json", all);
  fs::copy(map / "report.html", all / "page.html");
  const std::string file = all / "map.figure.json", page = all / "page.html";
  struct Case {
    fs::path link;
    std::vector<std::string> command;
  };
  for (const auto& [link, command] :
       {Case{map / "figures", {"render", map, "--as", "svg"}},
        Case{map / "figures-paper", {"render", map, "--theme", "paper", "--as", "svg"}},
        Case{map / "figures-styled", {"render", map, "--theme", "dark", "--as", "svg"}},
        Case{all / "figures-styled", {"render", file, "--theme", "dark", "--as", "svg"}},
        Case{all / "figures-styled", {"render", page, "--theme", "dark", "--as", "svg"}}}) {
    const Trap trap(folder);
    trap.put_at(link, true);
    expect_named(mapproof(command), link);
    trap.expect_untouched();
    fs::remove(link);
  }
}

TEST(HandedOverMap, IsDrawnFromItsFolderAlone) {
  const TemporaryFolder folder;
  const fs::path map = map_in(folder);
  for (const char* file : {"map.json", "figures", "figures/map.figure.json"}) {
    const fs::path moved = folder / "moved";
    fs::rename(map / file, moved);
    fs::create_symlink(moved, map / file);
    expect_named(mapproof({"render", map, "--out", folder / "out"}), file);
    expect_named(mapproof({"render", "--panel", map, map, "--out", folder / "out"}), file);
    EXPECT_FALSE(fs::exists(folder / "out"));
    fs::remove(map / file);
    fs::rename(moved, map / file);
  }
}

TEST(HandedOverStudy, IsReadFromItsFolderAlone) {
  for (const char* file :
       {"study.json", "results.csv", "runs/layout-1-pose-1.json", "maps/layout-1-pose-1.json"}) {
    const TemporaryFolder folder;
    const fs::path study = folder / "study", moved = folder / "moved";
    fs::copy(kStudy, study, fs::copy_options::recursive);
    fs::rename(study / file, moved);
    fs::create_symlink(moved, study / file);
    expect_named(mapproof({"results", study}), file);
    expect_named(mapproof({"export", study, "--out", folder / "out"}), file);
    expect_named(mapproof({"import", study, folder / "none", "--out", folder / "out"}), file);
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
}

TEST(HandedOverFolder, IsNotCalledEmptyWhereTheSystemRefusesToRead) {
  const TemporaryFolder folder;
  const std::string input = folder / "in", out = folder / "out";
  struct Case {
    const char* file;
    std::vector<std::string> command;
  };
  for (const auto& [file, command] :
       {Case{"study.json", {"render", input, "--list"}}, Case{"study.json", {"results", input}},
        Case{"study.json", {"merge", "--check", input}},
        Case{"study.json", {"export", input, "--out", out}},
        Case{"history.sqlite", {"history", input}},
        Case{"ranges.csv", {"slam", input, "--out", out}}}) {
    fs::remove_all(input);
    fs::create_directory(input);
    fs::create_symlink(file, fs::path(input) / file);  // A loop, which root cannot read, either.
    const Outcome outcome = mapproof(command);
    EXPECT_EQ(outcome.exit_code, 2) << command.front() << outcome.out;
    EXPECT_NE(outcome.error.find(file + std::string(": cannot be read: Too many levels")),
              std::string::npos)
        << command.front() << ": " << outcome.error;
    EXPECT_FALSE(fs::exists(out));
  }
}

TEST(ExampleCommand, WritesThroughNoLinkBelowItsFolder) {
  const TemporaryFolder folder;
  const Trap trap(folder);
  trap.put_at(folder / "out/drive", true);
  expect_named(mapproof({"example", "drive", "--out", folder / "out"}), "drive");
  trap.expect_untouched();
}

TEST(CommandsThatWrite, HoldTheLockOfTheFolderThatEachOfThemWrites) {
  const TemporaryFolder folder;
  const fs::path map = map_in(folder), images = folder / "images", example = folder / "example";
  const TwoStudies two;
  two.change_image();
  fs::create_directory(images);
  fs::create_directory(example);
  for (const auto& [locked, command] :
       {std::pair(map, std::vector<std::string>{"render", map, "--as", "svg"}),
        {map,
         {"map", kBearings, "--sensor", "bearing", "--method", "lpca", "--force", "--out", map}},
        {images, {"diff", two.before, two.after, "--images", images}},
        {example, {"example", "drive", "--out", example}}}) {
    const FolderLock lock(locked);
    const Outcome outcome = mapproof(command);
    EXPECT_EQ(outcome.exit_code, 2) << command.front();
    EXPECT_NE(outcome.error.find("is in use by another mapproof"), std::string::npos)
        << outcome.error;
  }
}

TEST(DiffCommand, WritesTheSameImagesAfterItWasStoppedAtAnyMoment) {
  const TwoStudies two;
  two.change_image();
  const std::string whole = two.folder / "whole", images = two.folder / "images";
  ASSERT_EQ(mapproof({"diff", two.before, two.after, "--images", whole}).exit_code, 1);
  const Contents expected = contents(whole);
  ASSERT_GT(expected.size(), 2U);
  // As a kill leaves it: the list, some of the images, a part of one.
  for (std::size_t left = 0; left <= expected.size(); ++left) {
    fs::remove_all(images);
    ASSERT_EQ(mapproof({"diff", two.before, two.after, "--images", images}).exit_code, 1);
    for (std::size_t i = left; i < expected.size(); ++i)
      if (expected[i].first != "mapproof-images.txt") fs::remove(images + "/" + expected[i].first);
    write_file(images + "/map-usual.png/current.png.part-999999999-0123456789abcdef", "half");
    EXPECT_EQ(mapproof({"diff", two.before, two.after, "--images", images}).exit_code, 1);
    expect_same(contents(images), expected);
  }
  for (const int milliseconds : {1, 10, 30, 60, 100, 200}) {
    fs::remove_all(images);
    const pid_t child = start_mapproof({"diff", two.before, two.after, "--images", images});
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_EQ(mapproof({"diff", two.before, two.after, "--images", images}).exit_code, 1);
    expect_same(contents(images), expected);
  }
}

TEST(ApproveCommand, TakesRegularFilesAlone) {
  const TwoStudies two;
  two.change_image();
  const fs::path image = two.after + "/figures/map-usual.png";
  fs::rename(image, two.after + "/figures/other.png");
  fs::create_symlink("other.png", image);
  const Contents before = contents(two.before);
  const Outcome outcome = mapproof({"approve", two.before, two.after, "map-usual"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  EXPECT_NE(outcome.error.find("map-usual.png: is a symbolic link"), std::string::npos)
      << outcome.error;
  expect_same(contents(two.before), before);
}

TEST(ReportCommand, WaitsForNobodyWhoWritesInTheFolder) {
  const TemporaryFolder folder;
  const fs::path study = folder / "study";
  fs::copy(kStudy, study, fs::copy_options::recursive);
  const Contents before = contents(study);
  {
    const FolderLock lock(study);
    const Outcome outcome = mapproof({"report", study});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.error.find("is in use by another mapproof"), std::string::npos);
  }
  expect_same(contents(study), before);
}

}  // namespace
}  // namespace mapproof::test
