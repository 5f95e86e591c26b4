#include <algorithm>
#include <filesystem>

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

/// Expects one line that names the link.
void expect_named(const Outcome& outcome, const fs::path& link) {
  EXPECT_EQ(outcome.exit_code, 2) << link << ": " << outcome.out;
  EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
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
  fs::create_directory(study / "figures");
  const FolderLock lock(study / "figures");
  EXPECT_EQ(mapproof({"render", study, "--figure", "map-bearing-isomap"}).exit_code, 2);
  fs::remove(study / "figures");
  expect_same(contents(study), before);
}

}  // namespace
}  // namespace mapproof::test
