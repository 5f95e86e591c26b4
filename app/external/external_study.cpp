#include "app/external/external_study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "app/map/map_folder.hpp"
#include "app/study/folder_report.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/slug.hpp"
#include "core/base/text/words.hpp"
#include "core/experiment/external_input.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/records/maps/map_json.hpp"
#include "core/records/studies/results_of.hpp"
#include "core/records/studies/results_study_json.hpp"
#include "core/records/studies/results_table.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/records/studies/study_store.hpp"
#include "core/records/studies/timings_jsonl.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::array kScores = {"mpe_m", "moe_percent", "mpe_all_fitted_m",
                                "moe_unmirrored_percent"};

/// Adds the scores of a map under the condition, run and group that the study's own have; those of
/// a map that there is not are lost.
void add_rows(const ExternalMap& map, std::vector<Result>& rows) {
  const std::optional<Score> score = map.map ? map.map->score : std::nullopt;
  const auto add = [&](const char* quantity, double Score::*value) {
    rows.push_back({.at = condition(std::string(name(map.sensor)),
                                    {{std::string(kStepsFactor), static_cast<double>(map.steps)}}),
                    .method = map.method,
                    .quantity = quantity,
                    .run = slug(map.run),
                    .group = fmt::format("layout-{}", map.run.layout),
                    .value = score ? (*score).*value : kNaN});
  };
  add("mpe_m", &Score::mpe_m);
  add("moe_percent", &Score::moe_percent);
  add("mpe_all_fitted_m", &Score::mpe_all_fitted_m);
  add("moe_unmirrored_percent", &Score::moe_unmirrored_percent);
}

/// Errors of maps over the checkpoints alone.
bool is_score(const Result& row) {
  return std::ranges::find(kScores, row.quantity.get()) != kScores.end() &&
         row.at.levels.size() == 1 && row.at.levels->front().factor == kStepsFactor;
}

/// The mean MPE of each method of one sensor at its last checkpoint; infinite where it lost one.
std::map<std::string, double> last_errors(const std::vector<Result>& rows,
                                          const std::string& setup) {
  double last = 0.0;
  for (const Result& row : rows)
    if (row.at.setup == setup && is_score(row))
      last = std::max(last, std::get<double>(row.at.levels->front().value));
  std::map<std::string, std::pair<double, int>> sums;
  for (const Result& row : rows) {
    if (row.at.setup != setup || !is_score(row) || row.quantity != kScores.front() ||
        std::get<double>(row.at.levels->front().value) != last)
      continue;
    auto& [sum, count] = sums[row.method];
    sum += std::isfinite(row.value) ? row.value : kInfinity;
    ++count;
  }
  std::map<std::string, double> means;
  for (const auto& [method, sum] : sums) means[method] = sum.first / sum.second;
  return means;
}

/// The study's own rows; of a method with a parameter the best value for the sensor, unless all are
/// asked for.
std::vector<Result> rows_of_study(const Results& results, bool all) {
  std::vector<Result> rows;
  std::set<std::string> setups;
  for (const Result& row : results.rows)
    if (is_score(row)) setups.insert(row.at.setup);
  for (const std::string& setup : setups) {
    const auto family = [&](const std::string& method) {
      const auto found = results.families.find(method);
      return found == results.families.end() ? method : found->second.name;
    };
    std::map<std::string, std::pair<double, std::string>> best;
    for (const auto& [method, error] : last_errors(results.rows, setup)) {
      const auto [at, is_new] = best.emplace(family(method), std::pair(error, method));
      if (!is_new && error < at->second.first) at->second = {error, method};
    }
    for (const Result& row : results.rows)
      if (row.at.setup == setup && is_score(row) &&
          (all || best.at(family(row.method)).second == row.method))
        rows.push_back(row);
  }
  return rows;
}

