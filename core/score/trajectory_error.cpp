#include "core/score/trajectory_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/align/path_at.hpp"
#include "core/base/errors.hpp"

namespace mapproof {
namespace {

/// True poses and their estimates at the same times.
struct CommonPoses {
  Eigen::VectorXd time_s;
  Points estimate_m;
  Points ground_truth_m;
};

CommonPoses common_poses(const Trajectory& path, const Trajectory& ground_truth) {
  if (const std::string problem = times_problem(ground_truth); !problem.empty())
    throw InvalidInput(problem);
  const Points estimate_m = positions_at(path, ground_truth.time_s);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < ground_truth.size(); ++i)
    if (estimate_m.row(i).allFinite() && ground_truth.positions_m.row(i).allFinite())
      rows.push_back(i);
  return {.time_s = ground_truth.time_s(rows),
          .estimate_m = estimate_m(rows, Eigen::all),
          .ground_truth_m = ground_truth.positions_m(rows, Eigen::all)};
}

struct Tenths {
  double last, best, worst;
};

/// Means over windows of a tenth of the time, each from a pose to the last one within it.
Tenths tenths_of(const Eigen::VectorXd& time_s, const Eigen::VectorXd& error_m) {
  const Eigen::Index n = time_s.size();
  const double length_s = 0.1 * (time_s(n - 1) - time_s(0));
  std::vector<double> sums(static_cast<std::size_t>(n) + 1, 0.0);
  for (Eigen::Index i = 0; i < n; ++i)
    sums[static_cast<std::size_t>(i) + 1] = sums[static_cast<std::size_t>(i)] + error_m(i);
  const auto mean = [&](Eigen::Index first, Eigen::Index end) {
    return (sums[static_cast<std::size_t>(end)] - sums[static_cast<std::size_t>(first)]) /
           static_cast<double>(end - first);
  };
  const double last_from_s = time_s(n - 1) - length_s;
  const auto last = std::lower_bound(time_s.begin(), time_s.end(), last_from_s) - time_s.begin();
  Tenths tenths{.last = mean(last, n), .best = mean(last, n), .worst = mean(last, n)};
  Eigen::Index end = 0;
  for (Eigen::Index first = 0; first < last; ++first) {
    while (end < n && time_s(end) <= time_s(first) + length_s) ++end;
    tenths.best = std::min(tenths.best, mean(first, end));
    tenths.worst = std::max(tenths.worst, mean(first, end));
  }
  return tenths;
}

std::optional<double> landmark_error(const Similarity& map, const Points& estimate_m,
                                     const Points& ground_truth_m) {
  if (estimate_m.rows() != ground_truth_m.rows())
    throw InvalidInput("the landmarks of estimate and ground truth differ in number");
  const Eigen::VectorXd errors_m = (map(estimate_m) - ground_truth_m).rowwise().norm();
  double sum = 0.0;
  int count = 0;
  for (const double error_m : errors_m) {
    if (!std::isfinite(error_m)) continue;
    sum += error_m;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

}  // namespace

std::optional<Similarity> path_alignment(const Trajectory& path, const Trajectory& ground_truth,
                                         Alignment alignment) {
  const CommonPoses poses = common_poses(path, ground_truth);
  if (poses.time_s.size() < 2) return std::nullopt;
  return fit_similarity(poses.estimate_m, poses.ground_truth_m, alignment);
}

std::optional<TrajectoryError> trajectory_error(const SlamEstimate& estimate,
                                                const Trajectory& ground_truth,
                                                const std::optional<Points>& true_landmarks,
                                                Alignment alignment) {
  const CommonPoses poses = common_poses(estimate.path, ground_truth);
  if (poses.time_s.size() < 2) return std::nullopt;
  const Similarity map = fit_similarity(poses.estimate_m, poses.ground_truth_m, alignment);
  const Eigen::VectorXd error_m = (map(poses.estimate_m) - poses.ground_truth_m).rowwise().norm();
  const Tenths tenths = tenths_of(poses.time_s, error_m);
  TrajectoryError error{
      .alignment = alignment,
      .mean_m = error_m.mean(),
      .rmse_m = std::sqrt(error_m.squaredNorm() / static_cast<double>(error_m.size())),
      .last_tenth_m = tenths.last,
      .best_tenth_m = tenths.best,
      .worst_tenth_m = tenths.worst,
      .landmarks_m = std::nullopt,
      .poses = error_m.size()};
  if (true_landmarks)
    error.landmarks_m = landmark_error(map, estimate.landmarks_m, *true_landmarks);
  return error;
}

}  // namespace mapproof
