#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "app/map/pipeline.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/not_finite.hpp"
#include "core/map_fit/map_fit.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/records/detections/mrclam.hpp"
#include "reports/sections/fit_section.hpp"

namespace mapproof {
namespace {

/// Pairs of detections times landmarks up to which landmark IDs are checked without being asked:
/// about a second.
constexpr double kCheapCheck = 6e5;
/// Landmarks of a map that is tested: a test holds several arrays of landmarks x landmarks.
constexpr Eigen::Index kMostTested = 5000;
constexpr double kMostHistory = 2e7;  ///< Entries of a long table that are tested.

bool is_cheap(const DetectionLog& log) {
  constexpr std::size_t kMostLandmarks = 60;
  if (log.names.size() > kMostLandmarks) return false;
  const auto pairs = static_cast<double>(scan_pairs(log).size());
  return pairs * static_cast<double>(log.names.size()) <= kCheapCheck;
}

/// Landmark IDs are checked where that costs little, unless a step before has done so, and not at
/// each update of an incremental map.
void check_cheaply(MapDraft& draft, const DetectionLog& log, const MapJob& job) {
  if (draft.association || job.incremental || !is_cheap(log)) return;
  draft.association = check_association(log);
}

/// The fit of the scans that a map of one sensor of an MRCLAM folder leaves out: range and bearing
/// are there, too.
Fit mrclam_fit(const std::string& path, const Fit& of_sensor, const Points& known_m) {
  const DetectionLog log = read_mrclam_detections(path).log;
  Fit of_pairs =
      range_bearing_fit(log, pair_map_of(log).embedding.coordinates, {.known_m = &known_m});
  Fit fit = of_sensor;
  if (fit.verdict == FitVerdict::kNotTestable) return of_pairs;
  for (const FitCause& cause : of_pairs.causes)
    if (cause.code == FitCode::kKnownLandmarksExchanged) {
      fit.causes.insert(fit.causes.begin(), cause);
      fit.verdict = FitVerdict::kDoesNotFit;
    }
  return fit;
}

/// The gravest of the fits of several sensors to one map. @param sources  In the rows of the map.
Fit joint_fit(const std::vector<ObservationSource>& sources, const Points& map,
              const Points& known_m) {
  Fit gravest{.verdict = FitVerdict::kNotTestable, .why = {FitMissing::kMetric}};
  for (const ObservationSource& source : sources) {
    const Fit one = history_fit(source.history, source.history.steps(), map, known_m);
    if (fit_rank(one.verdict).value_or(0.0) > fit_rank(gravest.verdict).value_or(0.0))
      gravest = one;
  }
  return gravest;
}

Fit fit_of(MapDraft& draft, const MapJob& job) {
  const Points& map = draft.result.record.estimate;
  const Points& known_m = draft.reference.positions_m;
  if (const auto* gone = std::get_if<NotKept>(&draft.observed))
    return {.verdict = FitVerdict::kNotTestable, .why = {gone->fit_lacks}};
  if (map.rows() > kMostTested && !job.is_range_bearing())
    return {.verdict = FitVerdict::kNotTestable, .why = {FitMissing::kSize}};
  if (const auto* scans = std::get_if<DetectionSource>(&draft.observed)) {
    const DetectionLog& log = scans->log;
    if (job.is_range_bearing()) {
      check_cheaply(draft, log, job);
      return range_bearing_fit(
          log, map,
          {.known_m = &known_m, .association = draft.association ? &*draft.association : nullptr});
    }
    if (static_cast<double>(log.steps) * static_cast<double>(log.names.size()) > kMostHistory)
      return {.verdict = FitVerdict::kNotTestable, .why = {FitMissing::kSize}};
    return history_fit(history_of(log, *sensor_named(job.sensor)), log.steps, map, known_m);
  }
  if (const auto* packed = std::get_if<PackedSource>(&draft.observed))
    return history_fit(packed->history.blocks(), draft.result.record.step, map, known_m);
  if (const auto* source = std::get_if<ObservationSource>(&draft.observed)) {
    const bool is_real = is_folder(source->path) && is_mrclam(source->path);
    const Fit fit = history_fit(source->history, draft.result.record.step, map, known_m,
                                is_real ? kMostKnownShareOfReal : kMostKnownShare);
    return is_real ? mrclam_fit(source->path, fit, known_m) : fit;
  }
  return joint_fit(std::get<std::vector<ObservationSource>>(draft.observed), map, known_m);
}

constexpr const char* kCheckIds =
    "--check-ids looks for landmark IDs that would explain the misfit; --repair-ids corrects them.";

/// Whether a cause of a misfit may be that landmark IDs are wrong.
bool doubts_ids(const Fit& fit) {
  constexpr FitCode kOfIds[] = {FitCode::kIdsExchanged,         FitCode::kWrongIds,
                                FitCode::kKnownLandmarkOff,     FitCode::kKnownLandmarksExchanged,
                                FitCode::kKnownLandmarksAtOdds, FitCode::kScatter};
  return std::ranges::any_of(fit.causes, [&](const FitCause& cause) {
    return std::ranges::find(kOfIds, cause.code) != std::end(kOfIds);
  });
}

MapDraft test_fit(MapDraft draft, const MapJob& job) {
  try {
    draft.result.fit = fit_of(draft, job);
  } catch (const InvalidInput& problem) {
    // The map is shown although a test cannot take its data.
    draft.result.fit = {.verdict = FitVerdict::kNotTestable, .why = {FitMissing::kNoiseModel}};
    draft.result.warnings.push_back(std::string("The fit was not tested: ") + problem.what());
  }
  for (FitCause& cause : draft.result.fit.causes) cause.figure = kFitSection;
  const bool may_check = job.is_range_bearing() && !job.incremental;
  if (may_check && !job.check_ids && !job.repair_ids && doubts_ids(draft.result.fit))
    draft.result.remarks.emplace_back(kCheckIds);
  return draft;
}

}  // namespace

const MapStep kFit{.take = test_fit, .figure = kFitSection};

}  // namespace mapproof