MethodLabels labels_of_study(const Study& study, const std::vector<Result>& rows) {
  std::set<std::string> used;
  for (const Result& row : rows) used.insert(row.method);
  MethodLabels labels;
  for (const SensorStudy& sensor : study.experiment.sensors)
    for (const MethodSetting& setting : settings_of(sensor))
      if (used.erase(slug(setting)) > 0) labels.push_back({slug(setting), label(setting)});
  return labels;
}

/// What was lost, a sentence per method and reason.
std::string lost_text(const std::vector<ExternalMap>& maps) {
  std::map<std::pair<std::string, std::string>, std::pair<int, std::string>> losses;
  for (const ExternalMap& map : maps) {
    if (map.failure.empty()) continue;
    auto& [count, example] = losses[{map.method, map.failure}];
    if (count++ == 0) example = checkpoint_id(map.run, map.sensor, map.steps);
  }
  std::string text;
  constexpr std::size_t kMostSentences = 10;
  std::size_t sentences = 0;
  for (const auto& [what, loss] : losses) {
    if (++sentences > kMostSentences) {
      text += fmt::format(" And {} more reasons.", losses.size() - kMostSentences);
      break;
    }
    text += fmt::format(" {}: {} lost: {} (first: {}).", what.first, counted(loss.first, "map"),
                        what.second, loss.second);
  }
  return text;
}

ResultsStudy results_with(const Study& study, const std::vector<ExternalMap>& maps,
                          const MethodLabels& methods, const ExternalOutputs& outputs) {
  ResultsStudy result;
  result.results.are_repeats = true;
  result.results.rows = rows_of_study(results_of(study), outputs.all);
  result.methods = labels_of_study(study, result.results.rows);
  for (const Label& method : methods) result.methods.push_back(method);
  for (const ExternalMap& map : maps) add_rows(map, result.results.rows);
  for (const char* score : kScores) result.quantities.emplace_back(score);
  for (const SensorStudy& sensor : study.experiment.sensors) {
    const std::string setup(name(sensor.sensor.sensor));
    result.setups.push_back({setup, capitalised(setup)});
  }
  result.factors.push_back({std::string(kStepsFactor), "observations"});
  sort_results(result.results);
  result.name =
      outputs.name.empty() ? slug_of("study-" + study.experiment.name + "-external") : outputs.name;
  result.title = study.experiment.title + ", with methods of others";
  return result;
}

/// The maps of the first run at the last checkpoint of each sensor.
void write_maps(const Study& study, const std::vector<ExternalMap>& maps, const OutputFolder& out) {
  for (const SensorStudy& sensor : study.experiment.sensors)
    for (const ExternalMap& map : maps)
      if (map.map && map.sensor == sensor.sensor.sensor && map.steps == sensor.checkpoints.back() &&
          map.run == maps.front().run)
        out.write(fs::path("maps") /
                      fmt::format("{}-{}-{}.csv", slug(map.run), name(map.sensor), map.method),
                  map_csv(*map.map));
}

std::string text_of(const ResultsStudy& study, const MethodLabels& methods,
                    const std::vector<ExternalMap>& maps) {
  std::string text;
  for (const Label& setup : study.setups) {
    const std::map<std::string, double> errors = last_errors(study.results.rows, setup.id);
    for (const Label& method : methods) {
      const auto error = errors.find(method.id);
      const auto lost = std::ranges::count_if(maps, [&](const ExternalMap& map) {
        return map.method == method.id && name(map.sensor) == setup.id && !map.failure.empty();
      });
      text += fmt::format("{}, {}: MPE {}{}\n", setup.id, method.label,
                          error != errors.end() && std::isfinite(error->second)
                              ? error_text(error->second)
                              : std::string("not known"),
                          lost > 0 ? fmt::format(", {} lost", counted(lost, "map")) : "");
    }
  }
  return text;
}

}  // namespace

fs::path folder_of(const ObservedCheckpoint& checkpoint) {
  return fs::path(slug(checkpoint.run)) / std::string(name(checkpoint.sensor)) /
         fmt::format("{}", checkpoint.steps);
}

