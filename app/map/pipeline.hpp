#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/map/arguments.hpp"
#include "app/map/map_result.hpp"
#include "app/map/reference.hpp"
#include "core/association/association_check.hpp"
#include "core/embed/embedder.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/observations/observations.hpp"
#include "core/uncertainty/history_uncertainty.hpp"

namespace mapproof {

/// Observations that an incremental map has taken in and does not keep.
struct NotKept {
  FitMissing fit_lacks;  ///< Why the fit cannot be tested without them.
};

/// What was observed, in the form that the map is made from: values of one sensor, as an array or,
/// of a large table, packed (see hold_array()); detections, of
/// range and bearing, or of a table of one sensor that is too long for an array of landmarks times
/// steps; values of several sensors, in common rows once they are checked; or nothing any more.
using Observed = std::variant<ObservationSource, PackedSource, DetectionSource,
                              std::vector<ObservationSource>, NotKept>;

/// Remarks and warnings on the distances of a history.
struct DistanceNotes {
  std::vector<Status> statuses;
  std::vector<std::string> remarks;
  /// Of pairs without a distance, if it is not that they share no step.
  std::optional<Status> completed;
};

struct NotedProximities {
  Proximities proximities;
  DistanceNotes notes;
};

/// How distances are computed from observations; empty: by proximities().
struct DistanceRule {
  std::function<NotedProximities(const ObservationHistory&, Eigen::Index steps)> of_map = {};
  ProximityRule of_others = {};  ///< The same for candidates and resamples, without the notes.

  /// The rule of the map as an embedder takes it.
  /// @param notes  Gets the statuses of all calls, and the remarks of the first one. It has to
  ///               outlive the rule.
  ProximityRule noting(DistanceNotes& notes) const;
};

/// A map in the making: what the steps before have found out.
struct MapDraft {
  Observed observed;
  MappedLandmarks landmarks = {};
  Reference reference = {};
  DistanceRule distances = {};
  MethodSetting setting = {};  ///< Without a parameter: the usual one of these data.
  bool is_embedded = false;    ///< The result's record holds an estimate.
  std::optional<AssociationCheck> association =
      {};                       ///< Of the log as it is mapped, if it was made.
  UncertaintyFrame frame = {};  ///< That other maps of the landmarks are brought to.
  MapResult result = {};
};

/// A step of the pipeline: it takes a map in the making and returns it with what the step adds. It
/// returns it as it is where nothing asks for the step.
struct MapStep {
  MapDraft (*take)(MapDraft draft, const MapJob& job);  ///< @throws IoError, InvalidInput.
  std::string_view figure = {};                         ///< The id of the figure that it may add,
  std::string_view file = {};                           ///< and the name of the file.
};

/// What `map` is capable of besides a plain map, one file each. Their order among the steps is in
/// pipeline.cpp.
extern const MapStep kIdCheck, kDataAssociation, kCommonLandmarks, kMissingData, kMethodChoice,
    kSubmaps, kJointMap, kFit, kUncertainty;

/// All steps, in their order.
std::span<const MapStep* const> map_steps();

/// Reads what a person observed, and takes the steps up to the reference: of the record, only what
/// an embedding adds is not known then.
///
/// A source that holds its own ground truth (MRCLAM) is aligned, without anchors, to the four
/// landmarks furthest out along the diagonals of the ground truth's extent.
/// @throws IoError naming file and line for what the readers refuse; anchors that cannot serve
///         (fewer than three, on one line, unknown, unobserved), a ground truth about other
///         landmarks, landmarks never observed (unless dropped or read from a log, where no row can
///         be removed), K >= M, too few landmarks. @throws InvalidInput as require_compatible().
MapDraft begin_map(const MapJob& job);

/// Takes the other steps.
MapResult finish_map(MapDraft draft, const MapJob& job);

/// The record of a map of which nothing is known but what it is made of; its id is "joint" for
/// several sensors, else "map".
/// @param step  Number of observations used.
MapRecord begin_record(MapOrigin origin, std::vector<std::string> names, Eigen::Index step);

/// The steps after the embedding, which an incremental map takes at each update: fit, alignment,
/// score, uncertainty, explanation.
/// @param draft  With an embedding, and a reference in its rows. @throws IoError, InvalidInput.
MapDraft last_steps(MapDraft draft, const MapJob& job);

/// Makes an array of packed values, for a step that needs all of them at once.
void hold_array(MapDraft& draft);

/// Takes an embedding, its statuses after those of the distances, and its certificate.
void take_embedding(MapDraft& draft, const Embedding& embedding, const DistanceNotes& notes = {});

/// @throws IoError if the job's K is not below the number of landmarks.
void require_neighbours(const MapJob& job, const MappedLandmarks& landmarks);

/// @throws IoError if the job asks for more steps than there are.
void require_steps(const MapJob& job, const std::string& path, Eigen::Index steps);

}  // namespace mapproof
