#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "reports/history/history_store.hpp"

namespace mapproof {

/// Every value of every night as CSV [rfc4180]: night, started_utc, study, sensor, method, step,
/// quantity, run, value, and what setup and method are called; a value that is missing is an empty
/// cell. @throws IoError.
std::string history_csv(HistoryStore& history);

/// Nights with their facts, findings and studies (docs/schemas/history.schema.json), without the
/// values of runs; with them if asked. @throws IoError.
nlohmann::ordered_json history_json(HistoryStore& history, bool with_scores);

/// The text of night.json (docs/schemas/night.schema.json).
std::string night_json(const Night& night);

/// One night's facts and findings, for what holds them among others: without a schema.
nlohmann::ordered_json night_value(const NightFacts& facts,
                                   const std::vector<NightFinding>& findings);

}  // namespace mapproof
