#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/base/random.hpp"
#include "core/base/sha256.hpp"
#include "core/records/folder_lock.hpp"
#include "reports/history/history_export.hpp"
#include "reports/history/history_pages.hpp"
#include "reports/history/history_prune.hpp"
#include "reports/history/judge_night.hpp"
#include "reports/history/object_folder.hpp"
#include "reports/history/schema.hpp"
#include "tests/reports/history/sample_nights.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

Night judged(HistoryStore& store, Night night) {
  judge_night(store, night, std::nullopt);
  store.append(night);
  return night;
}

std::vector<std::string> subjects(const Night& night) {
  std::vector<std::string> found;
  for (const NightFinding& finding : night.findings)
    found.push_back(std::string(name(finding.rule)) + ": " + finding.subject);
  return found;
}

TEST(Sha256, OfThreeLettersIsThatOfTheStandard) {
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(HistoryWeek, PlantedRegressionsAreNamedOnNightFiveAndNothingElseIs) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  for (int number = 1; number <= 7; ++number) {
    Plant plant;
    if (number >= 5) {
      plant.error = {{"isomap-K6", 1.08}};
      plant.seconds = {{"lle-K6", 1.4}};
    }
    const Night night = judged(store, sample_night(number, 11, plant));
    if (number < 5) {
      EXPECT_EQ(night.facts.verdict, NightVerdict::kGood) << number;
      EXPECT_TRUE(night.findings.empty()) << number;
      continue;
    }
    EXPECT_EQ(night.facts.verdict, NightVerdict::kAccuracy);
    EXPECT_EQ(night.facts.reference, 4);
    EXPECT_EQ(subjects(night), (std::vector<std::string>{"accuracy: bearing, isomap-K6, 2000 steps",
                                                         "seconds: bearing, lle-K6"}));
    for (const NightFinding& finding : night.findings) EXPECT_EQ(finding.since, 5);
  }
}

TEST(HistoryWeek, ASlowdownAloneIsOfCost) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  for (int number = 1; number <= 4; ++number) judged(store, sample_night(number, 3));
  const Night night = judged(store, sample_night(5, 3, {.seconds = {{"smacof", 1.5}}}));
  EXPECT_EQ(night.facts.verdict, NightVerdict::kCost);
  EXPECT_EQ(subjects(night), std::vector<std::string>{"seconds: bearing, smacof"});
}

TEST(HistoryWeek, ASingleBusyNightIsNotFlaggedTwoInARowAre) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  for (int number = 1; number <= 6; ++number) judged(store, sample_night(number, 5));
  const Plant busy{.all_seconds = 2.0, .memory = 1.3};
  EXPECT_TRUE(judged(store, sample_night(7, 5, busy)).findings.empty());
  EXPECT_TRUE(judged(store, sample_night(8, 5)).findings.empty());
  EXPECT_TRUE(judged(store, sample_night(9, 5, busy)).findings.empty());
  const Night second = judged(store, sample_night(10, 5, busy));
  EXPECT_EQ(subjects(second),
            (std::vector<std::string>{"all-seconds: all methods", "memory: the whole study"}));
  for (const NightFinding& finding : second.findings) EXPECT_EQ(finding.since, 9);
}

TEST(HistoryWeek, ASlowDriftIsFoundWithAboutTheNightItBegan) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  std::optional<NightFinding> first;
  for (int number = 1; number <= 40 && !first; ++number) {
    // Each night by .4 %: less than counts from one night to the next.
    const double drift = std::pow(1.004, std::max(0, number - 12));
    const Night night =
        judged(store, sample_night(number, 9, {.error = {{"lpca", drift}}, .error_noise = 0.002}));
    for (const NightFinding& finding : night.findings)
      if (finding.rule == NightRule::kAccuracyDrift) first = finding;
  }
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->subject, "bearing, lpca");
  EXPECT_NEAR(first->since, 13, 6);
}

