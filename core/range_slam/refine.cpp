#include "core/range_slam/refine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/align/rigid.hpp"
#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "core/range_slam/dead_reckoning.hpp"
#include "core/range_slam/log_checks.hpp"
#include "core/range_slam/refine_problem.hpp"
#include "core/range_slam/refine_starts.hpp"

namespace mapproof {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostWithCovariances = 500;  ///< Landmarks.
constexpr double kMostBlocks = 1e7;                ///< Poses times landmarks.

void check(const RangeLog& log, const SlamEstimate& start, const RefineOptions& options) {
  const auto landmarks = static_cast<Eigen::Index>(log.landmarks.size());
  if (const std::string problem = options.problem(landmarks); !problem.empty())
    throw InvalidInput(problem);
  if (log.ranges.empty()) throw InvalidInput("a refinement needs ranges");
  check_ranges(log);
  if (start.landmarks_m.rows() != landmarks)
    throw InvalidInput("a start needs a row for each landmark of the log");
  if (!(start.range_scale > 0.0) || !std::isfinite(start.range_scale))
    throw InvalidInput("the range scale of a start must be positive");
}

/// Path and landmarks of a start, in the frame of the known landmarks if there are any.
struct Placed {
  Trajectory path;
  Points landmarks_m;
};

/// The start's landmarks where known ones are give the motion to their frame.
void move_to_known(const KnownLandmarks& known, Placed& placed) {
  std::vector<Eigen::Index> both;
  for (std::size_t i = 0; i < known.rows.size(); ++i)
    if (placed.landmarks_m.row(known.rows[i]).allFinite())
      both.push_back(static_cast<Eigen::Index>(i));
  if (both.size() >= 2) {
    Points from(static_cast<Eigen::Index>(both.size()), 2);
    for (Eigen::Index i = 0; i < from.rows(); ++i)
      from.row(i) = placed.landmarks_m.row(
          known.rows[static_cast<std::size_t>(both[static_cast<std::size_t>(i)])]);
    const Similarity motion =
        fit_similarity(from, known.positions_m(both, Eigen::all), Alignment::kRigid);
    placed.path.positions_m = motion(placed.path.positions_m);
    placed.path.heading_rad.array() += std::atan2(motion.rotation(1, 0), motion.rotation(0, 0));
    placed.landmarks_m = motion(placed.landmarks_m);
  }
  for (std::size_t i = 0; i < known.rows.size(); ++i)
    placed.landmarks_m.row(known.rows[i]) = known.positions_m.row(static_cast<Eigen::Index>(i));
}

Placed placed_start(const RangeLog& log, const Trajectory& odometry, const SlamEstimate& start,
                    const RefineOptions& options) {
  Placed placed{.path = carried_along(start.path, odometry), .landmarks_m = start.landmarks_m};
  bool has_all = true;
  for (Eigen::Index n = 0; n < placed.landmarks_m.rows(); ++n)
    has_all = has_all && placed.landmarks_m.row(n).allFinite();
  if (!has_all) {
    const Points found = trilaterated(log, placed.path, start.range_scale);
    for (Eigen::Index n = 0; n < placed.landmarks_m.rows(); ++n)
      if (!placed.landmarks_m.row(n).allFinite()) placed.landmarks_m.row(n) = found.row(n);
  }
  // Without a reading a place is nobody's finding.
  std::vector<bool> is_heard(log.landmarks.size(), false);
  for (const RangeReading& reading : log.ranges)
    if (reading.time_s >= odometry.time_s(0) &&
        reading.time_s <= odometry.time_s(odometry.size() - 1))
      is_heard[static_cast<std::size_t>(reading.landmark)] = true;
  for (Eigen::Index n = 0; n < placed.landmarks_m.rows(); ++n)
    if (!is_heard[static_cast<std::size_t>(n)]) placed.landmarks_m.row(n).setConstant(kNan);
  if (options.known) move_to_known(*options.known, placed);
  return placed;
}

/// The whole path about its key poses.
Trajectory path_about(const KeyPoses& keys, const std::vector<Eigen::Vector3d>& poses) {
  Trajectory path = keys.path();
  for (Eigen::Index row = 0; row < path.size(); ++row) {
    const BetweenPoses place = keys.at(path.time_s(row));
    const auto before = static_cast<std::size_t>(place.before);
    const Eigen::Vector3d pose = place.pose(poses[before], poses[before + 1]);
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

Solution solve_at(double spacing_m, const RangeLog& log, const Trajectory& odometry,
                  const Trajectory& path, const RefineState& start,
                  const std::vector<bool>& is_placed, const RefineOptions& options) {
  Solution solution{
      .keys = KeyPoses(odometry, options.odometry, spacing_m), .state = start, .outcome = {}};
  solution.state.poses.clear();
  for (const Eigen::Index row : solution.keys.rows())
    solution.state.poses.emplace_back(path.positions_m(row, 0), path.positions_m(row, 1),
                                      path.heading_rad(row));
  const double blocks = static_cast<double>(solution.keys.size() * std::ssize(log.landmarks));
  if (options.covariances > 0 &&
      (log.landmarks.size() > kMostWithCovariances || blocks > kMostBlocks))
    throw InvalidInput(
        fmt::format("covariances are for at most {} landmarks, and {:g} poses times "
                    "landmarks: give a wider spacing",
                    kMostWithCovariances, kMostBlocks));
  const RefineProblem problem(log, solution.keys, is_placed, options);
  solution.outcome = problem.solve(solution.state);
  if (options.covariances > 0 && solution.outcome.is_usable)
    solution.covariances = problem.covariances(solution.state);
  return solution;
}

/// A first solve with few poses, if it is asked for and cheaper, and then that with all of them.
Solution solve(const RangeLog& log, const Trajectory& odometry, const Placed& placed,
               const RefineState& start, const std::vector<bool>& is_placed,
               const RefineOptions& options) {
  if (options.coarse_spacing_m <= options.spacing_m)
    return solve_at(options.spacing_m, log, odometry, placed.path, start, is_placed, options);
  RefineOptions coarse_options = options;
  coarse_options.covariances = 0;
  const Solution coarse = solve_at(options.coarse_spacing_m, log, odometry, placed.path, start,
                                   is_placed, coarse_options);
  if (!coarse.outcome.is_usable)
    return solve_at(options.spacing_m, log, odometry, placed.path, start, is_placed, options);
  Solution fine =
      solve_at(options.spacing_m, log, odometry, path_about(coarse.keys, coarse.state.poses),
               coarse.state, is_placed, options);
  fine.outcome.iterations += coarse.outcome.iterations;
  return fine;
}

void take_covariances(const Solution& solution, Eigen::Index count, SlamEstimate& estimate) {
  if (!solution.covariances) {
    estimate.statuses.push_back(
        {StatusCode::kUndetermined,
         "The ranges leave a landmark or the path free to move: there are no covariances."});
    return;
  }
  estimate.landmark_cov_m2 = solution.covariances->landmarks;
  const Eigen::Index keys = solution.keys.size();
  const Eigen::Index shown = std::min(count, keys);
  for (Eigen::Index i = 0; i < shown; ++i) {
    const auto key = static_cast<std::size_t>(shown > 1 ? i * (keys - 1) / (shown - 1) : 0);
    estimate.position_cov_rows.push_back(solution.keys.rows()[key]);
    estimate.position_cov_m2.push_back(solution.covariances->positions[key]);
  }
}

void name_unplaced(const RangeLog& log, const std::vector<bool>& is_placed,
                   SlamEstimate& estimate) {
  std::vector<std::string> names;
  for (std::size_t n = 0; n < is_placed.size(); ++n)
    if (!is_placed[n]) names.push_back(log.landmarks[n]);
  if (!names.empty())
    estimate.statuses.push_back(
        {StatusCode::kLandmarkUnseen, "Too few ranges for a place of " + listed(names, 10) + "."});
}

}  // namespace

std::string RefineOptions::problem(Eigen::Index n) const {
  if (!(odometry.forward_m > 0.0 && odometry.sideways_m > 0.0 && odometry.turn_rad > 0.0))
    return "the noise of odometry must be positive";
  if (!(range_sigma_m > 0.0)) return "the standard deviation of ranges must be positive";
  if (!(huber > 0.0)) return "Huber's bound must be positive";
  if (!(offset_sigma_m >= 0.0)) return "the standard deviation of offsets cannot be negative";
  if (!(spacing_m >= 0.0 && coarse_spacing_m >= 0.0))
    return "the spacing of poses cannot be negative";
  if (most_iterations < 1) return "a refinement needs an iteration";
  if (covariances < 0) return "the number of covariances cannot be negative";
  if (!known) return "";
  if (known->rows.size() < 2) return "known landmarks are two or more, or none";
  return known_problem(*known, n);
}

SlamEstimate refine(const RangeLog& log, const SlamEstimate& start, const RefineOptions& options) {
  check(log, start, options);
  const Trajectory odometry = dead_reckoned(log);
  const Placed placed = placed_start(log, odometry, start, options);
  RefineState state{.poses = {},
                    .landmarks = {},
                    .offsets_m = std::vector<double>(log.landmarks.size(), 0.0),
                    .scale = start.range_scale};
  std::vector<bool> is_placed;
  for (Eigen::Index n = 0; n < placed.landmarks_m.rows(); ++n) {
    is_placed.push_back(placed.landmarks_m.row(n).allFinite());
    state.landmarks.emplace_back(placed.landmarks_m.row(n).transpose());
  }
  const Solution solution = solve(log, odometry, placed, state, is_placed, options);

  SlamEstimate estimate;
  estimate.path = placed.path;
  estimate.landmarks_m = placed.landmarks_m;
  estimate.range_scale = start.range_scale;
  name_unplaced(log, is_placed, estimate);
  if (!solution.outcome.is_usable) {
    estimate.statuses.push_back(
        {StatusCode::kFailed, "No step lowered the cost: this is the start as it came."});
    return estimate;
  }
  estimate.path = path_about(solution.keys, solution.state.poses);
  for (Eigen::Index n = 0; n < estimate.landmarks_m.rows(); ++n)
    estimate.landmarks_m.row(n) = solution.state.landmarks[static_cast<std::size_t>(n)].transpose();
  estimate.range_scale = solution.state.scale;
  estimate.iterations = solution.outcome.iterations;
  estimate.cost = solution.outcome.cost;
  if (options.offset_sigma_m > 0.0)
    estimate.range_offsets_m = Eigen::Map<const Eigen::VectorXd>(
        solution.state.offsets_m.data(), static_cast<Eigen::Index>(log.landmarks.size()));
  if (!solution.outcome.has_converged)
    estimate.statuses.push_back(
        {StatusCode::kNotConverged,
         fmt::format("The least squares had not converged after {} iterations.",
                     solution.outcome.iterations)});
  if (options.covariances > 0) take_covariances(solution, options.covariances, estimate);
  return estimate;
}

}  // namespace mapproof
