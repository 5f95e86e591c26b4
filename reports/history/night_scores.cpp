#include "reports/history/night_scores.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/base/files.hpp"
#include "core/base/sha256.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_text.hpp"
#include "core/records/studies/study_store.hpp"
#include "core/topics/study_kind.hpp"

namespace mapproof {
namespace {

/// The number of steps; 0 if the level is not a whole number that is one.
int step_of(const Level& level) {
  const auto* steps = std::get_if<double>(&level.value);
  const bool is_step = steps != nullptr && *steps >= 0.0 &&
                       *steps <= std::numeric_limits<int>::max() && *steps == std::floor(*steps);
  return is_step ? static_cast<int>(*steps) : 0;
}

SeriesId series_of(const Result& row) {
  SeriesId series{.sensor = row.at.setup, .method = row.method, .quantity = row.quantity};
  for (const Level& level : row.at.levels)
    if (level.factor == kStepsFactor)
      series.step = step_of(level);
    else
      series.method += " " + level.factor + "=" + level_text(level);
  if (!row.subject.empty()) series.method += " of " + row.subject;
  return series;
}

void add_sessions(StudyNight& night, const std::vector<Session>& sessions) {
  for (const Session& session : sessions) {
    night.seconds = night.seconds.value_or(0.0) + session.seconds;
    if (session.peak_memory_mib)
      night.peak_memory_mib =
          std::max(night.peak_memory_mib.value_or(0.0), *session.peak_memory_mib);
  }
}

}  // namespace

Scores scores_of(const Results& results, const std::vector<Result>& seconds) {
  Scores scores;
  for (const std::vector<Result>* rows : {&results.rows, &seconds})
    for (const Result& row : *rows)
      if (results.quantities.at(row.quantity).nightly != NightlyRule::kNone)
        scores[series_of(row)].push_back({row.run, row.group, row.value});
  for (auto& [series, values] : scores) std::ranges::sort(values, {}, &RunValue::run);
  return scores;
}

std::string order_digest(const std::string& study_json, const std::string& source) {
  JsonDocument document = parse_json(study_json, source);
  document.root.erase("provenance");
  return sha256_hex(json_text(nlohmann::ordered_json(document.root)));
}

StudyNight read_study_night(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path head = folder / "study.json";
  StudyNight night{.name = name, .order_digest = order_digest(read_file(head), head.string())};
  StudyContents contents = read_study_contents(folder, {.seconds = true});
  night.kind = contents.kind;
  night.draws_groups = contents.draws_groups;
  night.labels = std::move(contents.labels);
  night.runs = static_cast<int>(contents.runs.size());
  night.scores = scores_of(contents.results, contents.seconds);
  night.quantities = std::move(contents.results.quantities);
  add_sessions(night, read_sessions(folder));
  return night;
}

}  // namespace mapproof