TEST(HistoryWeek, APinnedNightIsAcceptedAsItIs) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  const Plant worse{.error = {{"lpca", 1.2}}};
  judged(store, sample_night(1, 2));
  EXPECT_EQ(judged(store, sample_night(2, 2, worse)).facts.verdict, NightVerdict::kAccuracy);
  store.pin(2);
  const Night night = judged(store, sample_night(3, 2, worse));
  EXPECT_EQ(night.facts.reference, 2);
  EXPECT_TRUE(night.findings.empty());
  EXPECT_THROW(store.pin(99), InvalidInput);
}

TEST(HistoryWeek, LostMapsAreTold) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  judged(store, sample_night(1, 2));
  Night night = sample_night(2, 2);
  for (RunValue& value : night.studies[0].scores[{"bearing", "smacof", 2000, "mpe_m"}])
    value.value = std::nan("");
  EXPECT_EQ(subjects(judged(store, night)), std::vector<std::string>{"lost-maps: bearing, smacof"});
}

TEST(HistoryWeek, AClockThatJumpedIsSaid) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  judged(store, sample_night(1, 2));
  Night night = sample_night(2, 2);
  night.facts.started_utc = "1999-01-01T00:00:00Z";
  const auto remarks = judge_night(store, night, std::nullopt);
  EXPECT_NE(remarks.front().find("the clock stands at 1999"), std::string::npos);
}

TEST(HistoryStore, GivesBackWhatItWasGiven) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  Night night = sample_night(1, 4);
  night.studies[0].scores[{"bearing", "lpca", 2000, "mpe_m"}][3].value = std::nan("");
  night.studies[0].figures = {{"fig-1.svg", sha256_hex("x"), 1}};
  store.append(night);
  const Scores scores = store.scores(1, "sample");
  ASSERT_EQ(scores.size(), night.studies[0].scores.size());
  for (const auto& [series, values] : night.studies[0].scores)
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_EQ(scores.at(series)[i].run, values[i].run);
      if (std::isnan(values[i].value))
        EXPECT_TRUE(std::isnan(scores.at(series)[i].value));
      else
        EXPECT_EQ(scores.at(series)[i].value, values[i].value);
    }
  EXPECT_EQ(store.digests(), std::vector<std::string>{sha256_hex("x")});
  EXPECT_THROW(store.append(night), InvalidInput);  // Never the same number twice.
}

TEST(HistoryStore, OfAnOlderVersionIsMigratedAndKeptAsItWas) {
  const TemporaryFolder folder;
  {
    Database old(history_file(folder.path()), Database::Access::kWrite);
    make_tables(old, 1);
    old.execute(
        "INSERT INTO nights VALUES (4, '2026-01-01T00:00:00Z', '2026-01-01T01:00:00Z', 'c', '{}', "
        "'h', 'p', 2, 2, NULL, 'good')");
  }
  EXPECT_THROW(HistoryStore::open_existing(folder.path()), IoError);
  HistoryStore store = HistoryStore::open(folder.path());
  ASSERT_EQ(store.remarks().size(), 1U);
  ASSERT_EQ(store.nights().size(), 1U);
  EXPECT_EQ(store.nights()[0].number, 4);
  EXPECT_FALSE(store.nights()[0].pinned);
  Database kept(folder.path() / "history.sqlite.v1-backup", Database::Access::kRead);
  EXPECT_EQ(version_of(kept), 1);
}

TEST(HistoryStore, OfALaterVersionOrOfAnotherProgramIsRefused) {
  const TemporaryFolder folder;
  {
    Database other(history_file(folder.path()), Database::Access::kWrite);
    other.execute("CREATE TABLE theirs (x); PRAGMA user_version = 1");
  }
  EXPECT_THROW(HistoryStore::open(folder.path()), IoError);
  const TemporaryFolder later;
  HistoryStore::open(later.path());
  {
    Database ours(history_file(later.path()), Database::Access::kWrite);
    ours.execute("PRAGMA user_version = 99");
  }
  EXPECT_THROW(HistoryStore::open(later.path()), IoError);
}

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

