#pragma once

#include <vector>

#include "core/association/identified_scans.hpp"
#include "core/association/robust_map.hpp"
#include "core/association/scan_pose.hpp"

namespace mapproof {

/// A data-association hypothesis that was tested, and its result.
struct HypothesisFit {
  AssociationHypothesis fault;
  StepStretch stretch;
  std::vector<int> ids;
  RobustMap map;
  bool scattered = false;  ///< In single scans, at any time; the stretch is then the whole log.
};

/// The scans of a log with their landmark IDs; all three must outlive it.
struct ScanIds {
  const IdentifiedScans& scans;
  const std::vector<int>& given;  ///< The IDs before the fault is corrected.
  const std::vector<int>& ids;    ///< The current ones: they stay where a scan gives no evidence.
};

/// Reassigns two IDs scan by scan, each scan as it costs less in a map.
///
/// kSwapped: in a scan both are exchanged, or neither; else detections under the first ID may be of
/// the second landmark, unless that is in the scan. An ID other than that in `ids` must gain two
/// variances.
/// @param map  Reflected as seen (see scan_costs.hpp).
/// @note Linear in detections.
std::vector<int> ids_scan_by_scan(const ScanIds& of, const AssociationHypothesis& fault,
                                  const Points& map, double width_m);

/// Alternates between reassigning both IDs and minimizing the map's cost until no ID changes.
/// @param start  M x 2: the initial map.
/// @param predicted_m  Width of Huber's cost by which scans are judged; the map's is `width_m`.
HypothesisFit converged_fit(const ScanIds& of, HypothesisFit fit, const Points& start,
                            double predicted_m, double width_m);

/// The map, or its reflection, so that its landmarks have the orientation that the scans show.
/// @param ids  The landmark ID of each detection.
Points oriented_as_seen(const IdentifiedScans& scans, const std::vector<int>& ids, Points map);

/// What the detections of one scan cost in a map under different IDs, given the IDs of the others.
/// Where two others or more determine the robot's pose, range and bearing count separately: a wrong
/// range spoils all of a detection's distances alike, but not its bearing.
class ScanCosts {
 public:
  /// @param map  M x 2, reflected as seen; NaN rows: not mapped.
  /// @param width_m  Of Huber's cost.
  ScanCosts(const IdentifiedScans& scans, const Points& map, double width_m);

  /// Takes the scan that begins at a row, without the detections under either of two IDs.
  /// @return The row after its last.
  std::size_t take(const std::vector<int>& ids, std::size_t row, int first, int second);

  bool determines() const { return !others_.empty(); }  ///< Whether the scan gives any evidence.
  bool has_pose() const { return others_.size() > 1; }  ///< Whether its bearings count.

  /// m^2; 0 without evidence.
  double operator()(std::size_t row, int landmark) const;

 private:
  void set_pose();

  const IdentifiedScans& scans_;
  const Points& map_;
  double width_m_;
  std::vector<std::pair<std::size_t, int>> others_;  ///< Row and landmark ID.
  ScanPose pose_;                                    ///< Of the others, if they are two or more.
};

}  // namespace mapproof
