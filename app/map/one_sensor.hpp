#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/map/data_association.hpp"
#include "app/map/data_association_check.hpp"
#include "app/map/joint_map.hpp"
#include "app/map/method_choice.hpp"
#include "app/map/missing_data.hpp"
#include "app/map/reference.hpp"
#include "core/embed/embedder.hpp"
#include "core/model/experiment.hpp"
#include "core/model/map_certainty.hpp"
#include "core/model/map_record.hpp"
#include "core/model/submaps.hpp"
#include "core/records/observations/observations.hpp"

namespace mapproof {

/// How a person's own observations are to be mapped.
struct MapOptions {
  MethodSetting setting;  ///< Without a parameter: the usual one of these data.
  bool choose = false;    ///< Choose method and parameter; `setting` is for where none gives a map.
  int steps = 0;          ///< The first so many observations; 0: all.
  AffineFit fit = AffineFit::kLeastDistances;
  bool drop_unseen = false;         ///< Map the others where a landmark was never observed.
  bool only_seen_together = false;  ///< See EmbedderOptions.
  MissingChoice missing;
  int submaps = 0;                ///< Most landmarks of a sub-map, 6 or more; 0: one map.
  std::optional<double> overlap;  ///< Share that a sub-map borrows, in [0, 0.8]; empty: the usual.
  int ellipse_replicates = 0;     ///< Draws for each landmark's ellipse; 0: none.
  /// Asked before anything is computed, of what is known of the map by then; may throw. Its setting
  /// lacks what is not known yet: a usual parameter.
  std::function<void(const MapRecord&)> begin = {};
};

/// A map and what has to be said about how it came to be.
struct MapResult {
  MapRecord record;
  std::vector<std::string> remarks;
  std::vector<std::string> warnings = {};  ///< What a person should know before trusting the map.
  std::optional<JoinedSubmaps> joined =
      {};  ///< What the map was joined from, in a frame of its own.
  std::vector<std::pair<std::string, std::string>> read;    ///< Facts of the observations.
  std::optional<MapCertainty> certainty = std::nullopt;     ///< If it was asked for.
  std::optional<MethodChoice> choice = std::nullopt;        ///< If the method was to be chosen.
  std::optional<JointMapResult> mixed = std::nullopt;       ///< If it is of several sensors.
  std::optional<EstimatedLabels> estimated = std::nullopt;  ///< If some were doubtful.
  std::vector<LabelFact> labels = {};  ///< What was found about them, if that was asked.
};

/// What is known of a map before it is made, beside the options and the reference.
struct BegunMap {
  std::string id = "map";
  MapOrigin origin;
  int step = 0;
  const std::vector<std::string>& names;
};

/// Calls options.begin with what is known of a map before it is made.
void begin_map(const MapOptions& options, const BegunMap& begun, const Reference& reference);

/// Maps observations, aligned to the anchors if there are any, scored if there is a truth.
///
/// A source that holds its own truth (MRCLAM) is aligned, without `anchors`, to the four landmarks
/// furthest out along the diagonals of the truth's extent.
/// @throws IoError naming file and line for anchors that cannot serve (fewer than three, on one
///         line, unknown, unobserved), a truth about other landmarks, landmarks never observed
///         (unless dropped or read from a log, where no row can be removed), K >= M, too few
///         landmarks. @throws InvalidInput as proximity_rule().
MapResult map_observations(const ObservationSource& source,
                           const std::optional<NamedPointsFile>& anchors,
                           const std::optional<NamedPointsFile>& truth, const MapOptions& options);

}  // namespace mapproof
