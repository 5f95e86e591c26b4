#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/detection_log.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/points.hpp"
#include "core/model/sensor.hpp"

namespace mapproof {

/// What scans showed, with what is needed to talk about the file that it came from.
struct DetectionSource {
  DetectionLog log;
  std::optional<Points> ground_truth_m;  ///< M x 2, if the source holds it; NaN rows: unknown.
  std::vector<std::string> remarks;      ///< What was dropped or assumed, a sentence each.
  std::vector<std::string> locations;    ///< M; where the file holds the landmark: "line 7".
  std::string path;                      ///< For errors: the file or folder that was read.
};

/// How a file of detections is to be understood.
struct DetectionFormat {
  AngleUnit unit = AngleUnit::kRadians;  ///< Where the file does not state it.
  /// What a column `value` holds; visibility: 1, seen.
  std::optional<Sensor> value = {};
  /// Seconds between time stamps of one scan, see ScanWindow; empty: found from the gaps.
  std::optional<double> scan_window_s = {};
};

/// How a CSV file holds observations.
enum class Layout {
  kAuto,  ///< kLong if the header names a landmark and a value, or what detections hold; else
          ///< kWide.
  kWide,  ///< One row per landmark, one column per step.
  kLong,  ///< One row per observation: step or time, landmark, value; a robot too, whose steps are
          ///< then its own.
};

/// A measurement without a landmark ID.
struct UnassociatedMeasurement {
  Eigen::Index step = 0;  ///< Column of the history.
  double number = 0.0;    ///< Step or time, as the file has it.
  double value = 0.0;     ///< As the history's; NaN: missing.
  std::size_t line = 0;
};

/// The landmark of such a measurement in a long table.
inline constexpr std::string_view kUnassociatedMark = "?";

/// A user's observations, with what is needed to talk about the file they came from.
struct ObservationSource {
  ObservationHistory history;
  std::optional<Points> ground_truth_m;  ///< M x 2, if the source holds it; NaN rows: unknown.
  std::vector<std::string> remarks;      ///< What was dropped or assumed, a sentence each.
  std::vector<std::string>
      locations;     ///< M; where the file holds the landmark: "line 7", "/values/6".
  std::string path;  ///< For errors: the file or folder that was read.
  /// Of a long table, in the order of its lines; they are not in the history.
  std::vector<UnassociatedMeasurement> unassociated = {};
};

/// Landmarks with known positions: anchors, or the ground truth.
struct NamedPoints {
  std::vector<std::string> names;      ///< M, all different.
  Points positions_m;                  ///< M x 2, finite.
  std::vector<std::string> locations;  ///< M; where the file holds the landmark: "line 7".
};

/// What one sensor observed of detections.
/// @throws IoError if that were more than 2e8 entries, or there is nothing of that kind.
ObservationSource observations_of(DetectionSource source, Sensor sensor);

}  // namespace mapproof
