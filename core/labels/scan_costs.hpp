#pragma once

#include <vector>

#include "core/labels/labelled_scans.hpp"
#include "core/labels/robust_map.hpp"
#include "core/labels/scan_pose.hpp"

namespace mapproof {

/// The map, or its mirror image, so that its landmarks turn the way round that the scans show them.
/// @param labels  A landmark of each detection.
Points turned_as_seen(const LabelledScans& scans, const std::vector<int>& labels, Points map);

/// What the detections of one scan cost in a map under this or that label, the others' labels being
/// certain. Where two others or more tell where the robot was, range and bearing count each for
/// itself: a range that is wrong spoils all of a detection's distances alike, its bearing not.
class ScanCosts {
 public:
  /// @param map  M x 2, turned as seen; NaN rows: not mapped.
  /// @param width_m  Of Huber's cost.
  ScanCosts(const LabelledScans& scans, const Points& map, double width_m);

  /// Takes the scan that begins at a row, without the detections under either of two labels.
  /// @return The row after its last.
  std::size_t take(const std::vector<int>& labels, std::size_t row, int first, int second);

  bool tells() const { return !others_.empty(); }       ///< Whether anything is known of the scan.
  bool has_pose() const { return others_.size() > 1; }  ///< Whether its bearings count.

  /// m^2; 0 where nothing tells.
  double operator()(std::size_t row, int landmark) const;

 private:
  void set_pose();

  const LabelledScans& scans_;
  const Points& map_;
  double width_m_;
  std::vector<std::pair<std::size_t, int>> others_;  ///< Row and label.
  ScanPose pose_;                                    ///< Of the others, if they are two or more.
};

}  // namespace mapproof
