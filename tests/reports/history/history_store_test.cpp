#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/sha256.hpp"
#include "reports/history/history_export.hpp"
#include "reports/history/history_store.hpp"
#include "reports/history/shown_names.hpp"
#include "reports/history/store/schema.hpp"
#include "tests/reports/history/sample_nightly_runs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

TEST(HistoryStore, GivesBackWhatItWasGiven) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  NightlyRun nightly_run = sample_nightly_run(1, 4);
  nightly_run.studies[0].scores[{"bearing", "lpca", 2000, "mpe_m"}][3].value = std::nan("");
  nightly_run.studies[0].figures = {{"fig-1.svg", sha256_hex("x"), 1}};
  store.append(nightly_run);
  const Scores scores = store.scores(1, "sample");
  ASSERT_EQ(scores.size(), nightly_run.studies[0].scores.size());
  for (const auto& [series, values] : nightly_run.studies[0].scores)
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_EQ(scores.at(series)[i].run, values[i].run);
      if (std::isnan(values[i].value))
        EXPECT_TRUE(std::isnan(scores.at(series)[i].value));
      else
        EXPECT_EQ(scores.at(series)[i].value, values[i].value);
    }
  EXPECT_EQ(store.digests(), std::vector<std::string>{sha256_hex("x")});
  EXPECT_THROW(store.append(nightly_run), InvalidInput);  // Never the same number twice.
}

TEST(HistoryStore, GivesTheFindingsAndStudiesOfAllRunsAsItGivesThoseOfEach) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  for (int number = 1; number <= 4; ++number) {
    NightlyRun nightly_run = sample_nightly_run(number, 4);
    for (int i = 0; i < number - 1; ++i)  // The first one has none.
      nightly_run.findings.push_back({.study = "sample",
                                      .rule = HistoryRule::kAccuracy,
                                      .subject = "lpca",
                                      .quantity = "mpe_m",
                                      .since = 2,
                                      .sentence = "sentence " + std::to_string(10 * number + i)});
    store.append(nightly_run);
  }
  const auto findings = store.all_findings();
  const auto names = store.study_names();
  EXPECT_EQ(findings.size(), 3U);
  ASSERT_EQ(names.size(), 4U);
  for (int number = 1; number <= 4; ++number) {
    const std::vector<NightlyFinding> own = store.findings(number);
    ASSERT_EQ(std::ssize(own), number - 1);
    for (std::size_t i = 0; i < own.size(); ++i)
      EXPECT_EQ(findings.at(number)[i].sentence, own[i].sentence);
    EXPECT_EQ(names.at(number), std::vector<std::string>{store.studies(number)[0].name});
  }
}

TEST(HistoryStore, OfAnOlderVersionIsMigratedAndKeptAsItWas) {
  const TemporaryFolder folder;
  {
    Database old(history_file(folder.path()), Database::Access::kCreate);
    make_tables(old, 1);
    old.execute(
        "INSERT INTO nights VALUES (4, '2026-01-01T00:00:00Z', '2026-01-01T01:00:00Z', 'c', "
        "'{}', "
        "'h', 'p', 2, 2, NULL, 'good')");
  }
  EXPECT_THROW(HistoryStore::open_existing(folder.path()), IoError);
  HistoryStore store = HistoryStore::open(folder.path());
  ASSERT_EQ(store.remarks().size(), 1U);
  ASSERT_EQ(store.nightly_runs().size(), 1U);
  EXPECT_EQ(store.nightly_runs()[0].number, 4);
  EXPECT_FALSE(store.nightly_runs()[0].pinned);
  Database kept(folder.path() / "history.sqlite.v1-backup", Database::Access::kRead);
  EXPECT_EQ(version_of(kept), 1);
}

TEST(HistoryStore, KeepsWhatAStudyDeclaresOfItsQuantities) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  NightlyRun nightly_run = sample_nightly_run(1, 4);
  const Quantity found = study_quantity("found", "Landmarks found", "%", Better::kHigher);
  nightly_run.studies[0].quantities.declare(found);
  nightly_run.studies[0].scores[{"bearing", "lpca", 2000, "found"}] = {
      {"layout-1-pose-1", "layout-1", 9.0}};
  store.append(nightly_run);
  EXPECT_EQ(store.studies(1)[0].quantities.declared(), std::vector<Quantity>{found});
  EXPECT_EQ(store.trend("sample", "d", 60, 1).quantities.at("found"), found);
  const auto exported = history_json(store)["nightly_runs"][0]["studies"][0]["quantities"];
  EXPECT_EQ(exported.dump(),
            R"([{"id":"found","label":"Landmarks found","unit":"%","better":"higher"}])");
  store.remove({1});
  Database database(history_file(folder.path()), Database::Access::kRead);
  Statement left(database, "SELECT count(*) FROM quantities");
  ASSERT_TRUE(left.step());
  EXPECT_EQ(left.integer(0), 0);
}

TEST(HistoryStore, OfVersion2GivesOtherNumbersTheirNamesBack) {
  const TemporaryFolder folder;
  {
    Database old(history_file(folder.path()), Database::Access::kCreate);
    make_tables(old, 2);
    old.execute(
        "INSERT INTO nights (number, started_utc, ended_utc, command, provenance, host, "
        "processor, "
        "cores, jobs, reference, verdict) VALUES (1, '2026-01-01T00:00:00Z', "
        "'2026-01-01T01:00:00Z', 'c', '{}', 'h', 'p', 2, 2, NULL, 'good');"
        "INSERT INTO studies VALUES (1, 1, 's', 'mapproof.topic_study', 'd', 1, NULL, NULL);"
        "INSERT INTO series VALUES (1, 'size', 'ppca@30 mapped_percent', 0, 'other'),"
        " (2, 'convergence', 'spectral-known', 50, 'observation');"
        "INSERT INTO trends VALUES (1, 1, 1, 0.5, 0.5), (1, 2, 1, 0.25, 0.25);");
  }
  HistoryStore store = HistoryStore::open(folder.path());
  const StudyTrend trend = store.trend("s", "d", 60, 1);
  EXPECT_EQ(trend.quantities.at("mapped_percent").label, "mapped_percent");
  EXPECT_EQ(trend.medians.at({"size", "ppca@30", 0, "mapped_percent"}), std::vector<double>{0.5});
  EXPECT_EQ(trend.medians.at({"convergence", "spectral-known", 50, "observation_error"}),
            std::vector<double>{0.25});
}

