#pragma once

#include <vector>

#include "core/association/association_check.hpp"
#include "core/association/association_search.hpp"

namespace mapproof {

/// How well the scans fit one map.
struct AssociationDoubts {
  double residual_m = 0.0;  ///< Root mean square of the pairs' residuals, those beyond .25 of the
                            ///< median distance counted as that.
  double spread_m = 0.0;    ///< The residual expected from the pairs' own spread over the log.
  std::vector<int> landmarks;  ///< Whose pairs fit worst, at most 4, the worst first.

  /// Whether the residuals are far above what the measurements' own spread explains.
  bool grave() const { return residual_m > kGrave * spread_m; }

  static constexpr double kGrave = 1.12;
};

/// When a data association is reported as wrong.
struct AssociationCheckOptions {
  /// The least reduction of the cost, in variances of the residuals, to report a fault.
  double least_evidence = 60.0;
  /// The same as a share of what the pairs of both IDs cost.
  double least_share = 0.12;
  /// The highest mean cost of relabelled pairs, in variances of the residuals.
  double most_left = 3.0;
  /// The fewest detections, and the fewest other landmarks, that must show the fault.
  int fewest_detections = 10;
  int fewest_partners = 3;
  int most_findings = 10;  ///< >= 1; each needs a search of its own.
  int most_blocks = 40;    ///< The log is cut into about so many, >= 1.
};

/// A wrong data association over a stretch of the log.
struct AssociationFinding {
  AssociationFault fault = AssociationFault::kSwapped;
  int first = 0;  ///< As in AssociationHypothesis.
  int second = 0;
  bool by_time = false;    ///< The stretch is one of time, over all robots; else one of steps.
  bool scattered = false;  ///< In single scans, at any time, between the steps that follow.
  int first_step = 0;      ///< Where it begins and ends, at detections that it relabels.
  int last_step = 0;
  double first_time_s = 0.0;  ///< The same in time; NaN for a log without times.
  double last_time_s = 0.0;
  bool in_part = false;       ///< Not all detections of the IDs there are relabelled: scan by scan.
  bool all_of_robot = false;  ///< One robot's scans from its first to its last of both IDs.
  bool to_the_end = false;    ///< No detection of either ID comes after it in its order.
  bool from_the_start = false;  ///< None before.
  int detections = 0;           ///< Relabelled.
  int undetermined =
      0;             ///< If scattered: detections of both IDs seen alone, which stay as they are,
  int left_out = 0;  ///< and those that fit neither landmark, which the repaired log omits.
  double loss_before_m = 0.0;  ///< See RobustMap; of all pairs, at one width.
  double loss_after_m = 0.0;
  double evidence = 0.0;  ///< Reduction of the cost in variances of the residuals.
};

/// The wrong data associations of a log, as far as its pairs contradict each other.
struct AssociationCheck {
  std::vector<AssociationFinding> findings;  ///< In the order found, the clearest first.
  double loss_before_m = 0.0;
  double loss_after_m = 0.0;
  AssociationDoubts doubts;  ///< What none of the findings explains.
  DetectionLog repaired;     ///< The log under the corrected IDs, a landmark at most once per scan.
};

/// Looks for landmark IDs swapped, or wrong, over a stretch of steps or of time or in single scans:
/// repeatedly the fault that reduces the loss of the map the most.
///
/// Two IDs that are swapped in all detections are the same data under other names: no pair
/// contradicts another, and only known positions can reveal it. Of a swap and its complement the
/// one that changes fewer detections is reported.
/// @throws InvalidInput as scan_pairs, cut_in_blocks and robust_map do.
/// @note Some 2 s for 15 landmarks and 20,000 pairs, and as much for each finding.
AssociationCheck check_association(const DetectionLog& log,
                                   const AssociationCheckOptions& options = {});

}  // namespace mapproof
