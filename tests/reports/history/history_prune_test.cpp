#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "reports/history/history_prune.hpp"
#include "reports/history/history_store.hpp"
#include "reports/history/store/object_folder.hpp"
#include "tests/reports/history/sample_nightly_runs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

TEST(HistoryPrune, KeepsTheLastEverySoManyPinnedAndWhatTheyWereComparedWith) {
  std::vector<NightlyFacts> nightly_runs;
  for (int i = 1; i <= 20; ++i) nightly_runs.push_back({.number = i});
  nightly_runs[4].pinned = true;
  nightly_runs[19].reference = 9;
  EXPECT_EQ(nightly_runs_to_remove(nightly_runs, parse_prune_rule("last=3,every=7")),
            (std::vector<int>{1, 2, 3, 4, 6, 8, 10, 11, 12, 13, 15, 16, 17}));
  for (const char* bad : {"", "last=0", "last=3,", "every=7", "last=3,every=x", "last=99999999999"})
    EXPECT_THROW(parse_prune_rule(bad), InvalidInput) << bad;
}

TEST(HistoryPrune, FinishesWhatAnErrorLeftHalfDone) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  for (int number = 1; number <= 4; ++number) {
    store.append(sample_nightly_run(number, 1));
    write_file(nightly_folder(folder.path(), number) / "nightly_run.json", "{}");
  }
  const PruneRule rule{.last = 1};
  {
    Database other(history_file(folder.path()), Database::Access::kWrite);
    other.execute("BEGIN IMMEDIATE");
    EXPECT_THROW(prune(store, folder.path(), rule), IoError);
    other.execute("ROLLBACK");
  }
  prune(store, folder.path(), rule);
  ASSERT_EQ(store.nightly_runs().size(), 1U);
  for (int number = 1; number <= 4; ++number)
    EXPECT_EQ(fs::exists(nightly_folder(folder.path(), number)), number == 4) << number;
}

TEST(ObjectFolder, KeepsAFigureOfTwoNightlyRunsOnceAndDropsWhatNoNightlyRunNames) {
  const TemporaryFolder folder;
  const ObjectFolder objects(folder.path() / "objects");
  write_file(folder.path() / "a" / "one.svg", "same");
  write_file(folder.path() / "b" / "two.svg", "same");
  write_file(folder.path() / "b" / "more.svg", "other");
  const auto first = objects.keep(folder.path() / "a");
  const auto second = objects.keep(folder.path() / "b");
  ASSERT_EQ(first.size(), 1U);
  ASSERT_EQ(second.size(), 2U);
  EXPECT_EQ(first[0].digest, second[1].digest);
  EXPECT_EQ(fs::hard_link_count(folder.path() / "a" / "one.svg"), 3U);
  EXPECT_TRUE(objects.problems({first[0].digest}).empty());
  EXPECT_EQ(objects.remove_others({first[0].digest}), 1);
  EXPECT_EQ(objects.problems({second[0].digest}).size(), 1U);
  EXPECT_EQ(read_file(folder.path() / "b" / "more.svg"),
            "other");  // The nightly run keeps its own.
}

}  // namespace
}  // namespace mapproof::test
