#include "reports/history/history_export.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/csv.hpp"
#include "core/json/json_text.hpp"
#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"
#include "reports/history/shown_names.hpp"

namespace mapproof {
namespace {

using nlohmann::ordered_json;

/// What made a nightly run; nothing if another version wrote it in another way.
Provenance provenance_of(const NightlyFacts& facts) {
  try {
    return from_json_text<Provenance>(facts.provenance, "provenance");
  } catch (const IoError&) {
    return {};
  }
}

NightlyFile file_of(const NightlyFacts& facts, const std::vector<NightlyFinding>& findings) {
  return {.facts = facts, .provenance = provenance_of(facts), .findings = findings};
}

/// Puts what made a nightly run into its JSON as it was written at the time; text that is not JSON
/// stays text.
void put_provenance(ordered_json& nightly_run, const std::string& text) {
  ordered_json parsed = ordered_json::parse(text, nullptr, false);
  nightly_run["provenance"] = parsed.is_discarded() ? ordered_json(text) : std::move(parsed);
}

ExportedStudy exported(HistoryStore& history, int nightly_run, NightlyStudy study,
                       bool with_scores) {
  ExportedStudy whole{.study = std::move(study), .with_scores = with_scores};
  if (!with_scores) return whole;
  for (const auto& [series, values] : history.scores(nightly_run, whole.study.name)) {
    ExportedSeries one{.id = series};
    for (const RunValue& run : values) one.runs[run.run] = run.value;
    whole.scores.push_back(std::move(one));
  }
  return whole;
}

/// A nightly run among others.
ordered_json nightly_run_json(HistoryStore& history, const NightlyFacts& facts, bool with_scores) {
  ExportedNightlyRun one{.nightly_run = file_of(facts, history.findings(facts.number))};
  for (NightlyStudy& study : history.studies(facts.number))
    one.studies.push_back(exported(history, facts.number, std::move(study), with_scores));
  ordered_json value = to_json_value(one);
  put_provenance(value, facts.provenance);
  return value;
}

}  // namespace

void export_history_csv(HistoryStore& history, const TextSink& write) {
  write(
      "nightly_run,started_utc,study,sensor,method,step,quantity,run,value,sensor_label,method_"
      "label\r\n");
  for (const NightlyFacts& nightly_run : history.nightly_runs())
    for (const NightlyStudy& study : history.studies(nightly_run.number)) {
      std::string text;
      for (const auto& [series, values] : history.scores(nightly_run.number, study.name)) {
        const std::string head = fmt::format(
            "{},{},{},{},{},{},{},", nightly_run.number, csv_field(nightly_run.started_utc),
            csv_field(study.name), csv_field(series.sensor), csv_field(series.method), series.step,
            csv_field(series.quantity));
        const std::string labels =
            fmt::format(",{},{}\r\n", csv_field(shown_setup(study.labels, series.sensor)),
                        csv_field(shown_method(study.labels, series.method)));
        for (const RunValue& run : values)
          text += fmt::format("{}{},{}{}", head, csv_field(run.run),
                              std::isfinite(run.value) ? fmt::format("{}", run.value) : "", labels);
      }
      write(text);
    }
}

std::string nightly_json(const NightlyRun& nightly_run) {
  return to_json_text(file_of(nightly_run.facts, nightly_run.findings));
}

ordered_json nightly_value(const NightlyFacts& facts, const std::vector<NightlyFinding>& findings) {
  ordered_json value = to_json_value(file_of(facts, findings));
  value.erase("schema");
  put_provenance(value, facts.provenance);
  return value;
}

void export_history_json(HistoryStore& history, const TextSink& write) {
  const std::string frame = json_text(to_json_value(ExportedHistory{.notes = history.notes()}));
  const std::string_view empty = "\"nightly_runs\": [";
  const std::size_t begin = frame.find(empty) + empty.size();
  write(std::string_view(frame).substr(0, begin));
  constexpr std::size_t kIndent = 4;
  std::string_view before = "\n", after;
  for (const NightlyFacts& facts : history.nightly_runs()) {
    const ordered_json one = nightly_run_json(history, facts, true);
    write(fmt::format("{}{:{}}{}", before, "", kIndent, json_element(one, kIndent)));
    before = ",\n";
    after = "\n  ";
  }
  write(after);
  write(std::string_view(frame).substr(begin));
}

ordered_json history_json(HistoryStore& history) {
  ordered_json value = to_json_value(ExportedHistory{.notes = history.notes()});
  for (const NightlyFacts& facts : history.nightly_runs())
    value["nightly_runs"].push_back(nightly_run_json(history, facts, false));
  return value;
}

NightlyNote note_of(const NightlyDecision& decision, std::string_view option) {
  constexpr std::size_t kLongest = 1000;
  NightlyNote note = parse_note_target(decision.target, option);
  note.kind = decision.decision;
  note.text = decision.text;
  if (printable(note.text, kLongest) != note.text)
    throw InvalidInput(fmt::format("{}: the text holds hidden characters or more than {}: \"{}\"",
                                   option, kLongest, printable(note.text, 40)));
  if (note.kind == NoteKind::kAccepted && note.finding > 0)
    throw InvalidInput(fmt::format(
        "{}: a nightly run is accepted as a whole: \"{}\"; a finding by itself can be known",
        option, note.nightly_run));
  return note;
}

std::vector<NightlyNote> parse_decisions(std::string_view text, const std::string& source) {
  std::vector<NightlyNote> notes;
  for (const NightlyDecision& decision : from_json_text<NightlyDecisions>(text, source).decisions)
    notes.push_back(note_of(decision, source));
  return notes;
}

}  // namespace mapproof
