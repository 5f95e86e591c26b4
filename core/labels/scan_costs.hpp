#pragma once

#include <vector>

#include "core/labels/labelled_scans.hpp"
#include "core/labels/robust_map.hpp"
#include "core/labels/scan_pose.hpp"

namespace mapproof {

/// The map, or its reflection, so that its landmarks have the orientation that the scans show.
/// @param labels  The landmark ID of each detection.
Points turned_as_seen(const LabelledScans& scans, const std::vector<int>& labels, Points map);

/// What the detections of one scan cost in a map under different IDs, given the IDs of the others.
/// Where two others or more determine the robot's pose, range and bearing count separately: a wrong
/// range spoils all of a detection's distances alike, but not its bearing.
class ScanCosts {
 public:
  /// @param map  M x 2, reflected as seen; NaN rows: not mapped.
  /// @param width_m  Of Huber's cost.
  ScanCosts(const LabelledScans& scans, const Points& map, double width_m);

  /// Takes the scan that begins at a row, without the detections under either of two IDs.
  /// @return The row after its last.
  std::size_t take(const std::vector<int>& labels, std::size_t row, int first, int second);

  bool tells() const { return !others_.empty(); }       ///< Whether the scan gives any evidence.
  bool has_pose() const { return others_.size() > 1; }  ///< Whether its bearings count.

  /// m^2; 0 without evidence.
  double operator()(std::size_t row, int landmark) const;

 private:
  void set_pose();

  const LabelledScans& scans_;
  const Points& map_;
  double width_m_;
  std::vector<std::pair<std::size_t, int>> others_;  ///< Row and landmark ID.
  ScanPose pose_;                                    ///< Of the others, if they are two or more.
};

}  // namespace mapproof
