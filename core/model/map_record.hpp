#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/model/certificate.hpp"
#include "core/model/method.hpp"
#include "core/model/points.hpp"
#include "core/model/score.hpp"
#include "core/model/sensor.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// The frame that a map's coordinates are in.
enum class Frame {
  kTruth,       ///< Metres, aligned to the anchors by an affine map.
  kSimilarity,  ///< No anchors, or none that could tie the map to the truth: shape alone; place,
                ///< turn, scale and mirror are arbitrary.
};

/// The name used in files: "truth", "similarity".
std::string_view name(Frame frame);

/// The frame of that name; empty if there is none.
std::optional<Frame> frame_named(std::string_view name);

/// What files and the command line call a map of measured pairs: its sensor and its method.
inline constexpr std::string_view kRangeBearing = "range-bearing";
inline constexpr std::string_view kPairs = "pairs";

/// One map, of a study or of a person's own observations.
struct MapRecord {
  std::string id;  ///< Slash-separated, e.g. "layout-1-pose-2/bearing/isomap-K9/2000".
  Sensor sensor = Sensor::kVisibility;
  MethodSetting setting;
  int step = 0;  ///< Number of observations used, N.
  Frame frame = Frame::kTruth;
  std::vector<std::string> names;     ///< M.
  Points estimate;                    ///< M x 2, m if frame is kTruth; NaN rows: not mapped.
  std::optional<Points> truth_m;      ///< M x 2; NaN rows: truth unknown.
  std::vector<Eigen::Index> anchors;  ///< Rows whose true position was given.
  std::vector<Status> statuses;
  std::optional<Certificate> certificate;  ///< Of a semidefinite program on a person's own data.
  std::optional<Score> score;              ///< If there is a truth and the map could be scored.
  /// Made of the distances that range and bearing together measured: `sensor` and `setting` say
  /// nothing.
  bool of_pairs = false;
};

/// Whether the position of that landmark was given.
bool is_anchor(const MapRecord& map, Eigen::Index row);

/// What was mapped, in words: "range and bearing", or the sensor's name.
std::string observed(const MapRecord& map);

/// How: "SMACOF of measured pairs", or the setting's label.
std::string made_by(const MapRecord& map);

}  // namespace mapproof
