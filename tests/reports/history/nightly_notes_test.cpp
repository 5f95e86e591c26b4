#include "reports/history/nightly_notes.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "reports/history/history_store.hpp"
#include "reports/history/history_export.hpp"
#include "reports/history/store/schema.hpp"
#include "tests/reports/history/sample_nightly_runs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

const NightlyFinding kFound{.study = "sample",
                            .subject = "bearing, lpca, 2000 steps",
                            .quantity = "mpe_m",
                            .since = 6,
                            .sentence = "worse",
                            .change = 10.0};

TEST(NightlyNotes, TakeAFindingAsKnownUntilItGetsWorseOrBeginsAgain) {
  NightlyNote note{.nightly_run = 6, .finding = 1, .kind = NoteKind::kKnown, .text = "sensor"};
  put_finding(note, kFound);
  const std::vector<NightlyNote> notes = {note};
  NightlyFinding later = kFound;
  EXPECT_EQ(known_by(notes, later), notes.data());
  later.change = 10.9;
  EXPECT_NE(known_by(notes, later), nullptr) << "less than the limit of its rule";
  later.change = 11.5;
  EXPECT_EQ(known_by(notes, later), nullptr) << "it got worse";
  later = kFound;
  later.since = 9;
  EXPECT_EQ(known_by(notes, later), nullptr) << "it was fixed and came back";
  later = kFound;
  later.quantity = "moe_percent";
  EXPECT_EQ(known_by(notes, later), nullptr);
  EXPECT_TRUE(new_findings(std::vector{kFound}, notes).empty());
}

TEST(NightlyNotes, NameANightlyRunOrOneOfItsFindings) {
  EXPECT_EQ(parse_note_target("7", "--note").nightly_run, 7);
  EXPECT_EQ(parse_note_target("7.2", "--note").finding, 2);
  for (const char* text : {"", "0", "7.", ".2", "7.0", "7.2.1", "-1", "99999999999", "x"})
    EXPECT_THROW(parse_note_target(text, "--note"), InvalidInput) << text;
}

TEST(NightlyNotes, OfAFileOfDecisionsAreReadStrictly) {
  const std::string head = R"({"schema": {"name": "mapproof.decisions", "version": 1}, "decisions": )";
  const auto notes = parse_decisions(
      head + R"([{"target": "7.2", "decision": "known", "text": "sensor"},
                 {"target": "7", "decision": "accepted", "text": "new solver"}]})",
      "d.json");
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_EQ(notes[0].kind, NoteKind::kKnown);
  EXPECT_EQ(notes[1].kind, NoteKind::kAccepted);
  EXPECT_THROW(
      parse_decisions(head + R"([{"target": "7.2", "decision": "accepted", "text": "x"}]})", "d"),
      InvalidInput);
  EXPECT_THROW(parse_decisions(head + R"([{"target": "7", "decision": "like", "text": ""}]})", "d"),
               IoError);
  EXPECT_THROW(
      parse_decisions(head + R"([{"target": "7", "decision": "note", "text": "a\u0007"}]})", "d"),
      InvalidInput);
}

TEST(NightlyNotes, StayInTheHistoryWhenTheirNightlyRunIsPruned) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  for (int number = 1; number <= 3; ++number) {
    Plant plant;
    if (number == 2) plant.error = {{"lpca", 1.1}};
    judged(store, sample_nightly_run(number, 1, plant));
  }
  ASSERT_FALSE(store.findings(2).empty());
  store.add_notes({{.nightly_run = 2, .finding = 1, .kind = NoteKind::kKnown, .text = "sensor"},
                   {.nightly_run = 3, .kind = NoteKind::kAccepted, .text = "better"}});
  EXPECT_TRUE(store.nightly_runs().back().pinned);
  EXPECT_THROW(store.add_notes({{.nightly_run = 2, .finding = 9, .text = "x"}}), InvalidInput);
  EXPECT_THROW(store.add_notes({{.nightly_run = 8, .text = "x"}}), InvalidInput);
  store.add_notes({{.nightly_run = 3, .kind = NoteKind::kAccepted, .text = ""}});
  store.remove({2});
  const std::vector<NightlyNote> notes = store.notes();
  ASSERT_EQ(notes.size(), 1U) << "an empty text removes a note";
  EXPECT_EQ(notes[0].subject, "bearing, lpca, 2000 steps");
  EXPECT_EQ(notes[0].since, 2);
  ASSERT_TRUE(notes[0].change.has_value());
  EXPECT_NEAR(*notes[0].change, 10.0, 1e-6);
}

TEST(HistoryStore, KeepsCommitAndLocalTimeAndAnIdentifierOfItsOwn) {
  const TemporaryFolder folder, other;
  HistoryStore store = HistoryStore::open(folder.path());
  NightlyRun nightly_run = sample_nightly_run(1, 1);
  nightly_run.facts.commit = "0123456789abcdef";
  nightly_run.facts.repository = "https://example.org/me/x";
  nightly_run.facts.build = "make";
  nightly_run.facts.utc_offset_s = 3600;
  store.append(nightly_run);
  const NightlyFacts facts = store.nightly_runs().front();
  EXPECT_EQ(facts.commit, "0123456789abcdef");
  EXPECT_EQ(facts.repository, "https://example.org/me/x");
  EXPECT_EQ(facts.build, "make");
  EXPECT_EQ(facts.utc_offset_s, 3600);
  const std::string identifier = store.identifier();
  EXPECT_EQ(identifier.size(), 45U) << identifier;
  EXPECT_EQ(HistoryStore::open(folder.path()).identifier(), identifier);
  EXPECT_NE(HistoryStore::open(other.path()).identifier(), identifier);
}

TEST(HistoryStore, OfVersionSixGetsCommitsAndNotes) {
  const TemporaryFolder folder;
  {
    Database old(history_file(folder.path()), Database::Access::kCreate);
    make_tables(old, 6);
  }
  HistoryStore store = HistoryStore::open(folder.path());
  EXPECT_TRUE(store.notes().empty());
  EXPECT_FALSE(store.identifier().empty());
  EXPECT_EQ(store.remarks().size(), 1U) << "a copy is kept";
}

}  // namespace
}  // namespace mapproof::test
