#include "core/evaluate/path_evaluation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

constexpr std::array kAlignmentNames = {std::pair(FrameAlignment::kNone, "none"),
                                        std::pair(FrameAlignment::kRigid, "rigid"),
                                        std::pair(FrameAlignment::kSimilarity, "similarity"),
                                        std::pair(FrameAlignment::kFirstPose, "first-pose")};

constexpr std::array kPlaneNames = {std::pair(Plane::kXy, "xy"), std::pair(Plane::kXz, "xz"),
                                    std::pair(Plane::kYz, "yz")};

/// The coordinate that a plane lacks.
Eigen::Index normal_of(Plane plane) {
  constexpr std::array<Eigen::Index, 3> kNormals = {2, 1, 0};
  return kNormals[static_cast<std::size_t>(plane)];
}

/// The angle about one of the fixed axes x, y, z, about which R turns in that order.
double angle_about(Eigen::Index axis, const Eigen::Matrix3d& R) {
  const double cosine = std::hypot(R(0, 0), R(1, 0));
  constexpr double kSingular = 4.0 * std::numeric_limits<double>::epsilon();
  if (axis == 1) return std::atan2(-R(2, 0), cosine);
  if (cosine <= kSingular) return axis == 0 ? std::atan2(-R(1, 2), R(1, 1)) : 0.0;
  return axis == 0 ? std::atan2(R(2, 1), R(2, 2)) : std::atan2(R(1, 0), R(0, 0));
}

/// A pose as the rigid motion from its own frame.
struct Pose {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d position_m;
};

Pose pose_of(const SpacePath& path, Eigen::Index i) {
  return {path.orientations[static_cast<std::size_t>(i)], path.positions_m.row(i).transpose()};
}

/// a^-1 b; the transpose is the inverse, of rotations with few digits too, as evo takes it.
Pose relative(const Pose& a, const Pose& b) {
  return {a.rotation.transpose() * b.rotation,
          a.rotation.transpose() * (b.position_m - a.position_m)};
}

