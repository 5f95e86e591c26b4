#include "core/range_slam/refinement/refine.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/range_slam/dead_reckoning.hpp"
#include "core/range_slam/factors/spread_rows.hpp"
#include "core/range_slam/known_landmarks.hpp"
#include "core/range_slam/log_checks.hpp"
#include "core/range_slam/refinement/refine_problem.hpp"
#include "core/range_slam/refinement/refine_starts.hpp"

namespace mapproof {
namespace {

constexpr double kMostBlocks = 1e7;  ///< Poses times landmarks.

void check(const RangeLog& log, const SlamEstimate& start, const RefineOptions& options) {
  const Eigen::Index landmarks = std::ssize(log.landmarks);
  if (const std::string problem = options.problem(landmarks); !problem.empty())
    throw InvalidInput(problem);
  if (log.ranges.empty()) throw InvalidInput("a refinement needs ranges");
  check_ranges(log.ranges, landmarks);
  if (start.landmarks_m.rows() != landmarks)
    throw InvalidInput("a start needs a row for each landmark of the log");
  if (!(start.range_scale > 0.0) || !std::isfinite(start.range_scale))
    throw InvalidInput("the range scale of a start must be positive");
}

/// The whole path about its key poses.
Trajectory path_about(const KeyPoses& keys, const std::vector<Eigen::Vector3d>& poses) {
  Trajectory path = keys.path();
  for (Eigen::Index row = 0; row < path.size(); ++row) {
    const BetweenPoses position = keys.at(path.time_s(row));
    const auto before = static_cast<std::size_t>(position.before);
    const Eigen::Vector3d pose = position.pose(poses[before], poses[before + 1]);
    path.positions_m.row(row) = pose.head<2>().transpose();
    path.heading_rad(row) = pose(2);
  }
  return path;
}

/// A solve at one spacing.
struct Solution {
  KeyPoses keys;
  RefineState state;
  RefineProblem::Outcome outcome;
  std::optional<RefineProblem::Covariances> covariances = std::nullopt;
};

/// What is the same at all spacings.
struct Task {
  const RangeLog& log;
  const Trajectory& odometry;
  const std::vector<bool>& is_placed;
  const RefineOptions& options;
};

KeyPoses keys_of(const Task& task, double spacing_m) {
  return {task.odometry, task.options.odometry, spacing_m};
}

/// @param path  Where the poses begin; the landmarks, the scale and the offsets as in `start`.
Solution solve_at(const Task& task, KeyPoses keys, const Trajectory& path,
                  const RefineState& start) {
  Solution solution{.keys = std::move(keys), .state = start, .outcome = {}};
  solution.state.poses.clear();
  for (const Eigen::Index row : solution.keys.rows())
    solution.state.poses.emplace_back(path.positions_m(row, 0), path.positions_m(row, 1),
                                      path.heading_rad(row));
  const RefineProblem problem(task.log, solution.keys, task.is_placed, task.options);
  solution.outcome = problem.solve(solution.state);
  if (task.options.covariances > 0 && solution.outcome.is_usable)
    solution.covariances = problem.covariances(solution.state);
  return solution;
}

/// A first solve with few poses, if it is asked for and cheaper, and then that with all of them.
Solution solve(const Task& task, const Trajectory& path, const RefineState& start) {
  const RefineOptions& options = task.options;
  KeyPoses keys = keys_of(task, options.spacing_m);
  if (options.covariances > 0 &&
      static_cast<double>(keys.size()) * static_cast<double>(task.is_placed.size()) > kMostBlocks)
    throw InvalidInput(
        fmt::format("covariances are for at most {:g} poses times landmarks: give a "
                    "wider spacing",
                    kMostBlocks));
  if (options.coarse_spacing_m <= options.spacing_m)
    return solve_at(task, std::move(keys), path, start);
  RefineOptions coarse_options = options;
  coarse_options.covariances = 0;
  const Solution coarse = solve_at({task.log, task.odometry, task.is_placed, coarse_options},
                                   keys_of(task, options.coarse_spacing_m), path, start);
  if (!coarse.outcome.is_usable) return solve_at(task, std::move(keys), path, start);
  Solution fine =
      solve_at(task, std::move(keys), path_about(coarse.keys, coarse.state.poses), coarse.state);
  fine.outcome.iterations += coarse.outcome.iterations;
  return fine;
}

void take_covariances(const Solution& solution, Eigen::Index count, SlamEstimate& estimate) {
  if (!solution.covariances) {
    estimate.statuses.push_back(status_of<StatusReason::kNoCovariances>());
    return;
  }
  estimate.landmark_cov_m2 = solution.covariances->landmarks;
  for (const Eigen::Index key : spread_rows(solution.keys.size(), count)) {
    const auto at = static_cast<std::size_t>(key);
    estimate.position_cov_rows.push_back(solution.keys.rows()[at]);
    estimate.position_cov_m2.push_back(solution.covariances->positions[at]);
  }
  if (solution.covariances->are_of_first_pose)
    estimate.statuses.push_back(status_of<StatusReason::kCovariancesOfFirstPose>());
}

/// The result of a usable solution.
void take_solution(const Solution& solution, const RefineOptions& options, SlamEstimate& estimate) {
  estimate.path = path_about(solution.keys, solution.state.poses);
  for (Eigen::Index n = 0; n < estimate.landmarks_m.rows(); ++n)
    estimate.landmarks_m.row(n) = solution.state.landmarks[static_cast<std::size_t>(n)].transpose();
  estimate.range_scale = solution.state.scale;
  estimate.iterations = solution.outcome.iterations;
  estimate.cost = solution.outcome.cost;
  if (options.offset_sigma_m > 0.0)
    estimate.range_offsets_m = Eigen::Map<const Eigen::VectorXd>(
        solution.state.offsets_m.data(), std::ssize(solution.state.offsets_m));
  if (!solution.outcome.has_converged)
    estimate.statuses.push_back(
        status_of<StatusReason::kLeastSquaresNotConverged>(solution.outcome.iterations));
  if (options.covariances > 0) take_covariances(solution, options.covariances, estimate);
}

}  // namespace

SlamEstimate refine(const RangeLog& log, const SlamEstimate& start, const RefineOptions& options) {
  check(log, start, options);
  const Trajectory odometry = dead_reckoned(log);
  PlacedStart placed = placed_start(log, odometry, start, options.known);
  RefineOptions placed_options = options;
  placed_options.known = placed.known;
  RefineState state{.poses = {},
                    .landmarks = {},
                    .offsets_m = std::vector<double>(log.landmarks.size(), 0.0),
                    .scale = start.range_scale};
  std::vector<bool> is_placed;
  for (Eigen::Index n = 0; n < placed.landmarks_m.rows(); ++n) {
    is_placed.push_back(placed.landmarks_m.row(n).allFinite());
    state.landmarks.emplace_back(placed.landmarks_m.row(n).transpose());
  }
  const Solution solution = solve({log, odometry, is_placed, placed_options}, placed.path, state);

  SlamEstimate estimate;
  estimate.path = std::move(placed.path);
  estimate.landmarks_m = std::move(placed.landmarks_m);
  estimate.range_scale = start.range_scale;
  estimate.statuses = std::move(placed.statuses);
  report_unplaced(log, is_placed, estimate.statuses);
  if (solution.outcome.is_usable)
    take_solution(solution, placed_options, estimate);
  else
    estimate.statuses.push_back(status_of<StatusReason::kNoDecreasingStep>());
  const std::size_t known = options.known ? options.known->rows.size() : 0;
  if (known < log.landmarks.size())
    if (auto status = path_on_a_line(estimate.path.positions_m))
      estimate.statuses.push_back(*std::move(status));
  return estimate;
}

}  // namespace mapproof
