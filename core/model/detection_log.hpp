#pragma once

#include <compare>
#include <string>
#include <vector>

#include "core/base/not_finite.hpp"
#include "core/model/observation_history.hpp"

namespace mapproof {

/// One landmark in one scan: what was measured of it.
struct Detection {
  int step = 0;               ///< Which scan, from 0.
  int landmark = 0;           ///< Row among the log's names.
  double range_m = kNaN;      ///< NaN: not measured.
  double bearing_rad = kNaN;  ///< Relative to the heading,
                              ///< counter-clockwise; NaN: not.
};

/// Which scan it was among the scans of several robots: one robot's at one step or time.
struct ScanKey {
  int robot = 0;     ///< In the order in which they come; 0 where robots are not distinguished.
  double key = 0.0;  ///< Step or time, finite.

  auto operator<=>(const ScanKey&) const = default;
};

/// What scans showed of M landmarks, range and bearing of each together: a history as sparse as the
/// scans are. Who measured, and from where, is not in it: scans of several robots are pooled.
struct DetectionLog {
  std::vector<std::string> names = {};  ///< Of the landmarks, M of them, all different.
  /// Ascending by step, then landmark; no (step, landmark) twice.
  std::vector<Detection> detections = {};
  int steps = 0;                         ///< Scans, those that showed nothing among them.
  std::vector<double> times_s = {};      ///< Of each scan, or empty; ascending within a robot's.
  std::vector<ScanKey> scans = {};       ///< Which each is in its file, or empty: from 1 on.
  std::vector<std::string> robots = {};  ///< By ScanKey::robot; empty: they have no names.
};

/// Rows of landmarks that no detection shows, ascending.
std::vector<Eigen::Index> unseen_in(const DetectionLog& log);

/// Brings detections into their order again, after their labels changed.
void sort_detections(std::vector<Detection>& detections);

/// What one sensor observed of the landmark: 1, rad, or m; NaN: nothing.
double measured(const Detection& seen, Sensor sensor);

/// What one sensor observed in those scans, as an array: visibility 0 where a landmark was not
/// seen, bearing and range NaN.
/// @note 8 M N bytes.
ObservationHistory history_of(const DetectionLog& log, Sensor sensor);

}  // namespace mapproof
