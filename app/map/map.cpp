#include "app/commands.hpp"

#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "app/input_streams.hpp"
#include "app/map/arguments.hpp"
#include "app/map/incremental.hpp"
#include "app/map/option_table.hpp"
#include "app/map/outputs.hpp"
#include "app/map/pipeline.hpp"
#include "app/map/reference.hpp"
#include "app/map/stop_rules.hpp"
#include "app/understood.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/parallel.hpp"
#include "core/records/detections/mrclam.hpp"
#include "core/records/tables/respelling.hpp"

namespace mapproof {
namespace {

/// The method, and its parameter if one was given. @throws InvalidInput for an unknown method, or a
/// parameter out of its bounds.
MethodSetting chosen_setting(const MapJob& job) {
  if (job.chooses_method()) return {Method::kIsomap, std::nullopt};
  const Method method = *method_of(job);
  const std::optional<GivenParameter> given = given_parameter(job);
  if (!given) return {method, std::nullopt};
  const ParameterInfo& parameter = *info(method).parameter;
  if (!(given->value >= parameter.minimum && given->value <= parameter.maximum) ||
      (parameter.integer && given->value != std::floor(given->value)))
    throw InvalidInput(fmt::format(
        "{}: {} = {:g} is not {} from {:g} to {:g}", given->option, parameter.shown, given->value,
        parameter.integer ? "an integer" : "a number", parameter.minimum, parameter.maximum));
  return {method, given->value};
}

/// The methods' own options. SMACOF's stop rules: near the minimum of the stress, unless it is to
/// stop early.
void set_method_options(MapJob& job) {
  job.embedder.smacof = near_minimum();
  if (job.references)
    job.embedder.landmark_isomap.references = job.embedder.landmark_mvu.references =
        *job.references;
  if (!job.stress_fall) return;
  const bool is_weighted = method_of(job) == Method::kSmacofKnn;
  if (!is_weighted) job.embedder.smacof.relative_fall = *job.stress_fall;
  if (is_weighted || job.chooses_method())
    job.embedder.smacof_knn = {.relative_fall = *job.stress_fall,
                               .max_iterations = near_minimum().max_iterations};
}

/// Opens the observations, and takes the sensor of detections from their columns if none is given.
/// @throws IoError if they cannot be read.
void open_observations(MapJob& job) {
  if (is_folder(job.path)) {
    // A method of one sensor takes its visibility, see read_observations().
    if (job.sensor.empty() && job.may_choose_method() && is_mrclam(job.path))
      job.sensor = kRangeBearing;
    return;
  }
  job.source = std::make_shared<ByteSource>(job.path);
  const TableFormat format = job.table_format();
  if (!job.sensor.empty() || format.layout != Layout::kAuto || !is_detections(*job.source, format))
    return;
  const MeasuredColumns measured = measured_in(*job.source, format);
  job.sensor = measured.range && measured.bearing ? std::string(kRangeBearing)
               : measured.range                   ? std::string(name(Sensor::kRange))
               : measured.bearing                 ? std::string(name(Sensor::kBearing))
                                                  : std::string(name(Sensor::kVisibility));
}

/// Reads anchors and ground truth, and finds out which named columns they and the files of other
/// sensors have; the observations must have the rest.
void read_known_positions(MapJob& job) {
  job.known_anchors = read_points(job.anchors, job.columns);
  job.known_ground_truth = read_points(job.ground_truth, job.columns);
  job.with_columns = job.columns;
  for (const std::string& with : job.with) mark_columns_of_file(with, job.columns);
  if (!job.source) return;
  require_columns(*job.source, job.columns);
  mark_columns(*job.source, job.with_columns);
}

/// Completes a parsed job: unless the map is incremental, opens the file and detects its sensor if
/// none is given; checks which options go together, and method and parameter; reads anchors and
/// ground truth.
/// @throws InvalidInput for what does not go together, or an unknown method or parameter; IoError
///         if a file cannot be read.
void complete(MapJob& job) {
  if (job.sensor.empty() && job.method == kPairs) job.sensor = kRangeBearing;
  job.columns = column_names(job.table.columns);
  // A stream cannot be opened before it is read.
  if (!job.incremental) open_observations(job);
  require_known_method(job);
  require_compatible(job);
  if (!job.is_range_bearing()) job.setting = chosen_setting(job);
  set_method_options(job);
  read_known_positions(job);
}

/// Refuses, before anything is computed, a folder that holds another map. Whether a map of pairs
/// can be fitted to what is known turns out with the map. @throws IoError.
void check_folder_of(const MapDraft& draft, const MapJob& job) {
  if (job.force || job.is_range_bearing()) return;
  MapRecord begun = draft.result.record;
  begun.anchors = draft.reference.anchors;
  if (draft.reference.has_ground_truth || !begun.anchors.empty())
    begun.ground_truth_m = draft.reference.positions_m;
  check_may_become(job.out, begun, job.chooses_method() || job.may_choose_method());
}

int map_once(MapJob job, const MapOutput& location, const Invocation& invocation) {
  nlohmann::ordered_json inputs = nlohmann::ordered_json::array();
  job.understood = [&](const std::string& path, const InputSummary& summary) {
    invocation.console.info(understood_line(path, summary));
    inputs.push_back(understood_json(summary));
  };
  std::optional<ProgressLine> working(std::in_place, invocation.console, "mapping");
  MapResult map;
  parallel_for(job.jobs, 1, [&](std::size_t) {
    MapDraft draft = begin_map(job);
    check_folder_of(draft, job);
    map = finish_map(std::move(draft), job);
  });
  working.reset();
  map.members.push_back({"inputs", std::move(inputs)});
  for (const auto& [what, value] : map.read)
    invocation.console.detail(fmt::format("{}: {}: {}", input_name(job.path), what, value));
  for (const std::string& remark : map.remarks) invocation.console.info(remark);
  for (const std::string& warning : map.warnings) invocation.console.warning(warning);
  const std::string undrawn = write_map(
      job.force ? MapFolder(location.out) : MapFolder(location.out, map.record), location, map);
  if (!undrawn.empty()) invocation.console.warning(undrawn);
  return report_map(map, location, invocation);
}

int run_map(MapJob job, const Invocation& invocation) {
  const MapOutput location{.out = job.out,
                           .observations = job.path,
                           .command = invocation.command,
                           .page = load_templates(job.templates),
                           .jobs = job.jobs,
                           .disclosure = invocation.disclosure};
  check_map_folder(job.out);
  std::vector<std::string> inputs = {job.path, job.anchors, job.ground_truth};
  inputs.insert(inputs.end(), job.with.begin(), job.with.end());
  refuse_shared_streams(inputs);
  complete(job);
  if (!job.incremental) return map_once(std::move(job), location, invocation);
  return write_incremental(job, job.is_range_bearing() ? incremental_pairs : incremental_values,
                           location, invocation);
}

}  // namespace

Action map_command(CLI::App& app) {
  auto job = std::make_shared<MapJob>();
  app.description("Map your own observations");
  app.footer(
      "Examples:\n"
      "  mapproof map bearings.csv --sensor bearing --anchors anchors.csv --out out/map\n"
      "  mapproof map seen.csv --sensor visibility --method lpca --out out/shape\n"
      "  mapproof map MRCLAM_Dataset2 --out out/pairs\n"
      "  mapproof map MRCLAM_Dataset2 --method isomap -K 5 --out out/mrclam\n"
      "  mapproof map seen.csv --sensor visibility --with bearings.csv --with-sensor bearing --out "
      "out/joint\n\n"
      "OBSERVATIONS is one of\n"
      "  wide CSV: one row per landmark, one column per step; an empty cell or NA is missing\n"
      "  transposed CSV: one row per step, one column per landmark\n"
      "  long CSV: the columns step, landmark, value\n"
      "  detections: the columns step or time, landmark, range, bearing\n"
      "  the columns time, landmark alone: what was seen when\n"
      "  JSON: mapproof.observations, mapproof.detections, lines or a list of objects\n"
      "  NumPy's .npy and .npz; bearing-range edges of g2o\n"
      "  a folder of MRCLAM files\n"
      "It may be compressed by gzip or xz. A pipe or standard input (-) serves wherever a file "
      "does.\n"
      "Bearings are relative to the robot's heading, counter-clockwise (to the left), in radians;\n"
      "see --degrees and --bearing-convention for others.\n"
      "Range and bearing of one scan measure distances: their map is in metres without anchors.\n"
      "The exit code is 1 if there is no map; the last line and the report state why.\n");
  add_map_options(app, *job);
  complete_help(app);
  return [job](const Invocation& invocation) { return run_map(*job, invocation); };
}

}  // namespace mapproof