TEST(HistoryPrune, KeepsTheLastEverySoManyPinnedAndWhatTheyWereComparedWith) {
  std::vector<NightFacts> nights;
  for (int i = 1; i <= 20; ++i) nights.push_back({.number = i});
  nights[4].pinned = true;
  nights[19].reference = 9;
  EXPECT_EQ(nights_to_remove(nights, parse_prune_rule("last=3,every=7")),
            (std::vector<int>{1, 2, 3, 4, 6, 8, 10, 11, 12, 13, 15, 16, 17}));
  for (const char* bad : {"", "last=0", "last=3,", "every=7", "last=3,every=x", "last=99999999999"})
    EXPECT_THROW(parse_prune_rule(bad), InvalidInput) << bad;
}

TEST(HistoryPrune, FinishesWhatAnErrorLeftHalfDone) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  for (int number = 1; number <= 4; ++number) {
    store.append(sample_night(number, 1));
    write_file(night_folder(folder.path(), number) / "night.json", "{}");
  }
  const PruneRule rule{.last = 1};
  {
    Database other(history_file(folder.path()), Database::Access::kWrite);
    other.execute(
        "CREATE TRIGGER no_room BEFORE DELETE ON nights BEGIN SELECT RAISE(ABORT, 'no'); END");
    EXPECT_THROW(prune(store, folder.path(), rule), IoError);
    other.execute("DROP TRIGGER no_room");
  }
  prune(store, folder.path(), rule);
  ASSERT_EQ(store.nights().size(), 1U);
  for (int number = 1; number <= 4; ++number)
    EXPECT_EQ(fs::exists(night_folder(folder.path(), number)), number == 4) << number;
}

TEST(ObjectFolder, KeepsAFigureOfTwoNightsOnceAndDropsWhatNoNightNames) {
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
  EXPECT_EQ(read_file(folder.path() / "b" / "more.svg"), "other");  // The night keeps its own.
}

TEST(HistoryPages, AreValidReportsAndFigures) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  NightFindings findings;
  for (int number = 1; number <= 6; ++number) {
    Plant plant;
    if (number >= 5) plant.error = {{"lpca", 1.1}};
    findings[number] = judged(store, sample_night(number, 1, plant)).findings;
  }
  const HistoryPage page = trend_page(store.trend("sample", "d", 60, 6), findings);
  EXPECT_NO_THROW(check(page.report));
  ASSERT_EQ(page.figures.size(), 3U);  // MPE, seconds, memory.
  for (const Figure& figure : page.figures) EXPECT_EQ(problem(figure), "");
  EXPECT_NO_THROW(check(index_page(store.nights(), findings, {}, {})));
  EXPECT_NO_THROW(check(index_page({}, {}, {}, {})));
}

TEST(HistoryPages, BeginWithThreeFindingsAndSayHowManyMore) {
  Night night{.facts = {.number = 5, .started_utc = "2026-11-22T02:30:07Z"}};
  for (int i = 1; i <= 7; ++i)
    night.findings.push_back({.study = "mine", .sentence = fmt::format("worse {}", i)});
  const Standing stands = standing(night, "mine", true);
  EXPECT_EQ(stands.title, "Night 5: 7 things got worse");
  ASSERT_EQ(stands.sentences.size(), 4U);
  EXPECT_EQ(stands.sentences[2], "worse 3.");
  EXPECT_TRUE(stands.sentences[3].starts_with("And 4 more"));

  const Report index =
      index_page(std::vector{night.facts}, {{5, night.findings}}, {{5, {"small"}}}, {});
  EXPECT_EQ(index.subtitle, "1 night, the last begun 2026-11-22 02:30 UTC");
  std::size_t items = 0;
  for (const Block& block : index.sections.front().blocks)
    if (const auto* list = std::get_if<BulletList>(&block)) items += list->items.size();
  EXPECT_EQ(items, 4U);
}

TEST(HistoryExport, HasALineAValue) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  store.append(sample_night(1, 1));
  const std::string csv = history_csv(store);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6 * 2 * 25);
  EXPECT_EQ(history_json(store, true)["nights"][0]["studies"][0]["scores"].size(), 12U);
}

}  // namespace
}  // namespace mapproof::test