/// In [0, 180]; exact near both ends.
double angle_deg(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d axis(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return std::atan2(axis.norm(), R.trace() - 1.0) * 180.0 / std::numbers::pi;
}

/// The poses of both that belong together, as paths of equal length, and some of the others.
struct CommonPoses {
  SpacePath ground_truth, estimate, ground_truth_alone, estimate_alone;
};

constexpr Eigen::Index kMostAlone = 1000;  ///< Enough for a figure of a path.

SpacePath selected(const SpacePath& path, const std::vector<Eigen::Index>& rows) {
  SpacePath part{.time_s = path.time_s(rows),
                 .positions_m = path.positions_m(rows, Eigen::all),
                 .orientations = {},
                 .has_times = path.has_times};
  if (!path.orientations.empty())
    for (const Eigen::Index row : rows)
      part.orientations.push_back(path.orientations[static_cast<std::size_t>(row)]);
  return part;
}

/// Those of n rows that are not given, evenly thinned to kMostAlone.
std::vector<Eigen::Index> rows_without(const std::vector<Eigen::Index>& given, Eigen::Index n) {
  std::vector<bool> is_given(static_cast<std::size_t>(n), false);
  for (const Eigen::Index row : given) is_given[static_cast<std::size_t>(row)] = true;
  std::vector<Eigen::Index> others, some;
  for (Eigen::Index row = 0; row < n; ++row)
    if (!is_given[static_cast<std::size_t>(row)]) others.push_back(row);
  const std::size_t stride = 1 + others.size() / (kMostAlone + 1);
  for (std::size_t i = 0; i < others.size(); i += stride) some.push_back(others[i]);
  return some;
}

CommonPoses common_poses(const SpacePath& ground_truth, const SpacePath& estimate,
                         const TimeAssociation& association) {
  if (!ground_truth.has_times || !estimate.has_times) {
    if (ground_truth.size() != estimate.size())
      throw InvalidInput(fmt::format(
          "without times pose belongs to pose, but the ground truth has {} poses and the estimate "
          "{}",
          ground_truth.size(), estimate.size()));
    return {ground_truth, estimate, selected(ground_truth, {}), selected(estimate, {})};
  }
  std::vector<Eigen::Index> reference_rows, estimate_rows;
  for (const PosePair& pair : associate_times(ground_truth.time_s, estimate.time_s, association)) {
    reference_rows.push_back(pair.ground_truth);
    estimate_rows.push_back(pair.estimate);
  }
  CommonPoses poses{selected(ground_truth, reference_rows), selected(estimate, estimate_rows),
                    selected(ground_truth, rows_without(reference_rows, ground_truth.size())),
                    selected(estimate, rows_without(estimate_rows, estimate.size()))};
  poses.estimate_alone.time_s.array() += association.offset_s;
  return poses;
}

SpaceSimilarity alignment_of(const CommonPoses& poses, FrameAlignment alignment) {
  switch (alignment) {
    case FrameAlignment::kRigid:
    case FrameAlignment::kSimilarity:
      return fit_space_similarity(poses.estimate.positions_m, poses.ground_truth.positions_m,
                                  alignment == FrameAlignment::kSimilarity);
    case FrameAlignment::kFirstPose: {
      if (poses.ground_truth.orientations.empty() || poses.estimate.orientations.empty())
        throw InvalidInput("an alignment of first poses needs orientations of both paths");
      const Pose to = pose_of(poses.ground_truth, 0), from = pose_of(poses.estimate, 0);
      SpaceSimilarity map{.rotation = to.rotation * from.rotation.transpose()};
      map.offset = (to.position_m - map.rotation * from.position_m).transpose();
      return map;
    }
    case FrameAlignment::kNone:
      break;
  }
  return {};
}

SpacePath aligned(SpacePath path, const SpaceSimilarity& map) {
  path.positions_m = map(path.positions_m);
  for (Eigen::Matrix3d& orientation : path.orientations) orientation = map.rotation * orientation;
  return path;
}

Eigen::VectorXd way_along(const SpacePoints& positions_m) {
  Eigen::VectorXd way_m = Eigen::VectorXd::Zero(positions_m.rows());
  for (Eigen::Index i = 1; i < way_m.size(); ++i)
    way_m(i) = way_m(i - 1) + (positions_m.row(i) - positions_m.row(i - 1)).norm();
  return way_m;
}

PoseErrors pose_errors(const CommonPoses& poses) {
  const SpacePath& ground_truth = poses.ground_truth;
  PoseErrors errors{
      .time_s = ground_truth.time_s,
      .distance_m = way_along(ground_truth.positions_m),
      .estimate_m = poses.estimate.positions_m,
      .ground_truth_m = ground_truth.positions_m,
      .error_m = (poses.estimate.positions_m - ground_truth.positions_m).rowwise().norm(),
      .error_deg = {},
      .has_times = ground_truth.has_times,
      .ground_truth_alone = {poses.ground_truth_alone.time_s, poses.ground_truth_alone.positions_m},
      .estimate_alone = {poses.estimate_alone.time_s, poses.estimate_alone.positions_m}};
  if (ground_truth.orientations.empty() || poses.estimate.orientations.empty()) return errors;
  errors.error_deg.resize(errors.size());
  for (Eigen::Index i = 0; i < errors.size(); ++i)
    errors.error_deg(i) =
        angle_deg(relative(pose_of(ground_truth, i), pose_of(poses.estimate, i)).rotation);
  return errors;
}

/// The poses at which a pair ends and the next begins.
std::vector<Eigen::Index> consecutive_ends(const SpacePath& path, const PairSpacing& spacing) {
  std::vector<Eigen::Index> ends;
  switch (spacing.unit) {
    case PairUnit::kPoses:
      for (Eigen::Index i = 0; i < path.size(); i += static_cast<Eigen::Index>(spacing.length))
        ends.push_back(i);
      break;
    case PairUnit::kSeconds:
      for (Eigen::Index i = 0; i < path.size(); ++i)
        if (ends.empty() || path.time_s(i) - path.time_s(ends.back()) >= spacing.length)
          ends.push_back(i);
      break;
    case PairUnit::kMetres: {
      // The way to the first end is none of a pair, and starts again from 0 at each.
      double way_m = 0.0;
      for (Eigen::Index i = 1; i < path.size(); ++i) {
        way_m += (path.positions_m.row(i) - path.positions_m.row(i - 1)).norm();
        if (way_m < spacing.length) continue;
        ends.push_back(i);
        way_m = 0.0;
      }
      break;
    }
  }
  return ends;
}

/// Two poses, in order.
using Pair = std::pair<Eigen::Index, Eigen::Index>;

std::vector<Pair> consecutive_pairs(const SpacePath& path, const PairSpacing& spacing) {
  const std::vector<Eigen::Index> ends = consecutive_ends(path, spacing);
  std::vector<Pair> pairs;
  for (std::size_t k = 1; k < ends.size(); ++k) pairs.emplace_back(ends[k - 1], ends[k]);
  return pairs;
}

/// From each pose to the first of the later ones whose `along`, which does not descend, is nearest
/// to that of the pose and `length`, within `tolerance`.
std::vector<Pair> all_pairs(const Eigen::VectorXd& along, double length, double tolerance) {
  std::vector<Pair> pairs;
  for (Eigen::Index i = 0; i + 1 < along.size(); ++i) {
    const auto first = along.begin() + i + 1;
    const auto gap = [&](auto at) { return std::abs(*at - along(i) - length); };
    auto nearest = std::lower_bound(first, along.end(), along(i) + length);
    if (nearest == along.end() || (nearest != first && gap(nearest - 1) <= gap(nearest)))
      nearest = std::lower_bound(first, nearest, *(nearest - 1));
    if (gap(nearest) <= tolerance) pairs.emplace_back(i, nearest - along.begin());
  }
  return pairs;
}

std::vector<Pair> pairs_of(const SpacePath& path, const PairSpacing& spacing, PairChoice choice) {
  if (choice == PairChoice::kConsecutive) return consecutive_pairs(path, spacing);
  constexpr double kTolerance = 0.1;  // Of the spacing, as evo's default.
  switch (spacing.unit) {
    case PairUnit::kPoses: {
      const Eigen::VectorXd numbers =
          Eigen::VectorXd::LinSpaced(path.size(), 0.0, static_cast<double>(path.size() - 1));
      return all_pairs(numbers, spacing.length, 0.0);
    }
    case PairUnit::kSeconds:
      return all_pairs(path.time_s, spacing.length, kTolerance * spacing.length);
    case PairUnit::kMetres:
      return all_pairs(way_along(path.positions_m), spacing.length, kTolerance * spacing.length);
  }
  return {};
}

void check(const PairSpacing& spacing) {
  const bool is_whole =
      spacing.unit != PairUnit::kPoses || spacing.length == std::floor(spacing.length);
  if (!(spacing.length > 0.0) || !std::isfinite(spacing.length) || !is_whole)
    throw InvalidInput(
        fmt::format("relative errors over {:g} are not possible: a length is > 0 and finite, and "
                    "of poses whole",
                    spacing.length));
}

RelativeErrors relative_errors(const CommonPoses& poses, const Eigen::VectorXd& way_m,
                               const PairSpacing& spacing, PairChoice choice) {
  const std::vector<Pair> chosen = pairs_of(poses.estimate, spacing, choice);
  const Eigen::Index pairs = std::ssize(chosen);
  RelativeErrors errors{.spacing = spacing,
                        .error_m = Eigen::VectorXd(pairs),
                        .error_deg = Eigen::VectorXd(pairs),
                        .percent = Eigen::VectorXd(pairs)};
  for (Eigen::Index k = 0; k < pairs; ++k) {
    const auto [i, j] = chosen[static_cast<std::size_t>(k)];
    const Pose error =
        relative(relative(pose_of(poses.ground_truth, i), pose_of(poses.ground_truth, j)),
                 relative(pose_of(poses.estimate, i), pose_of(poses.estimate, j)));
    errors.error_m(k) = error.position_m.norm();
    errors.error_deg(k) = angle_deg(error.rotation);
    const double pair_m = way_m(j) - way_m(i);
    errors.percent(k) = pair_m > 0.0 ? 100.0 * errors.error_m(k) / pair_m : kNaN;
  }
  return errors;
}

/// The first of the nearest times, which do not descend.
Eigen::Index nearest(const Eigen::VectorXd& times_s, double time_s) {
  const auto after = std::lower_bound(times_s.begin(), times_s.end(), time_s);
  if (after == times_s.begin()) return 0;
  const auto gap_after = after == times_s.end() ? HUGE_VAL : std::abs(*after - time_s);
  const double before_s = *(after - 1);
  if (gap_after < std::abs(before_s - time_s)) return after - times_s.begin();
  return std::lower_bound(times_s.begin(), after, before_s) - times_s.begin();
}

}  // namespace

