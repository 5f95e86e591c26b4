#include "core/experiment/slam_scores.hpp"

#include <cmath>

#include "core/align/path_at.hpp"
#include "core/align/rigid.hpp"
#include "core/score/trajectory_error.hpp"

namespace mapproof {
namespace {

void turn(std::vector<Eigen::Matrix2d>& covariances, const Similarity& motion) {
  for (Eigen::Matrix2d& cov : covariances) {
    const Eigen::Matrix2d turned =
        motion.scale * motion.scale * motion.rotation * cov * motion.rotation.transpose();
    cov = turned;
  }
}

void move(SlamEstimate& estimate, const Similarity& motion) {
  estimate.path.positions_m = Points(motion(estimate.path.positions_m));
  estimate.landmarks_m = Points(motion(estimate.landmarks_m));
  for (double& heading : estimate.path.heading_rad) {
    const Eigen::Vector2d way =
        motion.rotation * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    heading = std::atan2(way.y(), way.x());
  }
  turn(estimate.landmark_cov_m2, motion);
  turn(estimate.position_cov_m2, motion);
}

/// The first, and those that take more freedom than it.
std::vector<Alignment> alignments_from(Alignment first) {
  switch (first) {
    case Alignment::kNone:
      return {Alignment::kNone, Alignment::kRigid, Alignment::kSimilarity};
    case Alignment::kRigid:
      return {Alignment::kRigid, Alignment::kSimilarity};
    default:
      return {first};
  }
}

std::vector<double> pose_errors(const Trajectory& path, const Trajectory& truth) {
  const Eigen::VectorXd errors =
      (positions_at(truth, path.time_s) - path.positions_m).rowwise().norm();
  return {errors.begin(), errors.end()};
}

}  // namespace

void score_against_truth(SlamRecord& record, const RangeLog& log, Alignment first) {
  SlamEstimate& estimate = record.estimate;
  if (!log.truth || estimate.path.size() == 0) return;
  const std::optional<Similarity> motion = path_alignment(estimate.path, *log.truth, first);
  if (!motion) return;
  for (const Alignment alignment : alignments_from(first))
    if (const auto error = trajectory_error(estimate, *log.truth, log.true_landmarks, alignment))
      record.errors.push_back(*error);
  if (first != Alignment::kNone) move(estimate, *motion);
  record.error_m = pose_errors(estimate.path, *log.truth);
}

void lay_on(SlamEstimate& estimate, const Trajectory& path, bool may_mirror) {
  if (estimate.path.size() == 0) return;
  const auto motion = path_alignment(
      estimate.path, path, may_mirror ? Alignment::kRigidWithReflection : Alignment::kRigid);
  if (motion) move(estimate, *motion);
}

}  // namespace mapproof
