#pragma once

#include <compare>
#include <limits>
#include <string>
#include <vector>

#include "core/model/observation_history.hpp"

namespace mapproof {

/// One landmark in one look: what was measured of it.
struct Sighting {
  int step = 0;                                                   ///< Which look, from 0.
  int landmark = 0;                                               ///< Row among the log's names.
  double range_m = std::numeric_limits<double>::quiet_NaN();      ///< NaN: not measured.
  double bearing_rad = std::numeric_limits<double>::quiet_NaN();  ///< Relative to the heading,
                                                                  ///< counter-clockwise; NaN: not.
};

/// Which look it was of the looks of several robots: one robot's at one step or time.
struct LookKey {
  int robot = 0;     ///< In the order in which they come; 0 where robots are not told apart.
  double key = 0.0;  ///< Step or time, finite.

  auto operator<=>(const LookKey&) const = default;
};

/// What looks showed of M landmarks, range and bearing of each together: a history as sparse as the
/// looks are. Who looked, and from where, is not in it: looks of several robots are pooled.
struct SightingLog {
  std::vector<std::string> names = {};  ///< Of the landmarks, M of them, all different.
  /// Ascending by step, then landmark; no (step, landmark) twice.
  std::vector<Sighting> sightings = {};
  int steps = 0;                         ///< Looks, those that showed nothing among them.
  std::vector<double> times_s = {};      ///< Of each look, or empty; ascending within a robot's.
  std::vector<LookKey> looks = {};       ///< Which each is in its file, or empty: from 1 on.
  std::vector<std::string> robots = {};  ///< By LookKey::robot; empty: they have no names.
};

/// Rows of landmarks that no sighting shows, ascending.
std::vector<Eigen::Index> unseen_in(const SightingLog& log);

/// Brings sightings into their order again, after their labels changed.
void sort_sightings(std::vector<Sighting>& sightings);

/// What one kind of sensor saw in those looks, as an array: visibility 0 where a landmark was not
/// seen, bearing and range NaN.
/// @note 8 M N bytes.
ObservationHistory history_of(const SightingLog& log, Sensor sensor);

}  // namespace mapproof
