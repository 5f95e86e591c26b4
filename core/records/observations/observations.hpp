#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/byte_source.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/points.hpp"
#include "core/model/sensor.hpp"
#include "core/records/observations/detections.hpp"

namespace mapproof {

/// How a CSV file holds observations.
enum class Layout {
  kAuto,  ///< kLong if the header names a landmark and a value, or what detections hold; else
          ///< kWide.
  kWide,  ///< One row per landmark, one column per step.
  kLong,  ///< One row per observation: step or time, landmark, value; a robot too, whose steps are
          ///< then its own.
};

/// A reading of which nobody says whose it is.
struct UnlabelledReading {
  Eigen::Index step = 0;  ///< Column of the history.
  double number = 0.0;    ///< Step or time, as the file has it.
  double value = 0.0;     ///< As the history's; NaN: missing.
  std::size_t line = 0;
};

/// The landmark of such a reading in a long table.
inline constexpr std::string_view kUnlabelledMark = "?";

/// A person's own observations, with what is needed to talk about the file they came from.
struct ObservationSource {
  ObservationHistory history;
  std::optional<Points> truth_m;     ///< M x 2, if the source holds it; NaN rows: unknown.
  std::vector<std::string> remarks;  ///< What was dropped or assumed, a sentence each.
  std::vector<std::string> places;   ///< M; where a landmark stands: "line 7", "/values/6".
  std::string path;                  ///< For errors: the file or folder that was read.
  /// Of a long table, in the order of its lines; they are not in the history.
  std::vector<UnlabelledReading> unlabelled = {};
};

/// Observations from CSV (wide or long) or mapproof's JSON. Of detections (see detections.hpp),
/// what one kind of sensor saw.
///
/// Rows without any observation are kept: whether they are trouble is for the caller to say.
///
/// @param kind  What the values are. Required for CSV; must agree with a JSON file.
/// @param unit  Of bearings in CSV; JSON says it itself.
/// @throws IoError naming file and place if the source cannot be read as such, breaks the bounds of
///         its kind (0 or 1; |rad| <= 2 pi; 0 <= m <= 1e6), repeats a name or a (step, landmark),
///         or exceeds 5000 landmarks, 1e6 steps or 2e8 entries.
/// @note Linear in the size of the file; about 0.2 s for 50 x 100,000 entries.
ObservationSource read_observations(ByteSource& source, std::optional<Sensor> kind,
                                    Layout layout = Layout::kAuto,
                                    AngleUnit unit = AngleUnit::kRadians);

/// The same of a file or stream, or of a folder of MRCLAM [leung2011], then of visibility if `kind`
/// is empty.
ObservationSource read_observations(const std::filesystem::path& path, std::optional<Sensor> kind,
                                    Layout layout = Layout::kAuto,
                                    AngleUnit unit = AngleUnit::kRadians);

/// What one kind of sensor saw of detections.
/// @throws IoError if that were more than 2e8 entries, or there is nothing of that kind.
ObservationSource observations_of(DetectionSource source, Sensor sensor);

/// mapproof's own JSON (mapproof.observations), NaN as null.
std::string observations_json(const ObservationHistory& history);

}  // namespace mapproof
