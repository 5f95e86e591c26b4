#include "app/map/pipeline.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "app/map/alignment.hpp"
#include "app/map/option_table.hpp"
#include "app/map/scan_sizes.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/out_of_memory.hpp"
#include "core/base/text/words.hpp"
#include "core/map_fit/map_fit.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/records/observations/grid_table.hpp"
#include "core/records/observations/input_kind.hpp"
#include "reports/sections/fit_section.hpp"

namespace mapproof {
namespace {

// Read.

ObservationSource read_values(const MapJob& job, std::optional<Sensor> sensor) {
  return job.source ? read_observations(*job.source, sensor, job.table_format())
                    : read_observations(job.path, sensor, job.table_format());
}

DetectionSource read_scans(const MapJob& job, std::optional<Sensor> value) {
  TableFormat format = job.table_format();
  format.value = value;
  return job.source ? read_detections(*job.source, format) : read_detections(job.path, format);
}

std::vector<ObservationSource> read_sensors(const MapJob& job, std::optional<Sensor> sensor) {
  std::vector<ObservationSource> sources = {read_values(job, sensor)};
  TableFormat format = job.table_format();
  format.columns = job.with_columns;
  for (std::size_t k = 0; k < job.with.size(); ++k)
    sources.push_back(read_observations(job.with[k], sensor_named(job.with_sensor[k]), format));
  for (const ObservationSource& source : sources)
    if (!source.unassociated.empty())
      throw IoError(source.path, fmt::format("line {}", source.unassociated.front().line),
                    "a measurement without a landmark ID: not with --with");
  return sources;
}

/// Whether a table may be mapped without an array of landmarks times steps: no step asks for one.
bool may_be_long(const MapJob& job) {
  const bool asks_for_array = job.missing != MapJob().missing || job.submaps > 0 ||
                              job.judges_ids() || !job.uncertain_ids.empty() ||
                              job.chooses_method() || job.ellipse_replicates > 0 ||
                              job.table.is_grid() || job.source == nullptr;
  if (asks_for_array) return false;
  const TableFormat format = job.table_format();
  // A list of what was seen may be short for its landmarks and steps.
  return is_large_long_table(*job.source, format) ||
         (has_references(job.setting.method) && !is_json(*job.source) &&
          is_detections(*job.source, format));
}

/// Entries from which a table stays packed: an array of them takes 160 MB, and as much again in
/// the steps.
constexpr double kPackedEntries = 2e7;

/// A table of landmarks and steps; other forms have their values in an array.
Observed read_table(const MapJob& job, std::optional<Sensor> sensor) {
  const TableFormat format = job.table_format();
  if (!job.source || !sensor || format.scan_window_s || !is_grid_table(*job.source, format))
    return read_values(job, sensor);
  PackedSource source = read_grid(*job.source, *sensor, format);
  const PackedHistory& history = source.history;
  const double entries =
      static_cast<double>(history.landmarks()) * static_cast<double>(history.steps);
  if (entries < kPackedEntries) return unpacked(source);
  return source;
}

Observed read(const MapJob& job) {
  const std::optional<Sensor> sensor = job.sensor.empty() ? std::nullopt : sensor_named(job.sensor);
  if (!job.with.empty()) return read_sensors(job, sensor);
  if (job.is_range_bearing()) return read_scans(job, std::nullopt);
  if (sensor && may_be_long(job)) return read_scans(job, sensor);
  Observed observed = read_table(job, sensor);
  MapJob known = job;
  known.sensor = std::visit(
      [](const auto& source) -> std::string {
        if constexpr (requires { source.history.sensor; })
          return std::string(name(source.history.sensor));
        else
          return "";
      },
      observed);
  require_compatible(known);
  return observed;
}

// Check.

/// "480 GB".
std::string gigabytes(double bytes) { return fmt::format("{:.2g} GB", bytes / 1e9); }

/// Refuses a map for which there is not enough memory.
void require_memory(const std::string& path, const HistoryExtent& history, const MapJob& job) {
  if (job.is_range_bearing() || job.submaps > 0) return;
  const double needed = needed_bytes(job.setting.method, history, job.embedder);
  const double available = available_memory_bytes();
  if (needed <= available) return;
  const bool is_large = has_references(job.setting.method);
  throw IoError(
      path,
      fmt::format("{} of {} landmarks needs {} of memory, and {} are available: {}",
                  info(job.setting.method).label, history.landmarks, gigabytes(needed),
                  gigabytes(available),
                  is_large
                      ? "give fewer --references"
                      : "use --method landmark-isomap, which needs " +
                            gigabytes(needed_bytes(Method::kLandmarkIsomap, history, job.embedder))));
}

void require_three(const std::string& path, std::ptrdiff_t landmarks) {
  if (landmarks < 3)
    throw IoError(path, fmt::format("{}; a map needs 3 or more", counted(landmarks, "landmark")));
}

/// Landmarks with nothing observed of them: an error at the first, or a remark.
/// @param source  An ObservationSource or PackedSource, whose landmarks `history` holds.
template <typename Source>
void check_unseen(const Source& source, const HistoryBlocks& history, bool is_log,
                  const MapJob& job, MapDraft& draft) {
  const std::vector<Eigen::Index>& unseen = draft.landmarks.unseen;
  if (unseen.empty()) return;
  const auto first = static_cast<std::size_t>(unseen.front());
  if (!job.drop_unseen && !is_log)
    throw IoError(source.path, source.locations[first],
                  fmt::format("landmark {} is never observed{}; remove it, or pass --drop-unseen "
                              "to map the others",
                              quoted_name(history.names()[first]),
                              history.sensor() == Sensor::kVisibility ? " (no 1 in its row)" : ""));
  draft.result.remarks.push_back(
      fmt::format("{} of {} landmarks were never observed and are left out.", unseen.size(),
                  history.landmarks()));
}

/// Steps, landmarks and missing entries of the values of one sensor.
/// @return The steps to use.
Eigen::Index check_history(const HistoryBlocks& history, const std::string& path, double missing,
                           const MapJob& job, MapDraft& draft) {
  const Eigen::Index steps = job.steps > 0 ? job.steps : history.steps();
  require_steps(job, path, history.steps());
  require_three(path, history.landmarks());
  draft.landmarks.path = path;
  draft.landmarks.names = history.names();
  draft.landmarks.unseen = unseen_landmarks(history, steps);
  require_neighbours(job, draft.landmarks);
  HistoryExtent extent{.sensor = history.sensor(),
                       .landmarks = history.landmarks(),
                       .steps = steps,
                       .misses_any = missing > 0.0};
  if (job.setting.method == Method::kLpca) extent = extent_of(history, steps);
  require_memory(path, extent, job);
  draft.result.record =
      begin_record(FromSensor{history.sensor(), job.setting}, history.names(), steps);
  const double entries =
      static_cast<double>(history.landmarks()) * static_cast<double>(history.steps());
  draft.result.read = {{"Landmarks", std::to_string(history.landmarks())},
                       {"Steps used", fmt::format("{} of {}", steps, history.steps())},
                       {"Missing entries", fmt::format("{:.1f} %", 100.0 * missing / entries)}};
  if (history.sensor() == Sensor::kVisibility || missing > 0.0)
    add_scan_sizes(scan_sizes(history), draft.result);
  return steps;
}

void check_values(const ObservationSource& source, const MapJob& job, MapDraft& draft) {
  const auto missing = static_cast<double>(source.history.values.array().isNaN().count());
  check_history(source.history, source.path, missing, job, draft);
  draft.landmarks.ground_truth_m = source.ground_truth_m;
  check_unseen(source, source.history, source.ground_truth_m.has_value(), job, draft);
}

void check_packed(const PackedSource& source, const MapJob& job, MapDraft& draft) {
  const PackedHistory& history = source.history;
  check_history(history.blocks(), source.path, history.missing, job, draft);
  check_unseen(source, history.blocks(), false, job, draft);
}

/// Reports what was understood of the files.
Observed reported(Observed observed, const MapJob& job) {
  if (!job.understood) return observed;
  if (const auto* source = std::get_if<ObservationSource>(&observed))
    job.understood(source->path, summary_of(*source));
  else if (const auto* packed = std::get_if<PackedSource>(&observed))
    job.understood(packed->path, summary_of(*packed));
  else if (const auto* scans = std::get_if<DetectionSource>(&observed))
    job.understood(scans->path, summary_of(*scans, job.sensor));
  else
    for (const ObservationSource& one : std::get<std::vector<ObservationSource>>(observed))
      job.understood(one.path, summary_of(one));
  return observed;
}

/// Leaves the first scans, as many as the job asks for.
void check_scans(DetectionSource& source, const MapJob& job, MapDraft& draft) {
  DetectionLog& log = source.log;
  require_three(source.path, std::ssize(log.names));
  const int scans = log.steps;
  require_steps(job, source.path, scans);
  if (job.steps > 0) {
    std::erase_if(log.detections, [&](const Detection& seen) { return seen.step >= job.steps; });
    log.steps = job.steps;
  }
  draft.landmarks = {.path = source.path,
                     .names = log.names,
                     .unseen = unseen_in(log),
                     .ground_truth_m = source.ground_truth_m};
  if (!job.is_range_bearing() && !draft.landmarks.unseen.empty())
    throw IoError(source.path,
                  fmt::format("{} of {} landmarks are not in the first {} scans",
                              draft.landmarks.unseen.size(), log.names.size(), log.steps));
  if (!job.is_range_bearing())
    require_memory(source.path, extent_of(log, *sensor_named(job.sensor)), job);
  MapOrigin origin = FromPairs{};
  if (!job.is_range_bearing()) origin = FromSensor{*sensor_named(job.sensor), job.setting};
  draft.result.record = begin_record(std::move(origin), log.names, log.steps);
  draft.result.read = {{"Landmarks", std::to_string(log.names.size())},
                       {"Steps used", fmt::format("{} of {}", log.steps, scans)},
                       {"Detections", std::to_string(log.detections.size())}};
  add_scan_sizes(scan_sizes(log), draft.result);
}

/// Steps, landmarks and K; what was observed, in numbers.
MapDraft check(MapDraft draft, const MapJob& job) {
  if (const auto* source = std::get_if<ObservationSource>(&draft.observed))
    check_values(*source, job, draft);
  else if (const auto* packed = std::get_if<PackedSource>(&draft.observed))
    check_packed(*packed, job, draft);
  else if (auto* scans = std::get_if<DetectionSource>(&draft.observed))
    check_scans(*scans, job, draft);
  draft.setting = job.setting;
  return draft;
}

// Reference.

/// Anchors and ground truth in the rows of the landmarks.
MapDraft refer(MapDraft draft, const MapJob& job) {
  draft.reference = reference_of(draft.landmarks, job.known_anchors, job.known_ground_truth,
                                 draft.result.remarks);
  return draft;
}

// Distances, and their embedding.

void embed_blocks(const HistoryBlocks& history, const MapJob& job, MapDraft& draft) {
  take_embedding(draft,
                 embed_history(history, draft.result.record.step, draft.setting, job.embedder));
}

/// By other distances than the usual ones, if a step before chose such.
void embed_values(const ObservationSource& source, const MapJob& job, MapDraft& draft) {
  if (!draft.distances.of_map) return embed_blocks(source.history, job, draft);
  DistanceNotes notes;
  HistoryEmbedder embedder(source.history, draft.result.record.step, job.embedder,
                           draft.distances.noting(notes));
  if (!draft.setting.parameter) draft.setting = embedder.usual_setting(draft.setting.method);
  take_embedding(draft, embedder.embed(draft.setting), notes);
}

void embed_long_table(const DetectionSource& source, const MapJob& job, MapDraft& draft) {
  take_embedding(
      draft, embed_detected(source.log, *sensor_named(job.sensor), draft.setting, job.embedder));
}

void embed_pairs(const DetectionSource& source, MapDraft& draft) {
  const PairMap map = pair_map_of(source.log);
  take_embedding(draft, map.embedding);
  const std::size_t M = source.log.names.size();
  draft.result.read.emplace_back("Measured pairs",
                                 fmt::format("{} of {}", map.pairs.size(), M * (M - 1) / 2));
}

/// What the approximation is made of.
void add_references(MapDraft& draft, const MapJob& job) {
  if (!has_references(draft.setting.method)) return;
  const auto M = std::ssize(draft.result.record.names);
  const std::ptrdiff_t references = draft.setting.method == Method::kLandmarkIsomap
                                        ? job.embedder.landmark_isomap.references
                                        : job.embedder.landmark_mvu.references;
  draft.result.read.emplace_back("Reference landmarks",
                                 fmt::format("{} of {}", std::min(references, M), M));
}

/// Embeds the distances as a whole, unless a step before has embedded them otherwise.
MapDraft embed(MapDraft draft, const MapJob& job) {
  if (!draft.is_embedded) {
    if (const auto* source = std::get_if<ObservationSource>(&draft.observed))
      embed_values(*source, job, draft);
    else if (const auto* packed = std::get_if<PackedSource>(&draft.observed))
      embed_blocks(packed->history.blocks(), job, draft);
    else if (const auto* scans = std::get_if<DetectionSource>(&draft.observed))
      job.is_range_bearing() ? embed_pairs(*scans, draft) : embed_long_table(*scans, job, draft);
  }
  add_references(draft, job);
  std::visit(
      [&](auto& origin) {
        if constexpr (requires { origin.setting; }) origin.setting = draft.setting;
      },
      draft.result.record.origin);
  return draft;
}

// Align, score, explain.

/// Whether the map is in metres before anything ties it to a frame.
bool is_metric(const MapRecord& record) {
  return std::holds_alternative<FromPairs>(record.origin) ||
         std::holds_alternative<FromRanges>(record.origin);
}

MapDraft align_to_reference(MapDraft draft, const MapJob& job) {
  draft.frame = align(draft.result, draft.reference,
                      {.affine = job.affine_fit(),
                       .is_metric = is_metric(draft.result.record),
                       .is_rigid = job.is_rigid()});
  return draft;
}

/// The head of the report, and warnings about the frame.
MapDraft explain(MapDraft draft, const MapJob& job) {
  MapResult& map = draft.result;
  const MapRecord& record = map.record;
  map.facts = {{"Sensor", sensor_label(record)}};
  map.facts.insert(map.facts.end(), map.read.begin(), map.read.end());
  map.facts.emplace_back("Method", method_label(record));
  if (record.anchors.empty()) {
    map.facts.emplace_back("Anchors", "none");
  } else {
    std::string names;
    for (const Eigen::Index row : record.anchors)
      names += (names.empty() ? "" : ", ") + record.names[static_cast<std::size_t>(row)];
    map.facts.emplace_back(
        "Anchors", names + (job.anchors.empty() ? " (the furthest out along the diagonals)" : ""));
    map.facts.emplace_back(job.is_rigid() ? "Fit to the anchors" : "Affine fit to the anchors",
                           job.fit);
  }
  FrameCheck check = check_frame(record);
  for (std::string& warning : check.warnings) map.warnings.push_back(std::move(warning));
  for (FitCause& test : check.tests) test.figure = kFitSection;
  map.fit = with_tests(std::move(map.fit), std::move(check.tests));
  return draft;
}

constexpr MapStep kCheck{check}, kReference{refer}, kEmbedding{embed},
    kAlignment{align_to_reference}, kExplanation{explain};

/// A capability is deleted with its file, its line here and its options.
constexpr std::array kSteps = {
    &kIdCheck,          // Landmark IDs that contradict one another; what moved.
    &kDataAssociation,  // Measurements without a landmark ID.
    &kCheck,
    &kCommonLandmarks,  // Several sensors: the landmarks of all files.
    &kReference,
    &kMissingData,   // Distances where entries are missing.
    &kMethodChoice,  // --method auto.
    &kSubmaps,       // Embeddings other than of the whole map of one sensor.
    &kJointMap,
    &kEmbedding,
    &kFit,          // Whether the data fit the map, in its own frame.
    &kAlignment,    // And the score.
    &kUncertainty,  // Ellipses.
    &kExplanation,
};
constexpr auto kFirstSolver = std::ranges::find(kSteps, &kMissingData);
constexpr auto kLast = std::ranges::find(kSteps, &kFit);
static_assert(kFirstSolver < kLast && kLast < kSteps.end());

using StepIterator = decltype(kSteps)::const_iterator;

MapDraft take_steps(StepIterator first, StepIterator last, MapDraft draft, const MapJob& job) {
  for (; first != last; ++first) draft = (*first)->take(std::move(draft), job);
  return draft;
}

}  // namespace

std::span<const MapStep* const> map_steps() { return kSteps; }

MapDraft begin_map(const MapJob& job) {
  MapDraft draft{.observed = reported(read(job), job)};
  if (const auto* source = std::get_if<ObservationSource>(&draft.observed))
    draft.result.remarks = source->remarks;
  else if (const auto* packed = std::get_if<PackedSource>(&draft.observed))
    draft.result.remarks = packed->remarks;
  else if (const auto* scans = std::get_if<DetectionSource>(&draft.observed))
    draft.result.remarks = scans->remarks;
  return take_steps(kSteps.begin(), kFirstSolver, std::move(draft), job);
}

MapResult finish_map(MapDraft draft, const MapJob& job) {
  draft = take_steps(kFirstSolver, kLast, std::move(draft), job);
  return last_steps(std::move(draft), job).result;
}

ProximityRule DistanceRule::noting(DistanceNotes& notes) const {
  if (!of_map) return {};
  return [&notes, rule = of_map](const ObservationHistory& history, Eigen::Index steps) {
    NotedProximities noted = rule(history, steps);
    for (const Status& status : noted.notes.statuses)
      if (std::ranges::find(notes.statuses, status) == notes.statuses.end())
        notes.statuses.push_back(status);
    if (notes.remarks.empty()) notes.remarks = std::move(noted.notes.remarks);
    if (noted.notes.completed) notes.completed = noted.notes.completed;
    return std::move(noted.proximities);
  };
}

MapRecord begin_record(MapOrigin origin, std::vector<std::string> names, Eigen::Index step) {
  MapRecord record;
  record.id = std::holds_alternative<FromSensors>(origin) ? "joint" : "map";
  record.origin = std::move(origin);
  record.step = static_cast<int>(step);
  record.names = std::move(names);
  return record;
}

MapDraft last_steps(MapDraft draft, const MapJob& job) {
  return take_steps(kLast, kSteps.end(), std::move(draft), job);
}

void hold_array(MapDraft& draft) {
  if (const auto* packed = std::get_if<PackedSource>(&draft.observed))
    draft.observed = unpacked(*packed);
}

void take_embedding(MapDraft& draft, const Embedding& embedding, const DistanceNotes& notes) {
  MapResult& result = draft.result;
  MapRecord& record = result.record;
  record.estimate = embedding.coordinates;
  record.statuses = notes.statuses;
  record.statuses.insert(record.statuses.end(), embedding.statuses.begin(),
                         embedding.statuses.end());
  if (notes.completed)
    for (Status& status : record.statuses)
      if (status.code == StatusCode::kDistancesCompleted) status = *notes.completed;
  record.certificate = embedding.certificate;
  result.remarks.insert(result.remarks.end(), notes.remarks.begin(), notes.remarks.end());
  draft.is_embedded = true;
}

void require_neighbours(const MapJob& job, const MappedLandmarks& landmarks) {
  const auto M = landmarks.landmarks();
  const double K = job.setting.parameter.value_or(0.0);
  if (on_graph(job.setting.method) && K >= static_cast<double>(M))
    throw IoError(landmarks.path,
                  fmt::format("K = {:g} needs more than {:g} landmarks; there are {}", K, K, M));
}

void require_steps(const MapJob& job, const std::string& path, Eigen::Index steps) {
  if (job.steps > steps)
    throw IoError(path, fmt::format("--steps {}: it holds {} observations", job.steps, steps));
}

}  // namespace mapproof
