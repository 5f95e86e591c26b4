#include "reports/history/nightly_scores.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/base/files/files.hpp"
#include "core/base/sha256.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_document.hpp"
#include "core/json/json_text.hpp"
#include "core/records/studies/study_store.hpp"
#include "core/studies/study_kind.hpp"

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
  if (!row.subject.empty()) series.method += " of " + row.subject.get();
  return series;
}

bool is_same_series(const Result& a, const Result& b) {
  return a.at == b.at && a.method == b.method && a.quantity == b.quantity && a.subject == b.subject;
}

void add_sessions(NightlyStudy& nightly_run, const std::vector<Session>& sessions) {
  for (const Session& session : sessions) {
    nightly_run.seconds = nightly_run.seconds.value_or(0.0) + session.seconds;
    if (session.peak_memory_mib)
      nightly_run.peak_memory_mib =
          std::max(nightly_run.peak_memory_mib.value_or(0.0), *session.peak_memory_mib);
  }
}

}  // namespace

Scores scores_of(const Results& results, const std::vector<Result>& seconds) {
  Scores scores;
  for (const std::vector<Result>* rows : {&results.rows, &seconds}) {
    for (auto first = rows->begin(); first != rows->end();) {
      const auto end = std::find_if(
          first, rows->end(), [&](const Result& row) { return !is_same_series(*first, row); });
      if (results.quantities.at(first->quantity).nightly != NightlyRule::kNone) {
        std::vector<RunValue>& of_series = scores[series_of(*first)];
        const std::size_t size = of_series.size() + static_cast<std::size_t>(end - first);
        if (size > of_series.capacity()) of_series.reserve(std::max(size, 2 * of_series.size()));
        for (auto row = first; row != end; ++row)
          of_series.push_back({row->run, row->group, row->value});
      }
      first = end;
    }
  }
  for (auto& [series, values] : scores) std::ranges::sort(values, {}, &RunValue::run);
  return scores;
}

std::string experiment_digest(const std::string& study_json, const std::string& source) {
  const JsonDocument document = parse_json(study_json, source);
  schema_of(document.cursor());  // An object, and of a form.
  nlohmann::json root = document.tree();
  root.erase("provenance");
  return sha256_hex(json_text(nlohmann::ordered_json(root)));
}

NightlyStudy read_nightly_study(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path head = folder / "study.json";
  NightlyStudy nightly_run{.name = name,
                           .experiment_digest = experiment_digest(read_file(head), head.string())};
  StudyContents contents = read_study_contents(folder, {.seconds = true});
  nightly_run.kind = contents.kind;
  nightly_run.draws_groups = contents.draws_groups;
  nightly_run.labels = std::move(contents.labels);
  nightly_run.runs = static_cast<int>(contents.runs.size());
  nightly_run.scores = scores_of(contents.results, contents.seconds);
  nightly_run.quantities = std::move(contents.results.quantities);
  add_sessions(nightly_run, read_sessions(folder));
  return nightly_run;
}

}  // namespace mapproof
