#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "core/model/certificate.hpp"
#include "core/model/method.hpp"
#include "core/model/points.hpp"
#include "core/model/score.hpp"
#include "core/model/sensor.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// Which landmarks are anchors.
enum class AnchorPlacement {
  kWalls,    ///< Those nearest the corners; beyond four, nearest points spread along the walls.
  kRandom,   ///< Any, drawn for each layout.
  kCluster,  ///< Those nearest one corner.
};

/// The name used in files: "walls", "random", "cluster".
std::string_view name(AnchorPlacement placement);

/// The frame that a map's coordinates are in.
enum class Frame {
  kGroundTruth,  ///< Metres, aligned to the anchors by an affine map.
  kSimilarity,  ///< No anchors, or none that could tie the map to the ground truth: the shape alone
                ///< is meaningful; translation, rotation, scale and reflection are arbitrary.
};

/// The name used in files: "ground truth", "similarity".
std::string_view name(Frame frame);

/// An embedding of what one sensor observed.
struct FromSensor {
  Sensor sensor = Sensor::kVisibility;
  MethodSetting setting;

  bool operator==(const FromSensor&) const = default;
};

/// A joint map of what several sensors observed of the same landmarks.
struct FromSensors {
  std::vector<Sensor> sensors;  ///< Two or more.
  MethodSetting setting;        ///< Of the map that the joint one begins with.

  bool operator==(const FromSensors&) const = default;
};

/// A map of the distances of pairs that range and bearing together measured, by SMACOF.
struct FromPairs {
  bool operator==(const FromPairs&) const = default;
};

/// A range-only map: the factors of squared ranges that were taken together [boots2013].
struct FromRanges {
  bool operator==(const FromRanges&) const = default;
};

/// What a map was made of, and how.
using MapOrigin = std::variant<FromSensor, FromSensors, FromPairs, FromRanges>;

/// What files and the command line call the sensor of FromSensors, sensor and method of FromPairs,
/// and the method of FromRanges.
inline constexpr std::string_view kMixed = "mixed";
inline constexpr std::string_view kRangeBearing = "range-bearing";
inline constexpr std::string_view kPairs = "pairs";
inline constexpr std::string_view kSpectralMap = "spectral";

/// One map, of a study or of a user's observations.
struct MapRecord {
  std::string id;  ///< Slash-separated, e.g. "layout-1-pose-2/bearing/isomap-K9/2000".
  MapOrigin origin;
  int step = 0;  ///< Number of observations used, N.
  Frame frame = Frame::kGroundTruth;
  std::vector<std::string> names;  ///< M.
  Points estimate;                 ///< M x 2, m if frame is kGroundTruth; NaN rows: not mapped.
  std::optional<Points> ground_truth_m;  ///< M x 2; NaN rows: ground truth unknown.
  std::vector<Eigen::Index> anchors;     ///< Rows whose true position was given.
  std::vector<Status> statuses;
  std::optional<Certificate> certificate;  ///< Of a semidefinite program on user data.
  std::optional<Score> score;  ///< If there is a ground truth and the map could be scored.
};

/// Whether the position of that landmark was given.
bool is_anchor(const MapRecord& map, Eigen::Index row);

/// The method and its parameter; null for a map of pairs or a range-only one.
const MethodSetting* setting_of(const MapRecord& map);

/// In files and results: "bearing", "mixed", "range-bearing".
std::string_view sensor_name(const MapRecord& map);

/// In files: "isomap", "pairs", "spectral".
std::string_view method_name(const MapRecord& map);

/// For readers: "bearing", "visibility and bearing", "range and bearing".
std::string sensor_label(const MapRecord& map);

/// For readers: "ISOMAP, K = 6", "joint map begun by ISOMAP, K = 6", "SMACOF of measured pairs".
std::string method_label(const MapRecord& map);

}  // namespace mapproof
