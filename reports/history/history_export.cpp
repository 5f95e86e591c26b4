#include "reports/history/history_export.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/csv.hpp"
#include "core/base/errors.hpp"
#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"
#include "reports/history/shown_names.hpp"

namespace mapproof {
namespace {

using nlohmann::ordered_json;

/// What made a nightly run; nothing if another version wrote it in another way.
Provenance provenance_of(const NightFacts& facts) {
  try {
    return from_json_text<Provenance>(facts.provenance, "provenance");
  } catch (const IoError&) {
    return {};
  }
}

NightFile file_of(const NightFacts& facts, const std::vector<NightFinding>& findings) {
  return {.facts = facts, .provenance = provenance_of(facts), .findings = findings};
}

/// Puts what made a nightly run into its JSON as it was written at the time; text that is not JSON
/// stays text.
void put_provenance(ordered_json& night, const std::string& text) {
  ordered_json parsed = ordered_json::parse(text, nullptr, false);
  night["provenance"] = parsed.is_discarded() ? ordered_json(text) : std::move(parsed);
}

ExportedStudy exported(HistoryStore& history, int night, StudyNight study, bool with_scores) {
  ExportedStudy whole{.study = std::move(study), .with_scores = with_scores};
  if (!with_scores) return whole;
  for (const auto& [series, values] : history.scores(night, whole.study.name)) {
    ExportedSeries one{.id = series};
    for (const RunValue& run : values) one.runs[run.run] = run.value;
    whole.scores.push_back(std::move(one));
  }
  return whole;
}

}  // namespace

std::string history_csv(HistoryStore& history) {
  std::string text =
      "night,started_utc,study,sensor,method,step,quantity,run,value,sensor_label,method_label\r\n";
  for (const NightFacts& night : history.nights())
    for (const StudyNight& study : history.studies(night.number))
      for (const auto& [series, values] : history.scores(night.number, study.name)) {
        const std::string head =
            fmt::format("{},{},{},{},{},{},{},", night.number, csv_field(night.started_utc),
                        csv_field(study.name), csv_field(series.sensor), csv_field(series.method),
                        series.step, csv_field(series.quantity));
        const std::string labels =
            fmt::format(",{},{}\r\n", csv_field(shown_setup(study.labels, series.sensor)),
                        csv_field(shown_method(study.labels, series.method)));
        for (const RunValue& run : values)
          text += head + csv_field(run.run) + "," +
                  (std::isfinite(run.value) ? fmt::format("{}", run.value) : "") + labels;
      }
  return text;
}

std::string night_json(const Night& night) {
  return to_json_text(file_of(night.facts, night.findings));
}

ordered_json night_value(const NightFacts& facts, const std::vector<NightFinding>& findings) {
  ordered_json value = to_json_value(file_of(facts, findings));
  value.erase("schema");
  put_provenance(value, facts.provenance);
  return value;
}

ordered_json history_json(HistoryStore& history, bool with_scores) {
  ExportedHistory whole;
  for (const NightFacts& night : history.nights()) {
    ExportedNight& one = whole.nights.emplace_back();
    one.night = file_of(night, history.findings(night.number));
    for (StudyNight& study : history.studies(night.number))
      one.studies.push_back(exported(history, night.number, std::move(study), with_scores));
  }
  ordered_json value = to_json_value(whole);
  for (std::size_t i = 0; i < whole.nights.size(); ++i)
    put_provenance(value["nights"][i], whole.nights[i].night.facts.provenance);
  return value;
}

}  // namespace mapproof
