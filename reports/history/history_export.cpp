#include "reports/history/history_export.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/base/csv.hpp"

namespace mapproof {
namespace {

using nlohmann::ordered_json;

ordered_json optional_value(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

/// What made a night, as an object again; text that is none stays text.
ordered_json provenance_object(const std::string& text) {
  ordered_json parsed = ordered_json::parse(text, nullptr, false);
  return parsed.is_discarded() ? ordered_json(text) : parsed;
}

ordered_json study_value(HistoryStore& history, int night, const StudyNight& study,
                         bool with_scores) {
  ordered_json value{{"name", study.name},
                     {"kind", study.kind},
                     {"order_digest", study.order_digest},
                     {"runs", study.runs},
                     {"seconds", optional_value(study.seconds)},
                     {"peak_memory_mib", optional_value(study.peak_memory_mib)},
                     {"quantities", ordered_json::array()},
                     {"figures", ordered_json::array()}};
  for (const Quantity& quantity : study.quantities.declared())
    value["quantities"].push_back({{"id", quantity.id},
                                   {"label", quantity.label},
                                   {"unit", quantity.unit},
                                   {"better", name(quantity.better)}});
  for (const FigureFile& file : study.figures)
    value["figures"].push_back(
        {{"file", file.file}, {"sha256", file.digest}, {"bytes", file.bytes}});
  if (!with_scores) return value;
  value["scores"] = ordered_json::array();
  for (const auto& [series, values] : history.scores(night, study.name)) {
    ordered_json runs = ordered_json::object();
    for (const RunValue& run : values)
      runs[run.run] = std::isfinite(run.value) ? ordered_json(run.value) : ordered_json(nullptr);
    value["scores"].push_back({{"sensor", series.sensor},
                               {"method", series.method},
                               {"step", series.step},
                               {"quantity", series.quantity},
                               {"runs", std::move(runs)}});
  }
  return value;
}

}  // namespace

std::string history_csv(HistoryStore& history) {
  std::string text = "night,started_utc,study,sensor,method,step,quantity,run,value\r\n";
  for (const NightFacts& night : history.nights())
    for (const StudyNight& study : history.studies(night.number))
      for (const auto& [series, values] : history.scores(night.number, study.name)) {
        const std::string head =
            fmt::format("{},{},{},{},{},{},{},", night.number, csv_field(night.started_utc),
                        csv_field(study.name), csv_field(series.sensor), csv_field(series.method),
                        series.step, csv_field(series.quantity));
        for (const RunValue& run : values)
          text += head + csv_field(run.run) + "," +
                  (std::isfinite(run.value) ? fmt::format("{}", run.value) : "") + "\r\n";
      }
  return text;
}

ordered_json night_value(const NightFacts& facts, const std::vector<NightFinding>& findings) {
  ordered_json value{{"night", facts.number},
                     {"started_utc", facts.started_utc},
                     {"ended_utc", facts.ended_utc},
                     {"command", facts.command},
                     {"provenance", provenance_object(facts.provenance)},
                     {"host", facts.host},
                     {"processor", facts.processor},
                     {"cores", facts.cores},
                     {"jobs", facts.jobs},
                     {"reference", nullptr},
                     {"pinned", facts.pinned},
                     {"verdict", verdict_word(facts)},
                     {"findings", ordered_json::array()}};
  if (facts.reference) value["reference"] = *facts.reference;
  for (const NightFinding& finding : findings)
    value["findings"].push_back({{"study", finding.study},
                                 {"rule", name(finding.rule)},
                                 {"subject", finding.subject},
                                 {"quantity", finding.quantity},
                                 {"since", finding.since},
                                 {"sentence", finding.sentence}});
  return value;
}

ordered_json history_json(HistoryStore& history, bool with_scores) {
  ordered_json nights = ordered_json::array();
  for (const NightFacts& night : history.nights()) {
    ordered_json value = night_value(night, history.findings(night.number));
    value["studies"] = ordered_json::array();
    for (const StudyNight& study : history.studies(night.number))
      value["studies"].push_back(study_value(history, night.number, study, with_scores));
    nights.push_back(std::move(value));
  }
  return {{"schema", {{"name", "mapproof.history"}, {"version", 1}}}, {"nights", nights}};
}

}  // namespace mapproof
