#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <set>
#include <thread>

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/random.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "reports/history/history_export.hpp"
#include "reports/history/history_store.hpp"
#include "tests/reports/history/sample_nightly_runs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

/// Expects what opens the store to refuse it with these words, and to leave it as it is.
void expect_refused(const fs::path& folder, const std::string& words) {
  const std::string bytes = read_file(history_file(folder));
  for (const auto open : {HistoryStore::open, HistoryStore::open_existing}) try {
      open(folder);
      ADD_FAILURE() << "opened";
    } catch (const IoError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  EXPECT_EQ(read_file(history_file(folder)), bytes);
}

TEST(HistoryStore, ThatIsDamagedIsRefusedAsItIs) {
  for (const bool header : {true, false}) {
    const TemporaryFolder folder;
    const fs::path path = history_file(folder.path());
    {
      HistoryStore store = HistoryStore::open(folder.path());
      for (int i = 1; i <= 3; ++i) store.append(sample_nightly_run(i, 1));
    }
    std::string bytes = read_file(path);
    std::fill_n(bytes.begin() + (header ? 0 : 8192), header ? 64 : 20'000, '\x5a');
    write_file(path, bytes);
    expect_refused(folder.path(), "history.sqlite: is damaged: ");
  }
}

TEST(HistoryStore, WithWhatIsNoQuantityIsRefusedAsItIs) {
  const Quantity found = study_quantity("found", "Landmarks found", "%", Better::kHigher);
  for (const auto& [change, words] :
       {std::pair("UPDATE series SET quantity = 'mpe_x' WHERE quantity = 'mpe_m'",
                  "is damaged: it has values of the unknown quantity \"mpe_x\""),
        std::pair("UPDATE quantities SET better = 'upper'",
                  "is damaged: no quantity is better \"upper\""),
        std::pair("UPDATE quantities SET id = 'mpe_m'", "is damaged: \"mpe_m\" is a quantity")}) {
    const TemporaryFolder folder;
    NightlyRun nightly_run = sample_nightly_run(1, 1);
    nightly_run.studies[0].quantities.declare(found);
    HistoryStore::open(folder.path()).append(nightly_run);
    Database(history_file(folder.path()), Database::Access::kWrite).execute(change);
    expect_refused(folder.path(), words);
  }
}

TEST(HistoryStore, WithTrendsThatAreNoNumbersIsRefusedByItsRow) {
  for (const auto& [change, words] :
       {std::pair("UPDATE trends SET median = 9e999",
                  "is damaged: nightly run 1, study sample: the trend of "),
        std::pair("UPDATE trends SET level = 'x'",
                  "is damaged: nightly run 1, study sample: the trend of "),
        std::pair("UPDATE studies SET seconds = -9e999",
                  "is damaged: nightly run 1, study sample: its seconds or its memory ")}) {
    const TemporaryFolder folder;
    HistoryStore::open(folder.path()).append(sample_nightly_run(1, 1));
    Database(history_file(folder.path()), Database::Access::kWrite).execute(change);
    expect_refused(folder.path(), words);
  }
}

TEST(HistoryStore, WithValuesOfOtherTypesThanDeclaredIsRefusedByItsColumn) {
  for (const auto& [change, words] :
       {std::pair("UPDATE scores SET value = 'x'", "a value of scores.value is not "),
        std::pair("UPDATE scores SET value = x'00'", "a value of scores.value is not "),
        std::pair("UPDATE studies SET runs = 'x'", "a value of studies.runs is not "),
        std::pair("UPDATE nightly_runs SET cores = 1.5", "a value of nightly_runs.cores is not "),
        std::pair("UPDATE nightly_runs SET pinned = 'no'",
                  "a value of nightly_runs.pinned is not "),
        std::pair("UPDATE nightly_runs SET host = x'6869'",
                  "a value of nightly_runs.host is not ")}) {
    const TemporaryFolder folder;
    HistoryStore::open(folder.path()).append(sample_nightly_run(1, 1));
    Database(history_file(folder.path()), Database::Access::kWrite).execute(change);
    expect_refused(folder.path(), std::string("is damaged: ") + words);
  }
}

TEST(HistoryStore, WithATimeThatIsNoneIsRefusedByItsNightlyRun) {
  for (const char* time : {"yesterday", "", "2026-13-01T00:00:00Z", "2026-01-01 00:00:00",
                           "2026-01-01T00:00:00+01:00"}) {
    const TemporaryFolder folder;
    HistoryStore::open(folder.path()).append(sample_nightly_run(1, 1));
    Database(history_file(folder.path()), Database::Access::kWrite)
        .execute(std::string("UPDATE nightly_runs SET started_utc = '") + time + "'");
    expect_refused(folder.path(),
                   std::string("is damaged: nightly run 1 has no time from \"") + time + "\"");
  }
}

TEST(HistoryStore, WithATextThatNoCommandLineCouldGiveIsRefused) {
  for (const char* table : {"nightly_runs SET provenance", "nightly_runs SET build",
                            "studies SET name", "findings SET sentence", "facts SET value"}) {
    const TemporaryFolder folder;
    NightlyRun nightly_run = sample_nightly_run(1, 1);
    nightly_run.findings.push_back({.study = "sample", .sentence = "a finding"});
    HistoryStore::open(folder.path()).append(nightly_run);
    sqlite3* handle = nullptr;
    ASSERT_EQ(sqlite3_open(history_file(folder.path()).c_str(), &handle), SQLITE_OK);
    const std::string change =
        std::string("UPDATE ") + table + " = replace(hex(zeroblob(3000000)), '0', 'a')";
    ASSERT_EQ(sqlite3_exec(handle, change.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(handle);
    expect_refused(folder.path(), "is damaged: ");
  }
}

TEST(HistoryStore, ThatIsGoneIsNotBegunAgainBesideItsNightlyRuns) {
  const TemporaryFolder folder;
  const fs::path path = history_file(folder.path());
  folder.file("nightly_runs/0001/nightly_run.json", "{}");
  for (int i = 0; i < 2; ++i) {
    try {
      HistoryStore::open(folder.path());
      ADD_FAILURE() << "begun";
    } catch (const IoError& error) {
      EXPECT_NE(std::string(error.what()).find("history.sqlite: is gone, and nightly_runs/ has "),
                std::string::npos)
          << error.what();
    }
    EXPECT_FALSE(fs::exists(path));
  }
  folder.file("history.sqlite.damaged-1", "of which a person knows");
  EXPECT_TRUE(HistoryStore::open(folder.path()).nightly_runs().empty());
}

TEST(HistoryStore, ThatIsCutAtAnyLengthIsRefusedAsItIs) {
  const TemporaryFolder folder;
  const fs::path path = history_file(folder.path());
  HistoryStore::open(folder.path()).append(sample_nightly_run(1, 1));
  const std::string whole = read_file(path);
  constexpr std::size_t kHeader = 100, kPage = 4096;
  for (std::size_t length = 0; length < whole.size();) {
    SCOPED_TRACE(length);
    write_file(path, whole.substr(0, length));
    expect_refused(folder.path(), "history.sqlite: is damaged: ");
    const std::size_t to_page = kPage - length % kPage;
    length += length <= kHeader || to_page == 1 ? 1 : std::min<std::size_t>(to_page - 1, 777);
  }
  write_file(path, whole);
  EXPECT_EQ(HistoryStore::open(folder.path()).nightly_runs().size(), 1U);
}

TEST(HistoryStore, IsBegunWhereThereIsNoneAndNowhereElse) {
  const TemporaryFolder folder;
  const fs::path store = folder / "store", path = history_file(store);
  fs::create_directory(store);
  fs::create_symlink(folder / "not-mounted/history.sqlite", path);
  EXPECT_THROW(HistoryStore::open(store), IoError) << "behind the link there may be one";
  fs::remove(path);
  write_file(path.string() + "-journal", "of a history that was moved away");
  EXPECT_THROW(HistoryStore::open(store), IoError);
  fs::remove(path.string() + "-journal");
  write_file(path.string() + ".part", "left by one that was killed while it began");
  HistoryStore::open(store);
  EXPECT_EQ(std::distance(fs::directory_iterator(store), fs::directory_iterator()), 1);
  EXPECT_TRUE(HistoryStore::open_existing(store).nightly_runs().empty());
}

/// A store of three nightly runs, damaged: its first `cut` bytes, `flips` of them changed.
std::string damaged_bytes(const fs::path& path, double cut, int flips, Random& random) {
  {
    HistoryStore store = HistoryStore::open(path.parent_path());
    for (int i = 1; i <= 3; ++i) {
      NightlyRun nightly_run = sample_nightly_run(i, 1);
      nightly_run.findings.push_back({.study = "sample", .sentence = "a finding"});
      store.append(nightly_run);
    }
  }
  std::string bytes = read_file(path);
  bytes.resize(static_cast<std::size_t>(cut * static_cast<double>(bytes.size())));
  for (int i = 0; i < flips; ++i) {
    // Half of them in the first pages: the header, the tables' definitions, the nightly runs.
    const double reach = i % 2 == 0 ? 12'000.0 : static_cast<double>(bytes.size());
    const auto at = static_cast<std::size_t>(
        random.uniform(0.0, std::min(reach, static_cast<double>(bytes.size()))));
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << static_cast<int>(random.uniform(0.0, 8.0))));
  }
  write_file(path, bytes);
  return bytes;
}

TEST(HistoryStore, WhateverByteIsDamagedIsReadOrRefusedAsItIs) {
  Random random(19);
  int refused = 0;
  for (int round = 0; round < 150; ++round) {
    const TemporaryFolder folder;
    const fs::path path = history_file(folder.path());
    const double cut = round % 3 == 0 ? random.uniform(0.02, 0.99) : 1.0;
    const std::string bytes = damaged_bytes(path, cut, round % 3 == 0 ? 0 : 1 + round % 5, random);
    try {
      HistoryStore store = HistoryStore::open(folder.path());
      EXPECT_NO_THROW(export_history_json(store, [](std::string_view) {})) << round;
      EXPECT_NO_THROW(store.append(sample_nightly_run(store.last_number() + 1, 1))) << round;
    } catch (const IoError&) {
      EXPECT_EQ(read_file(path), bytes) << round;
      ++refused;
    }
  }
  EXPECT_GT(refused, 60);
}

TEST(HistoryStore, ThatIsInUseIsNotTakenForADamagedOne) {
  const TemporaryFolder folder;
  HistoryStore::open(folder.path());
  Database other(history_file(folder.path()), Database::Access::kWrite);
  other.execute("BEGIN EXCLUSIVE");
  EXPECT_THROW(HistoryStore::open(folder.path()), IoError);
}

/// Appends nightly runs to a store as long as it lives, each time under its lock, as the program
/// does.
[[noreturn]] void append_for_ever(const fs::path& folder, const fs::path& finished) {
  for (;;) {
    const FolderLock lock(folder, [] {});
    HistoryStore store = HistoryStore::open(folder);
    const int number = store.last_number() + 1;
    store.append(sample_nightly_run(number, 1));
    OutputFolder(finished.parent_path()).append(finished.filename(), std::to_string(number) + "\n");
  }
}

std::set<int> numbers_in(const fs::path& path) {
  std::ifstream file(path);
  std::set<int> numbers;
  for (int number = 0; file >> number;) numbers.insert(number);
  return numbers;
}

TEST(HistoryStore, LosesNoFinishedNightlyRunToAHundredKillsOfTwoWriters) {
  const TemporaryFolder folder;
  const fs::path store = folder.path() / "store";
  make_folder(store);
  Random random(7);
  const fs::path finished = folder.path() / "finished";
  // A busy machine finishes few nightly runs between two kills: it goes on, with more time between
  // them, until there is enough to lose.
  for (int kill = 0; kill < 100 || (kill < 1000 && numbers_in(finished).size() <= 20); ++kill) {
    std::vector<pid_t> writers;
    for (int i = 0; i < 2; ++i) {
      const pid_t child = ::fork();
      if (child == 0) append_for_ever(store, finished);
      writers.push_back(child);
    }
    const double patience = 1.0 + kill / 100;
    std::this_thread::sleep_for(
        std::chrono::duration<double, std::milli>(patience * random.uniform(5, 60)));
    for (const pid_t writer : writers) {
      ::kill(writer, SIGKILL);
      ::waitpid(writer, nullptr, 0);
    }
  }
  HistoryStore after = HistoryStore::open(store);
  EXPECT_TRUE(after.remarks().empty());
  std::set<int> recorded;
  for (const NightlyFacts& nightly_run : after.nightly_runs()) {
    recorded.insert(nightly_run.number);
    EXPECT_EQ(after.scores(nightly_run.number, "sample").size(), 12U);
  }
  const std::set<int> promised = numbers_in(finished);
  EXPECT_TRUE(std::ranges::includes(recorded, promised));
  EXPECT_GT(promised.size(), 20U);
}

}  // namespace
}  // namespace mapproof::test
