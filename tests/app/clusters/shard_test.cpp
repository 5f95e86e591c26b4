// Studies divided into shards and merged: the bytes of one run, whatever happened to the shards.
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <random>
#include <regex>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/study/study_run.hpp"
#include "core/base/files/files.hpp"
#include "core/base/sha256.hpp"
#include "core/studies/shard.hpp"
#include "tests/support/faults.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kSource = MAPPROOF_SOURCE_DIR;
const std::string kSmall = kSource / "tests/data/experiments/small.json";

/// What must be that of one run.
Contents lasting(const fs::path& folder) {
  Contents files = contents(folder);
  std::erase_if(files, [](const auto& file) { return file.first == "timings.jsonl"; });
  return files;
}

void expect_lasting_same(const fs::path& a, const fs::path& b) {
  expect_same(lasting(a), lasting(b));
}

using Words = std::vector<std::string>;

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Words shard_words(const Words& experiment, const Shard& shard, const fs::path& out) {
  return Words{"run"} + experiment + Words{"--shard", text_of(shard), "--out", out};
}

/// Runs all shards of an experiment into FOLDER/I, and gives these folders.
Words run_shards(const Words& experiment, int count, const fs::path& folder) {
  Words folders;
  for (int i = 1; i <= count; ++i) {
    folders.push_back(folder / std::to_string(i));
    const Outcome outcome =
        mapproof(shard_words(experiment, {.index = i, .count = count}, folders.back()));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_NE(outcome.error.find("the numbers cover these alone"), std::string::npos)
        << outcome.error;
  }
  return folders;
}

Outcome merge(const Words& folders, const fs::path& out) {
  return mapproof(Words{"merge"} + folders + Words{"--out", out});
}

/// Replaces what a regular expression matches.
void replace_in(const fs::path& file, const std::string& what, const std::string& by) {
  const std::string text = read_file(file);
  const std::string changed = std::regex_replace(text, std::regex(what), by);
  ASSERT_NE(text, changed) << file << " has no " << what;
  write_file(file, changed);
}

/// How many lines a text has, and that each of them has what it should.
void expect_lines(const std::string& text, const Words& parts) {
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(text, '\n')), parts.size()) << text;
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << text;
}

/// A random set of shards that holds every task once, or with `again` some of them twice.
std::vector<Shard> random_split(std::mt19937& random, bool again) {
  const int first = 1 + static_cast<int>(random() % 3);
  std::vector<Shard> shards;
  for (int i = 1; i <= first; ++i) shards.push_back({.index = i, .count = first});
  for (int split = static_cast<int>(random() % 3); split > 0; --split) {
    const std::size_t at = random() % shards.size();
    const Shard whole = shards[at];
    if (!again) shards.erase(shards.begin() + static_cast<std::ptrdiff_t>(at));
    shards.push_back({.index = whole.index, .count = 2 * whole.count});
    shards.push_back({.index = whole.index + whole.count, .count = 2 * whole.count});
  }
  std::ranges::shuffle(shards, random);
  return shards;
}

TEST(Shards, OfAnySplitRunInAnyOrderGiveTheBytesOfOneRun) {
  const TemporaryFolder folder;
  ASSERT_EQ(mapproof({"run", kSmall, "--out", folder / "whole"}).exit_code, 0);
  ASSERT_GT(lasting(folder / "whole").size(), 10U);
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const std::string base = folder / std::to_string(seed);
    Words folders;
    for (const Shard& shard : random_split(random, seed % 2 == 0)) {
      folders.push_back(base + "/shards/" + std::to_string(folders.size()));
      const Words jobs = {"--jobs", std::to_string(1 + random() % 2)};
      ASSERT_EQ(mapproof(shard_words({kSmall}, shard, folders.back()) + jobs).exit_code, 0);
    }
    std::ranges::shuffle(folders, random);
    const Outcome outcome = merge(folders, base + "/study");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
    expect_lasting_same(folder / "whole", base + "/study");
  }
}

/// Experiments of every kind that can be run here.
std::vector<Words> experiments_of_every_kind() {
  return {{kSmall},
          {kSource / "tests/data/experiments/small_sweep.json"},
          {"boots2013", "--profile", "quick"}};
}

TEST(Shards, OfEveryKindOfStudyGiveTheBytesOfOneRun) {
  for (const Words& experiment : experiments_of_every_kind()) {
    SCOPED_TRACE(experiment.front());
    const TemporaryFolder folder;
    const Outcome whole = mapproof(Words{"run"} + experiment + Words{"--out", folder / "whole"});
    ASSERT_EQ(whole.exit_code, 0) << whole.error;
    const Words folders = run_shards(experiment, 3, folder / "shards");
    const Outcome outcome = merge(folders, folder / "study");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
    expect_lasting_same(folder / "whole", folder / "study");
    EXPECT_EQ(mapproof({"validate", folder / "study"}).exit_code, 0);
    EXPECT_EQ(mapproof({"validate", folders.front()}).exit_code, 0);
  }
}

