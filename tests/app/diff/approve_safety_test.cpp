#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/app/two_studies.hpp"
#include "tests/support/faults.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

/// Expects that approve refuses with exit code 2 and one line, and changes no file.
void expect_refused(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                    const std::string& words) {
  SCOPED_TRACE(words);
  const Contents before = contents(folder.path());
  std::vector<std::string> command = {"approve"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const Outcome outcome = mapproof(command);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  EXPECT_NE(outcome.error.find(words), std::string::npos) << outcome.error;
  EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  expect_same(before, contents(folder.path()));
}

TEST(ApproveCommand, RefusesFoldersOfWhichOneIsTheOtherOrLiesInIt) {
  const TwoStudies two;
  const std::string link = two.folder / "link", deep = two.before + "/figures/deep";
  fs::create_directory_symlink(two.before, link);
  fs::create_directory(deep);
  fs::copy_file(two.before + "/figures/map-usual.png", deep + "/map-usual.png");
  const std::string words = ": one is the other or lies in it";
  for (const std::string& baseline : {two.before, two.before + "/", link})
    for (const std::string& current :
         {two.before, two.before + "/figures", deep, link, link + "/figures",
          two.before + "/../before", two.folder.path().string()}) {
      expect_refused(two.folder, {baseline, current, "--all"}, words);
      expect_refused(two.folder, {baseline, current, "--all", "--force"}, words);
      expect_refused(two.folder, {baseline, current, "map-usual"}, words);
    }
  const std::string file = two.before + "/figures/map-usual.png";
  expect_refused(two.folder, {file, link + "/figures/map-usual.png"}, words);
}

TEST(ApproveCommand, RefusesACurrentThatHoldsNothing) {
  const TwoStudies two;
  const std::string empty = two.folder / "empty", strange = two.folder / "strange";
  fs::create_directory(empty);
  write_file(strange + "/notes.txt", "Not of mapproof.");
  for (const std::string& current : {empty, strange})
    expect_refused(two.folder, {two.before, current, "--all", "--force"},
                   "holds no records, figures, images or tables");
  const std::string file = two.folder.file("empty.pdf", "");
  expect_refused(two.folder, {two.folder.file("before.pdf", "%PDF"), file}, "is empty");
  expect_refused(two.folder, {two.before, two.folder / "nowhere", "--all"}, "does not exist");
}

TEST(ApproveCommand, RefusesACurrentOfAnotherKind) {
  const TwoStudies two;
  const fs::path ranges = two.folder / "ranges", images = two.folder / "images",
                 several = two.folder / "several", map = two.folder / "map";
  write_file(ranges / "study.json", R"({"schema": {"name": "mapproof.slam_study", "version": 1}})");
  fs::copy(two.after + "/figures", images);
  fs::create_directory(several);
  fs::copy(two.after, several / "one", fs::copy_options::recursive);
  write_file(map / "map.json", R"({"schema": {"name": "mapproof.map", "version": 1}})");
  const std::vector<std::string> kinds = {two.before, ranges, images, several, map};
  for (const std::string& baseline : kinds)
    for (const std::string& current : kinds)
      if (baseline != current) {
        SCOPED_TRACE(baseline + " " + current);
        expect_refused(two.folder, {baseline, current, "--all", "--force"}, ": not approved");
        expect_refused(two.folder, {baseline, current, "map-usual"}, ": not approved");
      }
  expect_refused(two.folder, {two.before, two.after + "/figures", "--all"},
                 "holds a study of the mapping methods, CURRENT " + two.after +
                     "/figures holds figures or images without records");
  expect_refused(two.folder,
                 {two.before + "/figures/map-usual.png", two.folder.file("map.svg", "<svg/>")},
                 "holds png, CURRENT");
}

TEST(ApproveCommand, RefusesACurrentThatCannotBeRead) {
  const TwoStudies two;
  const std::string study = two.after + "/study.json";
  for (const char* text : {"{", ""}) {
    write_file(study, text);
    expect_refused(two.folder, {two.before, two.after, "--all", "--force"}, study);
    expect_refused(two.folder, {two.before, two.after, "map-usual"}, study);
  }
  const std::string image = two.before + "/figures/map-usual.png";
  const std::string pipe = two.folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expect_refused(two.folder, {image, pipe}, "CURRENT " + pipe + " is not a file");
}

TEST(ApproveCommand, AsksBeforeMoreThanHalfOfABaselineGoes) {
  const TemporaryFolder folder;
  const std::string baseline = folder / "baseline", current = folder / "current";
  const std::string image = read_file(fs::path(kImages) / "map-usual.png");
  for (const char* name : {"a", "b", "c", "d", "e"})
    write_file(baseline + "/" + name + ".png", image);
  write_file(current + "/a.png", image);
  write_file(current + "/b.png", image);
  expect_refused(folder, {baseline, current, "--all"}, "--all would remove 3 of 5 files of ");
  write_file(current + "/c.png", image);
  EXPECT_EQ(mapproof({"approve", baseline, current, "--all"}).exit_code, 0);
  EXPECT_EQ(contents(baseline).size(), 3U);
  fs::remove(current + "/a.png");
  fs::remove(current + "/b.png");
  EXPECT_EQ(mapproof({"approve", baseline, current, "--all", "--force"}).exit_code, 0);
  EXPECT_EQ(contents(baseline).size(), 1U);
}

TEST(ApproveCommand, MakesABaselineThatIsNotThereAndNoneThatIsRefused) {
  const TwoStudies two;
  const std::string baseline = two.folder / "deep/new";
  expect_refused(two.folder, {baseline, two.after, "no-such-figure"}, "no-such-figure");
  EXPECT_FALSE(fs::exists(baseline));
  EXPECT_EQ(mapproof({"approve", baseline, two.after, "--all"}).exit_code, 0);
  expect_same(contents(two.after), contents(baseline));
}

TEST(ApproveCommand, KeepsModesLinksAndFilesOfOthers) {
  const TwoStudies two;
  two.change_image();
  const fs::path before = two.before, changed = before / "figures/map-usual.png";
  write_file(before / ".gitattributes", "*.png binary\n");
  write_file(before / "notes/README", "Not of mapproof.");
  fs::create_directory(before / "nothing");
  fs::create_symlink("nowhere", before / "link");
  fs::create_hard_link(changed, two.folder / "elsewhere.png");
  const std::string elsewhere = read_file(changed);
  ::chmod(before.c_str(), 0750);
  ::chmod((before / "figures").c_str(), 02775);
  ::chmod(changed.c_str(), 0664);
  ::chmod((before / "notes/README").c_str(), 0440);
  EXPECT_EQ(mapproof({"approve", two.before, two.after, "--all"}).exit_code, 0);
  EXPECT_EQ(read_file(changed), read_file(two.after + "/figures/map-usual.png"));
  EXPECT_EQ(read_file(two.folder / "elsewhere.png"), elsewhere) << "written behind a hard link";
  EXPECT_EQ(read_file(before / ".gitattributes"), "*.png binary\n");
  EXPECT_TRUE(fs::is_directory(before / "nothing"));
  EXPECT_EQ(fs::read_symlink(before / "link"), "nowhere");
  const auto mode = [](const fs::path& path) {
    struct stat facts {};
    ::stat(path.c_str(), &facts);
    return facts.st_mode & 07777U;
  };
  EXPECT_EQ(mode(before), 0750U);
  EXPECT_EQ(mode(before / "figures"), 02775U);
  EXPECT_EQ(mode(changed), 0664U);
  EXPECT_EQ(mode(before / "notes/README"), 0440U);
  for (const auto& entry : fs::recursive_directory_iterator(before))
    if (entry.is_regular_file()) {
      EXPECT_EQ(entry.hard_link_count(), 1U) << entry.path() << " is a file of something else, too";
    }
}

TEST(ApproveCommand, ReplacesABaselineBehindALinkAndWritesBehindNoneWithinIt) {
  const TwoStudies two;
  two.change_image();
  const std::string link = two.folder / "link";
  fs::create_directory_symlink("before", link);
  EXPECT_EQ(mapproof({"approve", link, two.after, "--all"}).exit_code, 0);
  EXPECT_TRUE(fs::is_symlink(link));
  expect_same(contents(two.after), contents(two.before));

  const fs::path figures = two.before + "/figures", away = two.folder / "away";
  fs::rename(figures, away);
  fs::create_directory_symlink(away, figures);
  fs::copy_file(fs::path(kImages) / "map-usual.png", two.after + "/figures/map-usual.png",
                fs::copy_options::overwrite_existing);
  expect_refused(two.folder, {two.before, two.after, "map-usual"},
                 "figures: is a link that leads out of the folder");
  fs::rename(away, two.before + "/away");
  fs::remove(figures);
  fs::create_directory_symlink("away", figures);
  expect_refused(two.folder, {two.before, two.after, "map-usual"},
                 "figures: is not a folder of its own");
}

TEST(ApproveCommand, RefusesABaselineThatMayNotBeChangedOrIsWorkedIn) {
  const TwoStudies two;
  two.change_image();
  const std::string script = "cd \"$1\" && exec \"$0\" approve . \"$2\" --all";
  const Outcome inside =
      run_program({"sh", "-c", script, program(), two.before + "/figures/..", two.after});
  EXPECT_EQ(inside.exit_code, 2);
  EXPECT_NE(inside.error.find("run this from a folder outside"), std::string::npos) << inside.error;
  if (::geteuid() == 0) GTEST_SKIP() << "nothing is forbidden to root";
  ::chmod((two.before + "/figures").c_str(), 0555);
  expect_refused(two.folder, {two.before, two.after, "--all"}, "figures: may not be changed");
  ::chmod((two.before + "/figures").c_str(), 0755);
}

/// A baseline with images and a file that is not of mapproof, and a current with other images.
struct Sides {
  TemporaryFolder folder;
  std::string baseline = folder / "baseline", current = folder / "current";
  Contents old_files, new_files;

  Sides() {
    const fs::path images = kImages;
    make(baseline, read_file(images / "map-usual.png"), {"a", "b", "c", "gone"});
    make(current, read_file(images / "curve-usual.png"), {"a", "b", "c", "more"});
    write_file(fs::path(baseline) / "notes/README", "Not of mapproof.");
    old_files = contents(baseline);
    new_files = contents(current);
    new_files.emplace_back("notes/README", "Not of mapproof.");
  }
  static void make(const fs::path& location, const std::string& image,
                   const std::vector<std::string>& names) {
    for (const std::string& name : names) write_file(location / (name + ".png"), image);
  }
  void put_back() const {
    fs::remove_all(baseline);
    for (const auto& [name, bytes] : old_files) write_file(fs::path(baseline) / name, bytes);
  }
  /// The number of files and folders beside the two sides.
  long others() const {
    return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) - 2;
  }
  Outcome approve() const { return mapproof({"approve", baseline, current, "--all"}); }
};