TEST(HistoryStore, KeepsWhatAStudyCallsItsSetupsMethodsAndFactors) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  const auto append = [&](int number, const StudyLabels& labels) {
    NightlyRun nightly_run = sample_nightly_run(number, 4);
    nightly_run.studies[0].labels = labels;
    store.append(nightly_run);
  };
  const StudyLabels first{.setups = {{"bearing", "Compass"}},
                          .methods = {{"lpca", "Mine"}, {"smacof", "Gone later"}},
                          .factors = {{"noise", {"range noise", "m"}}, {"pace", {"pace"}}}};
  append(1, first);
  append(2, {.methods = {{"lpca", "Mine, renamed"}}, .factors = {{"pace", {"pace", "m/s"}}}});
  EXPECT_EQ(store.studies(1)[0].labels, first);
  const StudyLabels both{.setups = {{"bearing", "Compass"}},
                         .methods = {{"lpca", "Mine, renamed"}, {"smacof", "Gone later"}},
                         .factors = {{"noise", {"range noise", "m"}}, {"pace", {"pace", "m/s"}}}};
  EXPECT_EQ(store.trend("sample", "d", 60, 2).labels, both);
  EXPECT_EQ(store.trend("sample", "d", 60, 1).labels, first);
  StudyLabels unsorted;
  for (const char* id : {"smacof", "lpca", "isomap"}) unsorted.add_method(id, "Mine");
  append(3, unsorted);
  EXPECT_EQ(store.studies(3)[0].labels.ordered(), unsorted.order);
  EXPECT_EQ(store.trend("sample", "d", 60, 3).labels.ordered(), unsorted.order);
  store.remove({1, 2, 3});
  Database database(history_file(folder.path()), Database::Access::kRead);
  Statement left(database, "SELECT count(*) FROM labels");
  ASSERT_TRUE(left.step());
  EXPECT_EQ(left.integer(0), 0);
}

TEST(HistoryStore, OfVersion3CallsMethodsThatAStudyDeclaresByTheirIds) {
  const TemporaryFolder folder;
  {
    Database old(history_file(folder.path()), Database::Access::kCreate);
    make_tables(old, 3);
    old.execute(
        "INSERT INTO nights (number, started_utc, ended_utc, command, provenance, host, "
        "processor, "
        "cores, jobs, reference, verdict) VALUES (1, '2026-01-01T00:00:00Z', "
        "'2026-01-01T01:00:00Z', 'c', '{}', 'h', 'p', 2, 2, NULL, 'good');"
        "INSERT INTO studies VALUES (1, 1, 'theirs', 'mapproof.results_study', 'd', 1, NULL, NULL),"
        " (2, 1, 'ours', 'mapproof.study', 'd', 1, NULL, NULL),"
        " (3, 1, 'topic', 'mapproof.trial_study', 'd', 1, NULL, NULL);"
        "INSERT INTO series VALUES (1, 'hall', 'isomap-K6', 0, 'ate_m'),"
        " (2, 'hall', 'scan matching noise=0.1 pace=2', 0, 'ate_m'),"
        " (3, 'hall', 'K=6', 0, 'ate_m'), (4, 'bearing', 'isomap-K6', 0, 'mpe_m'),"
        " (5, 'hall', 'scan matching noise=0.4', 0, 'ate_m');"
        "INSERT INTO trends VALUES (1, 1, 1, 1, 1), (1, 2, 1, 1, 1), (1, 3, 1, 1, 1),"
        " (1, 5, 1, 1, 1), (2, 4, 1, 1, 1), (3, 1, 1, 1, 1);");
  }
  HistoryStore store = HistoryStore::open(folder.path());
  ASSERT_EQ(store.remarks().size(), 1U);
  const StudyLabels theirs = store.trend("theirs", "d", 60, 1).labels;
  EXPECT_EQ(theirs.methods,
            (std::map<std::string, std::string>{
                {"K=6", "K=6"}, {"isomap-K6", "isomap-K6"}, {"scan matching", "scan matching"}}));
  EXPECT_EQ(shown_method(theirs, "scan matching noise=0.1 pace=2"),
            "scan matching, noise 0.1, pace 2");
  EXPECT_EQ(store.trend("ours", "d", 60, 1).labels, StudyLabels());
  EXPECT_EQ(store.trend("topic", "d", 60, 1).labels.methods.count("isomap-K6"), 1U);
}

TEST(HistoryStore, OfALaterVersionOrOfAnotherProgramIsRefused) {
  const TemporaryFolder folder;
  {
    Database other(history_file(folder.path()), Database::Access::kCreate);
    other.execute("CREATE TABLE theirs (x); PRAGMA user_version = 1");
  }
  EXPECT_THROW(HistoryStore::open(folder.path()), IoError);
  const TemporaryFolder later;
  HistoryStore::open(later.path());
  {
    Database ours(history_file(later.path()), Database::Access::kCreate);
    ours.execute("PRAGMA user_version = 99");
  }
  EXPECT_THROW(HistoryStore::open(later.path()), IoError);
}

}  // namespace
}  // namespace mapproof::test
