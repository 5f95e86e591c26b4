#pragma once

namespace mapproof {

/// How far a map is from the truth [yairi2007, section 4.1].
struct Score {
  double mpe_m = 0.0;        ///< Mean position error over the mapped landmarks that are no anchors.
  double moe_percent = 0.0;  ///< Share of landmark triples whose orientation is wrong.

  /// Free of the anchors' choice: the affine map fitted to all landmarks, the error over all.
  double mpe_all_fitted_m = 0.0;
  /// Free of reflection: min(moe, 100 - moe).
  double moe_unmirrored_percent = 0.0;
};

}  // namespace mapproof