TEST(Shards, MoreThanThereAreTasksAreMergedToo) {
  const TemporaryFolder folder;
  const Words experiment = {kSmall, "--layouts", "1", "--poses", "2"};
  ASSERT_EQ(mapproof(Words{"run"} + experiment + Words{"--out", folder / "whole"}).exit_code, 0);
  ASSERT_EQ(merge(run_shards(experiment, 3, folder / "shards"), folder / "study").exit_code, 0);
  expect_lasting_same(folder / "whole", folder / "study");
}

TEST(Shards, KilledAtRandomMomentsContinueAndGiveTheBytesOfOneRun) {
  const TemporaryFolder folder;
  const Words experiment = {kSmall, "--layouts", "40", "--jobs", "2"};
  ASSERT_EQ(mapproof(Words{"run"} + experiment + Words{"--out", folder / "whole"}).exit_code, 0);
  std::mt19937 random(25);
  int killed = 0;
  Words folders;
  for (int i = 1; i <= 2; ++i) {
    folders.push_back(folder / std::to_string(i));
    const Words words = shard_words(experiment, {.index = i, .count = 2}, folders.back());
    for (int attempt = 0; attempt < 5; ++attempt) {
      const pid_t child = start_mapproof(words);
      std::this_thread::sleep_for(std::chrono::milliseconds(40 + random() % 400));
      ::kill(child, SIGKILL);
      int status = 0;
      ::waitpid(child, &status, 0);
      if (WIFSIGNALED(status)) ++killed;
    }
    // Half done, it is never taken for whole.
    if (i == 1 && mapproof({"merge", folders.back(), "--check"}).exit_code == 0) ADD_FAILURE();
    ASSERT_EQ(mapproof(words).exit_code, 0);
  }
  EXPECT_GE(killed, 3);  // Else the machine was too fast for the test to mean anything.
  ASSERT_EQ(merge(folders, folder / "study").exit_code, 0);
  expect_lasting_same(folder / "whole", folder / "study");
}

TEST(Shards, AMergeThatWasKilledAtAnyMomentIsContinued) {
  const TemporaryFolder folder;
  ASSERT_EQ(mapproof({"run", kSmall, "--out", folder / "whole"}).exit_code, 0);
  const Words folders = run_shards({kSmall}, 2, folder / "shards");
  for (const long call : {1, 3, 6, 9, 12, 15}) {
    const Faults faults(at_call("rename", call, "kill"));
    merge(folders, folder / "study");
  }
  const Outcome outcome = merge(folders, folder / "study");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  expect_lasting_same(folder / "whole", folder / "study");
  // Merged twice, no line of the timings is there twice.
  const std::string once = read_file(folder / "study/timings.jsonl");
  ASSERT_EQ(merge(folders, folder / "study").exit_code, 0);
  EXPECT_EQ(std::ranges::count(read_file(folder / "study/timings.jsonl"), '\n'),
            std::ranges::count(once, '\n'));
}

/// Two processes on one shard at the same time. @return How many end well.
int run_twice_at_once(const Words& words) {
  const pid_t first = start_mapproof(words);
  const pid_t second = start_mapproof(words);
  int well = 0;
  for (const pid_t child : {first, second}) {
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) ++well;
  }
  return well;
}

TEST(Shards, StartedTwiceAtOnceDoNoHarm) {
  const TemporaryFolder folder;
  const Words experiment = {kSmall, "--layouts", "10"};
  ASSERT_EQ(mapproof(Words{"run"} + experiment + Words{"--out", folder / "whole"}).exit_code, 0);
  for (int i = 1; i <= 2; ++i)
    EXPECT_EQ(run_twice_at_once(shard_words(experiment, {.index = i, .count = 2},
                                            folder / ("shard-" + std::to_string(i)))),
              2);
  const Words folders = {folder / "shard-1", folder / "shard-2"};
  ASSERT_EQ(merge(folders, folder / "study").exit_code, 0);
  expect_lasting_same(folder / "whole", folder / "study");
}