/// Kills approve at every call that changes a file system, one call per run.
/// @param more  Further faults.
/// @return The number of runs after which the baseline was missing.
int kill_at_every_step(const Sides& sides, const std::string& more) {
  long steps = 0;
  {
    const Faults none(more.empty() ? more : more.substr(1));
    EXPECT_EQ(sides.approve().exit_code, 0);
    steps = none.calls("disk");
  }
  EXPECT_GT(steps, 10);
  expect_same(sides.new_files, contents(sides.baseline));
  int old = 0, taken = 0, gone = 0;
  for (long step = 1; step <= steps; ++step) {
    SCOPED_TRACE(step);
    sides.put_back();
    {
      const Faults kill(at_call("disk", step, "kill") + more);
      EXPECT_EQ(sides.approve().exit_code, -1);
    }
    if (fs::exists(sides.baseline)) {
      const Contents files = contents(sides.baseline);
      old += files == sides.old_files ? 1 : 0;
      taken += files == sides.new_files ? 1 : 0;
      EXPECT_TRUE(files == sides.old_files || files == sides.new_files) << "neither old nor new";
    } else {
      ++gone;
    }
    EXPECT_EQ(sides.approve().exit_code, 0);
    expect_same(sides.new_files, contents(sides.baseline));
    EXPECT_EQ(sides.others(), 0) << "something is left beside the baseline";
  }
  EXPECT_GT(old, 0);
  EXPECT_GT(taken, 0);
  return gone;
}

