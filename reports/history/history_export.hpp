#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/json/fields.hpp"
#include "core/records/studies/results_study_json.hpp"
#include "core/records/value_fields.hpp"
#include "reports/history/history_store.hpp"
#include "reports/history/nightly_notes.hpp"
#include "reports/history/nightly_run.hpp"

namespace mapproof {

// The fields of nightly_run.json and of an exported history (core/json/fields.hpp): both are
// written alone.

/// What a nightly run is called: verdict_word().
enum class NightlyWord { kPassed, kCost, kAccuracy, kNotCompared };

inline std::string_view name(NightlyWord word) {
  return word == NightlyWord::kNotCompared ? verdict_word({})
                                           : name(static_cast<NightlyVerdict>(word));
}

inline EnumNames enum_names(NightlyWord) {
  return names_up_to(NightlyWord::kNotCompared, "nightly_verdict");
}

inline EnumNames enum_names(HistoryRule) {
  return names_up_to(HistoryRule::kCostDrift, "history_rule");
}

/// nightly_run.json in a nightly run's folder.
struct NightlyFile {
  NightlyFacts facts = {};
  Provenance provenance = {};  ///< Replaces the text in the facts.
  std::vector<NightlyFinding> findings = {};
};

template <typename Visitor>
void fields(Visitor& v, NightlyFinding& finding) {
  v.type("finding");
  v.field("study", finding.study);
  v.field("rule", finding.rule);
  v.field("subject", finding.subject,
          {.description = "In ids: \"bearing, isomap-K6\"; of a whole study \"all methods\"."});
  v.field("quantity", finding.quantity, {.description = "Its id, or \"memory\"."});
  v.field("since", finding.since,
          {.description = "The nightly run in which it began.", .minimum = 0});
  v.field("sentence", finding.sentence, {.description = "For readers, with numbers."});
  v.field("change", finding.change,
          {.description = "Of the value, in percent of what it was, or in points of what is judged "
                          "by points; null: results are lost, or the value was 0."});
}

/// The fields of a nightly run, in either file.
template <typename Visitor>
void nightly_fields(Visitor& v, NightlyFile& nightly_run) {
  using namespace record_rules;
  NightlyFacts& facts = nightly_run.facts;
  v.field("nightly_run", facts.number,
          {.description = "Its index in the order, from 1.", .minimum = 0});
  v.field("started_utc", facts.started_utc, {.description = "ISO 8601."});
  v.field("ended_utc", facts.ended_utc);
  v.field("utc_offset_s", facts.utc_offset_s,
          {.description = "Of the local time then, seconds east of UTC."});
  v.field("commit", facts.commit,
          {.description = "Of what was under test; empty: not known.", .max_bytes = 64});
  v.field("repository", facts.repository, {.description = "Its address; may be empty."});
  v.field("command", facts.command, {.max_bytes = 1'000'000});
  v.field("provenance", nightly_run.provenance);
  v.field("host", facts.host);
  v.field("processor", facts.processor);
  v.field("cores", facts.cores, kCount);
  v.field("jobs", facts.jobs, kCount);
  v.field("reference", facts.reference,
          {.description = "The nightly run it was compared with.", .minimum = 0});
  v.field("pinned", facts.pinned);
  NightlyWord word = facts.verdict == NightlyVerdict::kPassed && !facts.reference
                         ? NightlyWord::kNotCompared
                         : static_cast<NightlyWord>(facts.verdict);
  v.field("verdict", word);
  v.field("findings", nightly_run.findings);
}

template <typename Visitor>
void fields(Visitor& v, NightlyFile& nightly_run) {
  v.file("mapproof.nightly_run",
         "nightly_run.json of mapproof nightly: where and when a nightly run was made, and what "
         "got worse.");
  nightly_fields(v, nightly_run);
}

inline EnumNames enum_names(NoteKind) { return names_up_to(NoteKind::kAccepted, "note_kind"); }

template <typename Visitor>
void fields(Visitor& v, NightlyNote& note) {
  v.type("note");
  v.field("nightly_run", note.nightly_run, {.minimum = 0});
  v.field("finding", note.finding,
          {.description = "Its index among those of the nightly run, from 1; 0: all.",
           .minimum = 0});
  v.field("kind", note.kind);
  v.field("text", note.text);
  v.field("written_utc", note.written_utc, {.description = "ISO 8601."});
}

/// The values of a series in an exported history.
struct ExportedSeries {
  SeriesId id = {};
  std::map<std::string, double> runs = {};
};

/// A study of a nightly run in an exported history.
struct ExportedStudy {
  NightlyStudy study = {};
  std::vector<ExportedSeries> scores = {};
  bool with_scores = true;
};

struct ExportedNightlyRun {
  NightlyFile nightly_run = {};
  std::vector<ExportedStudy> studies = {};
};

/// What `history --export json` writes.
struct ExportedHistory {
  std::vector<ExportedNightlyRun> nightly_runs = {};
  std::vector<NightlyNote> notes = {};
};

template <typename Visitor>
void fields(Visitor& v, FigureFile& file) {
  v.field("file", file.file);
  v.field("sha256", file.digest);
  v.field("bytes", file.bytes, {.minimum = 0});
}

template <typename Visitor>
void fields(Visitor& v, ExportedSeries& series) {
  v.type("series");
  v.field("sensor", series.id.sensor, {.description = "The setup."});
  v.field("method", series.id.method, {.description = "With all levels but steps."});
  v.field("step", series.id.step, {.description = "0: of the whole.", .minimum = 0});
  v.field("quantity", series.id.quantity);
  v.field("runs", series.runs,
          {.description = "Its values; null where none came out.", .nullable = true});
}

template <typename Visitor>
void fields(Visitor& v, ExportedStudy& exported) {
  using namespace record_rules;
  v.type("nightly_study");
  NightlyStudy& study = exported.study;
  v.field("name", study.name);
  v.field("kind", study.kind, {.description = "The schema of its study.json."});
  v.field("experiment_digest", study.experiment_digest,
          {.description = "SHA-256 of the experiment with its options."});
  v.field("runs", study.runs, kCount);
  v.field("seconds", study.seconds);
  v.field("peak_memory_mib", study.peak_memory_mib);
  std::vector<Quantity> quantities = study.quantities.declared();
  v.field("quantities", quantities,
          {.description = "What the study declares in addition to mapproof's dictionary."});
  const auto labels = [&](std::string_view key, const std::map<std::string, std::string>& of_ids,
                          std::string_view what) {
    std::vector<Label> all;
    for (const auto& [id, label] : of_ids) all.push_back({.id = id, .label = label});
    v.field(key, all, {.description = what});
  };
  labels("setups", study.labels.setups, "What the study calls them.");
  labels("methods", study.labels.methods,
         "What the study calls them; empty: they are mapproof's own.");
  v.field("figures", study.figures);
  v.field("scores", exported.scores, {.key = Key::kOptional, .written = exported.with_scores});
}

template <typename Visitor>
void fields(Visitor& v, ExportedNightlyRun& nightly_run) {
  v.type("nightly_run");
  nightly_fields(v, nightly_run.nightly_run);
  v.field("studies", nightly_run.studies);
}

template <typename Visitor>
void fields(Visitor& v, ExportedHistory& history) {
  v.file("mapproof.history", "Every value of every nightly run: mapproof history --export json.");
  v.field("nightly_runs", history.nightly_runs);
  v.field("notes", history.notes, {.description = "What people said of them, oldest first."});
}

/// Takes a text in pieces.
using TextSink = std::function<void(std::string_view)>;

/// Every value of every nightly run as CSV [rfc4180]: nightly run, started_utc, study, sensor,
/// method, step, quantity, run, value, and what setup and method are called; a value that is
/// missing is an empty cell. Takes the memory of one study of a nightly run. @throws IoError.
void export_history_csv(HistoryStore& history, const TextSink& write);

/// The same with facts, findings and studies as JSON (docs/schemas/history.schema.json). Takes the
/// memory of one nightly run. @throws IoError.
void export_history_json(HistoryStore& history, const TextSink& write);

/// Nightly runs with their facts, findings and studies, without the values of runs. @throws
/// IoError.
nlohmann::ordered_json history_json(HistoryStore& history);

/// The text of nightly_run.json (docs/schemas/nightly_run.schema.json).
std::string nightly_json(const NightlyRun& nightly_run);

/// One nightly run's facts and findings, for what holds them among others: without a schema.
nlohmann::ordered_json nightly_value(const NightlyFacts& facts,
                                     const std::vector<NightlyFinding>& findings);

/// What a person decided on one page of a history.
struct NightlyDecision {
  std::string target = {};  ///< "7.2": finding 2 of nightly run 7; "7": the nightly run.
  NoteKind decision = NoteKind::kNote;
  std::string text = {};
};

/// mapproof-decisions.json, which the index of a history saves.
struct NightlyDecisions {
  std::vector<NightlyDecision> decisions = {};
};

template <typename Visitor>
void fields(Visitor& v, NightlyDecision& decision) {
  v.type("decision");
  v.field("target", decision.target,
          {.description = "A nightly run, \"7\", or one of its findings, \"7.2\".",
           .max_bytes = 30});
  v.field("decision", decision.decision);
  v.field("text", decision.text,
          {.description = "Why; empty: what was said of it before is removed.",
           .max_bytes = 4000});
}

template <typename Visitor>
void fields(Visitor& v, NightlyDecisions& decisions) {
  v.file("mapproof.decisions",
         "Decisions on findings and nightly runs, saved by the index of a history: mapproof history "
         "--from.");
  v.field("decisions", decisions.decisions, {.max_items = 10'000});
}

/// A decision as a note. @param option  Is named in messages.
/// @throws InvalidInput for a target that is none, a text with hidden characters, and a finding that
///         is to be accepted by itself.
NightlyNote note_of(const NightlyDecision& decision, std::string_view option);

/// The notes of such a file. @throws IoError, InvalidInput that name the file.
std::vector<NightlyNote> parse_decisions(std::string_view text, const std::string& source);

}  // namespace mapproof