std::vector<PosePair> associate_times(const Eigen::VectorXd& ground_truth_s,
                                      const Eigen::VectorXd& estimate_s,
                                      const TimeAssociation& association) {
  if (!(association.largest_gap_s >= 0.0) || !std::isfinite(association.largest_gap_s))
    throw InvalidInput("the largest gap in time must be a number of seconds >= 0");
  if (!std::isfinite(association.offset_s))
    throw InvalidInput("the offset in time must be a finite number of seconds");
  const bool estimate_is_longer = estimate_s.size() > ground_truth_s.size();
  const Eigen::VectorXd& few = estimate_is_longer ? ground_truth_s : estimate_s;
  const Eigen::VectorXd many = estimate_is_longer
                                   ? Eigen::VectorXd(estimate_s.array() + association.offset_s)
                                   : Eigen::VectorXd(ground_truth_s.array() - association.offset_s);
  std::vector<PosePair> pairs;
  if (many.size() == 0) return pairs;
  for (Eigen::Index i = 0; i < few.size(); ++i) {
    const Eigen::Index k = nearest(many, few(i));
    if (!(std::abs(many(k) - few(i)) <= association.largest_gap_s)) continue;
    pairs.push_back(estimate_is_longer ? PosePair{i, k} : PosePair{k, i});
  }
  return pairs;
}

