#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/align/rigid.hpp"
#include "core/model/paths/space_path.hpp"

namespace mapproof {

/// How poses of two paths are associated by their times.
struct TimeAssociation {
  double offset_s = 0.0;        ///< Added to the times of the estimate.
  double largest_gap_s = 0.01;  ///< Poses farther apart in time are not associated, >= 0.
};

/// A pose of the ground truth and the one of the estimate that belongs to it.
struct PosePair {
  Eigen::Index ground_truth = 0;
  Eigen::Index estimate = 0;

  bool operator==(const PosePair&) const = default;
};

/// For each pose of the path with fewer poses (of the estimate if both have as many) the nearest in
/// time of the other one, the earlier of two as near; as evo associates them [grupp2017].
/// @param ground_truth_s, estimate_s  Times, not descending.
/// @return In the order of the shorter path. A pose of the longer one may be in several pairs.
/// @throws InvalidInput unless the largest gap is finite and >= 0, and the offset finite.
/// @note O(n log m) for n poses of the shorter path.
std::vector<PosePair> associate_times(const Eigen::VectorXd& ground_truth_s,
                                      const Eigen::VectorXd& estimate_s,
                                      const TimeAssociation& association);

/// How an estimate is brought into the frame of the ground truth.
enum class FrameAlignment {
  kNone,        ///< As it came.
  kRigid,       ///< Rotation and translation of least squares over all associated poses.
  kSimilarity,  ///< The same with a scale.
  kFirstPose,   ///< The first associated pose, orientation and all, is that of the ground truth.
};

/// "none", "rigid", "similarity", "first-pose".
std::string_view name(FrameAlignment alignment);
std::optional<FrameAlignment> frame_alignment_named(std::string_view name);

/// What the two poses of a relative error lie apart.
enum class PairUnit { kMetres, kSeconds, kPoses };

/// How far apart the two poses of a relative error lie.
struct PairSpacing {
  double length = 1.0;  ///< > 0, finite; whole poses.
  PairUnit unit = PairUnit::kMetres;

  auto operator<=>(const PairSpacing&) const = default;
};

/// Which pairs of poses have a relative error.
enum class PairChoice {
  kConsecutive,  ///< At least the spacing apart, each beginning where the one before ends.
  /// From every pose to the first of the later ones that are nearest to the spacing away, if they
  /// are within a tenth of it; of poses exactly the spacing.
  kAll,
};

/// A plane of the frame of the ground truth.
enum class Plane { kXy, kXz, kYz };

/// "xy", "xz", "yz".
std::string_view name(Plane plane);
std::optional<Plane> plane_named(std::string_view name);

/// The path in the plane, as evo projects it [grupp2017]: the third coordinate is 0, and an
/// orientation keeps its angle about that axis alone (of the angles about the fixed axes x, y and
/// z, in that order; that about y lies within 90 degrees).
SpacePath projected(SpacePath path, Plane plane);

struct PathEvaluationOptions {
  TimeAssociation association = {};
  FrameAlignment alignment = FrameAlignment::kRigid;
  std::vector<PairSpacing> spacings = {};
  PairChoice pairs = PairChoice::kConsecutive;
  std::optional<Plane> plane = {};  ///< Errors in this plane alone; the alignment is in space.
};

/// Of a sample of errors.
struct ErrorStatistics {
  double rmse = 0.0, mean = 0.0, median = 0.0, maximum = 0.0;
};

/// @param errors  At least one. @throws InvalidInput without.
ErrorStatistics error_statistics(const Eigen::VectorXd& errors);

/// Relative errors [sturm2012] at one spacing. Pairs are chosen along the estimate, as evo does:
/// its own metres, or associated poses.
struct RelativeErrors {
  PairSpacing spacing;
  Eigen::VectorXd error_m;    ///< Per pair: length of the translation part.
  Eigen::VectorXd error_deg;  ///< Per pair: angle of the rotation part; empty: not known.
  Eigen::VectorXd percent;    ///< Per pair: error_m of the way along the ground truth; NaN: no way.
};

struct PathEvaluation {
  PoseErrors poses;
  SpaceSimilarity alignment;             ///< That was applied to the estimate.
  std::vector<RelativeErrors> relative;  ///< Of each spacing that has a pair.
  double associated_percent = 0.0;       ///< Poses of the shorter path that have a partner.
};

/// Absolute and relative errors of an estimated path (ATE and RPE [sturm2012]), in metres of the
/// ground truth. Relative errors need orientations of both: without, they are left out.
///
/// Paths without times on either side are associated pose by pose and must have as many.
/// @throws InvalidInput if fewer than 2 poses can be associated, an option breaks its bounds, or
///         kFirstPose lacks an orientation.
/// @note O(T log T).
PathEvaluation evaluate_path(const SpacePath& ground_truth, const SpacePath& estimate,
                             const PathEvaluationOptions& options);

/// Spacings in metres for paths of that length: 1, 2 and 5 times powers of 10, from a hundredth of
/// it to a fifth. @throws InvalidInput unless the length is finite and > 0.
std::vector<PairSpacing> usual_spacings(double length_m);

/// Length of the way along the positions.
double path_length(const SpacePoints& positions_m);

}  // namespace mapproof