TEST(Shards, StartedTwiceAtOnceOnAFileSystemWithoutLocksLoseNothing) {
  const TemporaryFolder folder;
  const Words experiment = {kSmall, "--layouts", "10"};
  ASSERT_EQ(mapproof(Words{"run"} + experiment + Words{"--out", folder / "whole"}).exit_code, 0);
  const Words words = shard_words(experiment, {}, folder / "shard");
  const Faults faults("lock:1-:fail");
  for (int round = 0; round < 3; ++round) {
    run_twice_at_once(words);  // Either may be stopped by the other.
    ASSERT_EQ(mapproof(words).exit_code, 0);
    ASSERT_EQ(merge({folder / "shard"}, folder / "study").exit_code, 0);
    expect_lasting_same(folder / "whole", folder / "study");
    fs::remove_all(folder / "shard");
  }
}

TEST(Shards, OfAnotherStudyAreRefusedInOneLineEach) {
  const TemporaryFolder folder;
  const Words folders = run_shards({kSmall}, 3, folder / "shards");
  const Words seed = run_shards({kSmall, "--seed", "8"}, 1, folder / "seed");
  replace_in(fs::path(folders[1]) / "study.json", R"("solver_digest": "[0-9a-f]{4})",
             R"("solver_digest": "0000)");
  replace_in(fs::path(folders[2]) / "study.json", R"("version": "1\.0\.0")", R"("version": "99.1.0")");
  const Outcome outcome = merge(folders + seed, folder / "study");
  EXPECT_EQ(outcome.exit_code, 2);
  expect_lines(outcome.error, {folders[1] + ": is of another study", "/provenance/solver_digest",
                               "/experiment/seed is 7 there and 8 here"});
  EXPECT_NE(outcome.error.find("/provenance/version"), std::string::npos) << outcome.error;
  EXPECT_FALSE(fs::exists(folder / "study"));
}

TEST(Shards, ThatAreMissingDamagedOrHalfDoneAreNamedWithTheCommandThatMakesThem) {
  const TemporaryFolder folder;
  ASSERT_EQ(mapproof({"run", kSmall, "--out", folder / "whole"}).exit_code, 0);
  Words folders = run_shards({kSmall}, 4, folder / "shards");
  const fs::path damaged = fs::path(folders[1]) / "runs/layout-1-pose-2.json";
  replace_in(damaged, "0\\.1", "0.2");  // Still a record that can be read.
  fs::remove(fs::path(folders[2]) / "maps/layout-2-pose-1.json");
  const std::string last = folders.back();
  folders.pop_back();
  const Outcome outcome = merge(folders, folder / "study");
  EXPECT_EQ(outcome.exit_code, 1);
  for (const std::string& part :
       {damaged.string() + ": is not what was written",
        folders[1] + ": 1 of the 1 tasks of shard 2/4", "--shard 2/4 --out " + folders[1],
        "--shard 3/4 --out " + folders[2], std::string("shard 4/4 is missing"),
        std::string("--shard 4/4 --out DIR")})
    EXPECT_NE(outcome.error.find(part), std::string::npos) << part << '\n' << outcome.error;
  EXPECT_FALSE(fs::exists(folder / "study"));

  const Outcome check = mapproof(Words{"merge", "--check"} + folders);
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_EQ(check.out, "2/4\n3/4\n4/4\n");
  // The same commands make what is missing.
  for (const int i : {2, 3})
    ASSERT_EQ(mapproof(shard_words({kSmall}, {.index = i, .count = 4},
                                   folders[static_cast<std::size_t>(i - 1)]))
                  .exit_code,
              0);
  folders.push_back(last);
  EXPECT_EQ(mapproof(Words{"merge", "--check"} + folders).exit_code, 0);
  ASSERT_EQ(merge(folders, folder / "study").exit_code, 0);
  expect_lasting_same(folder / "whole", folder / "study");
}

TEST(Shards, TakeTheRecordsOfAnotherFolderWhereTheirsAreDamaged) {
  const TemporaryFolder folder;
  const Words folders =
      run_shards({kSmall}, 2, folder / "a") + run_shards({kSmall}, 1, folder / "b");
  write_file(fs::path(folders[0]) / "runs/layout-1-pose-1.json", "{}");
  const Outcome outcome = merge(folders, folder / "study");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_NE(outcome.error.find("layout-1-pose-1.json: is not what was written"), std::string::npos);
  ASSERT_EQ(mapproof({"run", kSmall, "--out", folder / "whole"}).exit_code, 0);
  expect_lasting_same(folder / "whole", folder / "study");
}

TEST(Shards, WithOtherRecordsOfOneTaskAreRefused) {
  const TemporaryFolder folder;
  const Words folders =
      run_shards({kSmall}, 1, folder / "a") + run_shards({kSmall}, 1, folder / "b");
  const fs::path record = fs::path(folders[1]) / "runs/layout-1-pose-1.json";
  const std::string text = read_file(record);
  write_file(record, text + "\n");
  replace_in(fs::path(folders[1]) / "timings.jsonl", sha256_hex(text), sha256_hex(text + "\n"));
  const Outcome outcome = merge(folders, folder / "study");
  EXPECT_EQ(outcome.exit_code, 2);
  expect_lines(outcome.error, {"holds other records of layout-1-pose-1 than " + folders[0]});
}