ExternalMap scored_external_map(const Experiment& experiment, const ObservedCheckpoint& checkpoint,
                                const std::string& method, const Points& coordinates) {
  if (coordinates.rows() != checkpoint.ground_truth_m.rows())
    throw InvalidInput("a map has one row per landmark");
  Embedding embedding;
  embedding.coordinates = coordinates;
  ScoredMap scored =
      scored_map(embedding, checkpoint.ground_truth_m, checkpoint.anchors, experiment.affine_fit);
  ExternalMap map{.method = method,
                  .run = checkpoint.run,
                  .sensor = checkpoint.sensor,
                  .steps = checkpoint.steps};
  if (!scored.score) map.failure = "the map cannot be aligned to the anchors";
  map.map = map_record({.id = fmt::format("{}-{}", slug(checkpoint.run), method),
                        .origin = {},
                        .step = checkpoint.steps,
                        .names = checkpoint.history.names,
                        .ground_truth_m = checkpoint.ground_truth_m,
                        .anchors = checkpoint.anchors},
                       std::move(scored));
  return map;
}

Study read_mapping_study(const fs::path& folder) {
  require_study(folder);
  if (study_schema(folder) != "mapproof.study")
    throw IoError(folder.string(), "holds no study of the mapping methods");
  return read_study(folder);
}

void check_external_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / kStudyFile, error))
    return check_result_folder(folder, kStudyFile, "comparison");
  refuse_links_out(folder);
  if (!is_results_study(folder))
    throw IoError(folder.string(), "holds another study; choose another --out");
}

int write_external_study(const Study& study, const std::vector<ExternalMap>& maps,
                         const MethodLabels& methods, const ExternalOutputs& outputs,
                         const Invocation& invocation) {
  const Templates page = load_templates(outputs.templates);
  ResultsStudy results = results_with(study, maps, methods, outputs);
  const std::string lost = lost_text(maps);
  results.question = fmt::format(
      "The methods of the study \"{}\"{} and methods of others map the same observations, "
      "are aligned to the same anchors and scored alike. Maps of others were imported as files.{}",
      study.experiment.name,
      outputs.all ? "" : ", each with the parameter of the lowest mean MPE at the end,", lost);
  results.compared_with = "the true positions of the landmarks, and each other";
  const LockedFolder folder(outputs.out);
  const OutputFolder& out = folder.files();
  out.remove("maps");
  out.write(kStudyFile, results_study_json(results));
  out.write(kResultsFile, results_csv(results.results.rows));
  write_maps(study, maps, out);
  const Session session{
      .command = invocation.command,
      .started_utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))),
      .host = invocation.disclosure.host(),
      .jobs = outputs.jobs,
      .peak_memory_mib = {}};
  out.write(kTimingsFile, timings_header() + session_line(session));
  if (!lost.empty()) invocation.console.warning(lost.substr(1));
  const fs::path path =
      write_report(read_folder_report(outputs.out, std::nullopt, invocation.command),
                   {page, outputs.jobs, invocation.disclosure}, folder.lock());
  const auto failed =
      std::ranges::count_if(maps, [](const ExternalMap& map) { return !map.failure.empty(); });
  invocation.console.result(
      text_of(results, methods, maps) + path.string() + "\n",
      {{"study", outputs.out}, {"report", path.string()}, {"maps", maps.size()}, {"lost", failed}});
  return failed == std::ssize(maps) ? kNo : kDone;
}

void add_external_outputs(CLI::App& app, ExternalOutputs& outputs) {
  add_out_option(app, outputs.out, "Folder for the new study: records, figures and report")
      ->required();
  app.add_option("--name", outputs.name,
                 "Of the new study; without: that of STUDY and \"-external\"");
  app.add_flag("--all", outputs.all,
               "Every parameter of the study's own methods, not the best of each");
  app.add_option("--templates", outputs.templates,
                 "Folder whose templates replace the embedded ones")
      ->check(names_folder());
  add_jobs_option(app, outputs.jobs);
  group_options(app, {{"Output", {"--name", "--all", "--templates"}}});
}

}  // namespace mapproof
