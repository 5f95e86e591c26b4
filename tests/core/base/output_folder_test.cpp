#include "core/base/files/output_folder.hpp"

#include <sys/stat.h>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;
using test::error_of;

/// A folder that was handed over, and files outside of it that it must not reach.
struct HandedOver {
  test::TemporaryFolder folder;
  fs::path inside = folder / "inside", outside = folder / "outside";
  fs::path mine = folder.file("outside/mine.txt", "mine");

  HandedOver() { fs::create_directory(inside); }
  void expect_untouched() const {
    EXPECT_EQ(read_file(mine), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(outside), {}), 1);
  }
};

TEST(OutputFolder, WritesFollowNoLinkBelowTheNamedFolder) {
  const HandedOver handed;
  const OutputFolder folder(handed.inside);
  fs::create_symlink(handed.mine, handed.inside / "report.html");
  fs::create_directory_symlink(handed.outside, handed.inside / "figures");
  fs::create_symlink("../outside/new.txt", handed.inside / "new.txt");
  const std::string refused = "is a symbolic link, and nothing is written through it";
  for (const char* file : {"report.html", "figures/mine.txt", "figures/new.txt", "new.txt"}) {
    EXPECT_NE(error_of([&] { folder.write(file, "x"); }).find(refused), std::string::npos) << file;
    EXPECT_NE(error_of([&] { folder.append(file, "x"); }).find(refused), std::string::npos) << file;
    EXPECT_THROW(folder.write_durably(file, "x"), IoError);
  }
  EXPECT_THROW((folder / "figures").write("mine.txt", "x"), IoError);
  EXPECT_THROW(folder.remove("figures/mine.txt"), IoError);
  handed.expect_untouched();
}

TEST(OutputFolder, AppendsToNoFileThatHasANameElsewhere) {
  const HandedOver handed;
  fs::create_hard_link(handed.mine, handed.inside / "timings.jsonl");
  const OutputFolder folder(handed.inside);
  folder.append("timings.jsonl", " and more");
  EXPECT_EQ(read_file(handed.inside / "timings.jsonl"), "mine and more");
  folder.append("timings.jsonl", ".");
  EXPECT_EQ(folder.read("timings.jsonl"), "mine and more.");
  EXPECT_EQ(folder.read("never/there"), std::nullopt);
  handed.expect_untouched();
}

TEST(OutputFolder, RemovesALinkAndNotWhatItLeadsTo) {
  const HandedOver handed;
  fs::create_directory_symlink(handed.outside, handed.inside / "runs");
  const OutputFolder folder(handed.inside);
  folder.remove("runs");
  EXPECT_FALSE(fs::exists(fs::symlink_status(handed.inside / "runs")));
  handed.expect_untouched();
  folder.write("a/b/c.txt", "c");
  folder.remove("a");
  folder.remove("never/there");
  EXPECT_TRUE(fs::is_empty(handed.inside));
}

TEST(OutputFolder, FollowsLinksInThePathThatSomebodyNamed) {
  const HandedOver handed;
  const fs::path link = handed.folder / "link";
  fs::create_directory_symlink(handed.inside, link);
  OutputFolder(link).write("figures/a.svg", "a");
  EXPECT_EQ(read_file(handed.inside / "figures/a.svg"), "a");
  EXPECT_TRUE(fs::is_symlink(link));
}

TEST(OutputFolder, RefusesPathsThatLeaveIt) {
  const HandedOver handed;
  const OutputFolder folder(handed.inside);
  for (const char* file : {"../outside/mine.txt", "/etc/hostname", "a/../../outside/mine.txt"})
    EXPECT_THROW(folder.write(file, "x"), InvalidInput) << file;
  EXPECT_THROW((folder / "..").write("mine.txt", "x"), InvalidInput);
  handed.expect_untouched();
}

TEST(OutputFolder, NobodyCanForeseeTheNameOfAFileThatIsBeingWritten) {
  EXPECT_NE(part_name("a"), part_name("a"));
  EXPECT_TRUE(part_name("a").starts_with("a.part-"));
  EXPECT_LE(part_name(std::string(250, 'n')).size(), 255U);
}

TEST(OutputFolder, ReplacesAFileWholeAndLeavesNothingBehind) {
  const test::TemporaryFolder folder;
  const OutputFolder outputs(folder.path());
  for (const char* text : {"first", "second"}) {
    outputs.write("a.txt", text);
    outputs.write_durably("b/b.txt", text);
  }
  EXPECT_EQ(read_file(folder / "a.txt"), "second");
  EXPECT_EQ(read_file(folder / "b/b.txt"), "second");
  outputs.append("a.txt", " third");
  EXPECT_EQ(read_file(folder / "a.txt"), "second third");
  EXPECT_THROW(outputs.write("b", "x"), IoError);
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(outputs.write("pipe", "x"), IoError);
  EXPECT_THROW(outputs.append("pipe", "x"), IoError);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 3);
}

TEST(LinksOut, AreThoseThatLeadOutsideWhetherOrNotSomethingIsThere) {
  const HandedOver handed;
  refuse_links_out(handed.inside);
  refuse_links_out(handed.folder / "not-there");
  write_file(handed.inside / "maps/a.json", "a");
  fs::create_symlink("maps/a.json", handed.inside / "b.json");
  fs::create_symlink("nowhere", handed.inside / "dangling");
  fs::create_symlink("loop", handed.inside / "loop");
  fs::create_symlink("/dev/zero", handed.inside / "device");
  refuse_links_out(handed.inside);
  fs::create_directory(handed.inside / "deep");
  for (const fs::path& target :
       {handed.mine, handed.outside, fs::path("/etc"), handed.folder / "outside/new.txt",
        handed.folder / "nowhere/new.txt", fs::path("../../outside/new.txt")}) {
    const fs::path link = handed.inside / "deep/link";
    fs::create_symlink(target, link);
    EXPECT_EQ(
        error_of([&] { refuse_links_out(handed.inside); }),
        link.string() + ": is a link that leads out of the folder; put the file itself there");
    fs::remove(link);
  }
}

}  // namespace
}  // namespace mapproof