TEST(Shards, NoteTheirProcessorAndWarnWhereTheyAreMixed) {
  const TemporaryFolder folder;
  const Words folders = run_shards({kSmall}, 2, folder / "shards");
  const Outcome equal = mapproof(Words{"merge", "--json"} + folders + Words{"--out", folder / "a"});
  ASSERT_EQ(equal.exit_code, 0) << equal.error;
  EXPECT_EQ(equal.error.find("kinds of processor"), std::string::npos) << equal.error;
  EXPECT_EQ(json::parse(equal.out).at("processors"), json({processor_kind()}));
  replace_in(fs::path(folders[1]) / "timings.jsonl", R"("processor": "[^"]*")",
             R"re("processor": "other (x86_64)")re");
  const Outcome mixed = merge(folders, folder / "b");
  EXPECT_EQ(mixed.exit_code, 0);
  EXPECT_NE(mixed.error.find("2 kinds of processor"), std::string::npos) << mixed.error;
  EXPECT_NE(read_file(folder / "b/timings.jsonl").find("other (x86_64)"), std::string::npos);
  expect_lasting_same(folder / "a", folder / "b");
}

TEST(Shards, OfAnotherShareOrNoStudyAreRefused) {
  const TemporaryFolder folder;
  const Words folders = run_shards({kSmall}, 2, folder / "shards");
  const Outcome other = mapproof(shard_words({kSmall}, {.index = 2, .count = 2}, folders[0]));
  EXPECT_EQ(other.exit_code, 2);
  expect_lines(other.error, {"holds shard 1/2, not 2/2; choose another folder"});
  for (const char* text : {"0/2", "3/2", "1/0", "1", "1/2/3", "a/b", "-1/2", "1/ 2"}) {
    const Outcome outcome = mapproof({"run", kSmall, "--shard", text, "--out", folder / "none"});
    EXPECT_EQ(outcome.exit_code, 2) << text;
    EXPECT_NE(outcome.error.find("is not I/N"), std::string::npos) << outcome.error;
  }
  ASSERT_EQ(mapproof({"run", kSmall, "--out", folder / "whole"}).exit_code, 0);
  const Outcome none = merge({folder / "whole"}, folder / "study");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.error.find("holds a study that was run without --shard"), std::string::npos)
      << none.error;
  EXPECT_EQ(merge(folders, folders[0]).exit_code, 2);
  EXPECT_EQ(mapproof(Words{"merge"} + folders).exit_code, 2);
}

TEST(Shards, AFileThatIsNoRecordIsNotTakenFromAFolderThatWasHandedOver) {
  const TemporaryFolder folder;
  const Words folders = run_shards({kSmall}, 1, folder / "shards");
  const std::string secret = folder.file("secret.txt", "secret");
  replace_in(fs::path(folders[0]) / "timings.jsonl",
             R"re("file": "runs/layout-1-pose-1.json", "sha256": "[0-9a-f]{64}")re",
             R"("file": "runs/../../../secret.txt", "sha256": ")" + sha256_hex("secret") + "\"");
  const Outcome outcome = merge(folders, folder / "study");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.error.find("names a file that is not a record"), std::string::npos)
      << outcome.error;
}

TEST(Shards, HoldTheirShareOfTheTasks) {
  for (int count = 1; count <= 9; ++count)
    for (int tasks = 0; tasks <= 20; ++tasks) {
      int all = 0;
      for (int index = 1; index <= count; ++index)
        all += share_size({.index = index, .count = count}, tasks);
      EXPECT_EQ(all, tasks);
    }
  EXPECT_EQ(shard_of_text("2/8"), (Shard{.index = 2, .count = 8}));
}

TEST(ProcessorKind, IsWhatTheSystemNamesIt) {
  EXPECT_EQ(
      processor_kind("processor\t: 0\nmodel\t\t: 17\nmodel name\t: AMD EPYC 7763\n", "x86_64"),
      "AMD EPYC 7763 (x86_64)");
  EXPECT_EQ(processor_kind("CPU implementer\t: 0x41\nCPU part\t: 0xd0c\n", "aarch64"),
            "implementer 0x41, part 0xd0c (aarch64)");
  EXPECT_EQ(processor_kind("", "riscv64"), "unknown (riscv64)");
}

}  // namespace
}  // namespace mapproof::test