std::string_view name(FrameAlignment alignment) {
  for (const auto& [known, text] : kAlignmentNames)
    if (known == alignment) return text;
  return "";
}

std::optional<FrameAlignment> frame_alignment_named(std::string_view name) {
  for (const auto& [alignment, text] : kAlignmentNames)
    if (name == text) return alignment;
  return std::nullopt;
}

std::string_view name(Plane plane) { return kPlaneNames[static_cast<std::size_t>(plane)].second; }

std::optional<Plane> plane_named(std::string_view name) {
  for (const auto& [plane, text] : kPlaneNames)
    if (name == text) return plane;
  return std::nullopt;
}

SpacePath projected(SpacePath path, Plane plane) {
  const Eigen::Index normal = normal_of(plane);
  path.positions_m.col(normal).setZero();
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(normal);
  for (Eigen::Matrix3d& R : path.orientations)
    R = Eigen::AngleAxisd(angle_about(normal, R), axis).toRotationMatrix();
  return path;
}

ErrorStatistics error_statistics(const Eigen::VectorXd& errors) {
  if (errors.size() == 0) throw InvalidInput("statistics need an error");
  return {.rmse = std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size())),
          .mean = errors.mean(),
          .median = median(std::span(errors.data(), static_cast<std::size_t>(errors.size()))),
          .maximum = errors.maxCoeff()};
}

PathEvaluation evaluate_path(const SpacePath& ground_truth, const SpacePath& estimate,
                             const PathEvaluationOptions& options) {
  for (const PairSpacing& spacing : options.spacings) check(spacing);
  CommonPoses poses = common_poses(ground_truth, estimate, options.association);
  if (poses.estimate.size() < 2)
    throw InvalidInput(fmt::format(
        "{} poses are associated, two are needed: of {} poses of the ground truth and {} of the "
        "estimate, times are within {:g} s of each other",
        poses.estimate.size(), ground_truth.size(), estimate.size(),
        options.association.largest_gap_s));
  PathEvaluation result;
  result.associated_percent = 100.0 * static_cast<double>(poses.estimate.size()) /
                              static_cast<double>(std::min(ground_truth.size(), estimate.size()));
  result.alignment = alignment_of(poses, options.alignment);
  for (SpacePath* path : {&poses.estimate, &poses.estimate_alone})
    *path = aligned(std::move(*path), result.alignment);
  if (options.plane) {
    for (SpacePath* path :
         {&poses.ground_truth, &poses.estimate, &poses.ground_truth_alone, &poses.estimate_alone})
      *path = projected(std::move(*path), *options.plane);
  }
  result.poses = pose_errors(poses);
  if (result.poses.error_deg.size() == 0) return result;
  for (const PairSpacing& spacing : options.spacings) {
    if (spacing.unit == PairUnit::kSeconds && !result.poses.has_times) continue;
    RelativeErrors errors = relative_errors(poses, result.poses.distance_m, spacing, options.pairs);
    if (errors.error_m.size() > 0) result.relative.push_back(std::move(errors));
  }
  return result;
}

std::vector<PairSpacing> usual_spacings(double length_m) {
  if (!(length_m > 0.0) || !std::isfinite(length_m))
    throw InvalidInput("a path without length has no spacings");
  std::vector<PairSpacing> spacings;
  for (double decade = std::pow(10.0, std::floor(std::log10(0.01 * length_m)));
       decade <= 0.2 * length_m; decade *= 10.0)
    for (const double step : {1.0, 2.0, 5.0})
      if (step * decade >= 0.01 * length_m && step * decade <= 0.2 * length_m)
        spacings.push_back({.length = step * decade, .unit = PairUnit::kMetres});
  return spacings;
}

double path_length(const SpacePoints& positions_m) {
  if (positions_m.rows() == 0) return 0.0;
  return way_along(positions_m)(positions_m.rows() - 1);
}

}  // namespace mapproof
