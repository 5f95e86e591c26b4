#pragma once

namespace mapproof {

/// How far a map is from the ground truth [yairi2007, section 4.1]. NaN where there is nothing to
/// compare.
struct Score {
  /// Mean position error over the mapped landmarks that are not anchors; NaN if there are none.
  double mpe_m = 0.0;
  /// Share of landmark triples whose orientation is wrong; NaN if the ground truth lies on one
  /// line, and over three anchors alone, which a map is aligned to without an error.
  double moe_percent = 0.0;

  /// Free of the anchors' choice: the affine map fitted to all landmarks, the error over all. NaN
  /// if the map is flat, and of three landmarks, which an affine map always meets.
  double mpe_all_fitted_m = 0.0;
  /// Free of reflection: the less of the MOE of the map and of its mirror image, above 50 only
  /// where the map flattens triples; NaN as moe_percent, and of three landmarks.
  double moe_unmirrored_percent = 0.0;
};

}  // namespace mapproof