TEST(ApproveCommand, KilledAtAnyStepLeavesTheOldBaselineOrTheNewOneWhole) {
  const Sides sides;
  EXPECT_EQ(kill_at_every_step(sides, ""), 0);
}

TEST(ApproveCommand, WithoutAnExchangeOfFoldersTheNextRunTakesTheBaselineBack) {
  const Sides sides;
  EXPECT_GT(kill_at_every_step(sides, ",exchange:1-:fail"), 0);
}

TEST(ApproveCommand, ThatFailsAtAnyStepLeavesTheOldBaselineOrTheNewOneWhole) {
  const Sides sides;
  for (long step = 1, steps = 2; step <= steps; ++step) {
    SCOPED_TRACE(step);
    sides.put_back();
    const Faults fail(at_call("disk", step));
    const Outcome outcome = sides.approve();
    steps = std::max(steps, fail.calls("disk"));
    const Contents files = contents(sides.baseline);
    EXPECT_TRUE(files == (outcome.exit_code == 0 ? sides.new_files : sides.old_files));
    if (outcome.exit_code != 0) {
      EXPECT_EQ(outcome.exit_code, 2);
      EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
    }
  }
}

TEST(ApproveCommand, ThatCannotRemoveWhatTheBaselineHeldSaysSoAndTheNextOneDoes) {
  const Sides sides;
  long steps = 0;
  {
    const Faults none("");
    EXPECT_EQ(sides.approve().exit_code, 0);
    steps = none.calls("disk");
  }
  // The last changes remove the old folder, which is tried twice.
  Outcome outcome;
  for (bool fails = false; !fails && steps > 0; --steps) {
    sides.put_back();
    const Faults fail("disk:" + std::to_string(steps) + "-:fail");
    outcome = sides.approve();
    fails = outcome.exit_code != 0;
  }
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  EXPECT_TRUE(outcome.error.starts_with("mapproof: " + sides.baseline + ": is replaced, but "))
      << outcome.error;
  expect_same(sides.new_files, contents(sides.baseline));
  EXPECT_EQ(sides.others(), 1);
  EXPECT_EQ(sides.approve().exit_code, 0);
  EXPECT_EQ(sides.others(), 0);
}

