#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/base/random.hpp"
#include "core/records/folder_lock.hpp"
#include "reports/history/history_export.hpp"
#include "reports/history/history_store.hpp"
#include "tests/reports/history/sample_nights.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

TEST(HistoryStore, ThatIsDamagedIsKeptAsideAndSaid) {
  for (const bool header : {true, false}) {
    const TemporaryFolder folder;
    const fs::path path = history_file(folder.path());
    {
      HistoryStore store = HistoryStore::open(folder.path());
      for (int i = 1; i <= 3; ++i) store.append(sample_night(i, 1));
    }
    std::string bytes = read_file(path);
    std::fill_n(bytes.begin() + (header ? 0 : 8192), header ? 64 : 20'000, '\x5a');
    write_file(path, bytes);
    EXPECT_THROW(HistoryStore::open_existing(folder.path()), IoError);
    EXPECT_EQ(read_file(path), bytes);  // A reader leaves it as it is.
    HistoryStore store = HistoryStore::open(folder.path());
    ASSERT_EQ(store.remarks().size(), 1U);
    EXPECT_TRUE(store.nights().empty());
    EXPECT_EQ(read_file(folder.path() / "history.sqlite.damaged-1"), bytes);
  }
}

/// A store of three nights, damaged: its first `cut` bytes, `flips` of them changed.
std::string damaged_bytes(const fs::path& path, double cut, int flips, Random& random) {
  {
    HistoryStore store = HistoryStore::open(path.parent_path());
    for (int i = 1; i <= 3; ++i) {
      Night night = sample_night(i, 1);
      night.findings.push_back({.study = "sample", .sentence = "a finding"});
      store.append(night);
    }
  }
  std::string bytes = read_file(path);
  bytes.resize(static_cast<std::size_t>(cut * static_cast<double>(bytes.size())));
  for (int i = 0; i < flips; ++i) {
    // Half of them in the first pages: the header, the tables' definitions, the nights.
    const double reach = i % 2 == 0 ? 12'000.0 : static_cast<double>(bytes.size());
    const auto at = static_cast<std::size_t>(
        random.uniform(0.0, std::min(reach, static_cast<double>(bytes.size()))));
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << static_cast<int>(random.uniform(0.0, 8.0))));
  }
  write_file(path, bytes);
  return bytes;
}

TEST(HistoryStore, WhateverByteIsDamagedIsReadOrKeptAsideOrRefusedAsItIs) {
  Random random(19);
  int kept_aside = 0;
  for (int round = 0; round < 150; ++round) {
    const TemporaryFolder folder;
    const fs::path path = history_file(folder.path());
    const double cut = round % 3 == 0 ? random.uniform(0.02, 0.99) : 1.0;
    const std::string bytes = damaged_bytes(path, cut, round % 3 == 0 ? 0 : 1 + round % 5, random);
    const fs::path aside = folder.path() / "history.sqlite.damaged-1";
    try {
      HistoryStore store = HistoryStore::open(folder.path());
      EXPECT_NO_THROW(history_json(store, true)) << round;
      EXPECT_EQ(fs::exists(aside), !store.remarks().empty()) << round;
      EXPECT_NO_THROW(store.append(sample_night(store.last_number() + 1, 1))) << round;
    } catch (const IoError& error) {  // Another program's, or of a later version.
      EXPECT_FALSE(fs::exists(aside)) << round << error.what();
      EXPECT_EQ(read_file(path), bytes) << round;
    }
    if (!fs::exists(aside)) continue;
    ++kept_aside;
    EXPECT_EQ(read_file(aside), bytes) << round;
  }
  EXPECT_GT(kept_aside, 60);
}

TEST(HistoryStore, ThatIsInUseIsNotTakenForADamagedOne) {
  const TemporaryFolder folder;
  HistoryStore::open(folder.path());
  Database other(history_file(folder.path()), Database::Access::kWrite);
  other.execute("BEGIN EXCLUSIVE");
  EXPECT_THROW(HistoryStore::open(folder.path()), IoError);
  EXPECT_FALSE(fs::exists(folder.path() / "history.sqlite.damaged-1"));
}

/// Appends nights to a store as long as it lives, each time under its lock, as the program does.
[[noreturn]] void append_for_ever(const fs::path& folder, const fs::path& finished) {
  for (;;) {
    const FolderLock lock(folder, [] {});
    HistoryStore store = HistoryStore::open(folder);
    const int number = store.last_number() + 1;
    store.append(sample_night(number, 1));
    append_file(finished, std::to_string(number) + "\n");
  }
}

std::set<int> numbers_in(const fs::path& path) {
  std::ifstream file(path);
  std::set<int> numbers;
  for (int number = 0; file >> number;) numbers.insert(number);
  return numbers;
}

TEST(HistoryStore, LosesNoFinishedNightToAHundredKillsOfTwoWriters) {
  const TemporaryFolder folder;
  const fs::path store = folder.path() / "store";
  make_folder(store);
  Random random(7);
  const fs::path finished = folder.path() / "finished";
  // A busy machine finishes few nights between two kills: it goes on until there is enough to lose.
  for (int kill = 0; kill < 100 || (kill < 1000 && numbers_in(finished).size() <= 20); ++kill) {
    std::vector<pid_t> writers;
    for (int i = 0; i < 2; ++i) {
      const pid_t child = ::fork();
      if (child == 0) append_for_ever(store, finished);
      writers.push_back(child);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(static_cast<int>(random.uniform(5, 60))));
    for (const pid_t writer : writers) {
      ::kill(writer, SIGKILL);
      ::waitpid(writer, nullptr, 0);
    }
  }
  HistoryStore after = HistoryStore::open(store);
  EXPECT_TRUE(after.remarks().empty());
  std::set<int> recorded;
  for (const NightFacts& night : after.nights()) {
    recorded.insert(night.number);
    EXPECT_EQ(after.scores(night.number, "sample").size(), 12U);
  }
  const std::set<int> promised = numbers_in(finished);
  EXPECT_TRUE(std::ranges::includes(recorded, promised));
  EXPECT_GT(promised.size(), 20U);
}

}  // namespace
}  // namespace mapproof::test