TEST(ApproveCommand, WithoutHardLinksCopiesFilesWholeOrLeavesTheOldBaseline) {
  const Sides sides;
  write_file(fs::path(sides.baseline) / "notes/large", std::string(400'000, 'x'));
  const Contents before = contents(sides.baseline);
  const Faults no_links("link:1-:fail");
  const Outcome full =
      mapproof({"approve", sides.baseline, sides.current, "--all"}, {.file_bytes = 200'000});
  EXPECT_EQ(full.exit_code, 2) << full.error;
  EXPECT_EQ(std::ranges::count(full.error, '\n'), 1) << full.error;
  expect_same(before, contents(sides.baseline));
  EXPECT_EQ(sides.approve().exit_code, 0);
  EXPECT_EQ(read_file(fs::path(sides.baseline) / "notes/large"), std::string(400'000, 'x'));
}

TEST(ApproveCommand, TakesBackABaselineThatWasLeftUnderAnotherName) {
  const Sides sides;
  fs::rename(sides.baseline, sides.folder / ".baseline.mapproof-old");
  const std::string notes = sides.folder / ".baseline.mapproof-notes";
  write_file(notes + "/mine", "Not of mapproof.");
  EXPECT_EQ(mapproof({"approve", sides.baseline, sides.current, "a"}).exit_code, 0);
  EXPECT_EQ(contents(sides.baseline).size(), sides.old_files.size());
  EXPECT_TRUE(fs::exists(notes + "/mine"));
}

}  // namespace
}  // namespace mapproof::test
