#include "core/range_slam/refinement/refine.hpp"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <glog/logging.h>
#include <Eigen/Geometry>
#include <cmath>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/range_slam/dead_reckoning.hpp"
#include "core/range_slam/factors/spread_rows.hpp"
#include "core/range_slam/known_landmarks.hpp"
#include "core/range_slam/log_checks.hpp"
#include "core/range_slam/refinement/free_of_frame.hpp"
#include "core/range_slam/refinement/refine_starts.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kMostWithCovariances = 500;  ///< Landmarks.

}  // namespace

std::string RefineOptions::problem(Eigen::Index n) const {
  if (std::string problem = odometry.problem(); !problem.empty()) return problem;
  if (!(range_sigma_m > 0.0)) return "the standard deviation of ranges must be positive";
  if (!(huber > 0.0)) return "Huber's bound must be positive";
  if (!(offset_sigma_m >= 0.0)) return "the standard deviation of offsets cannot be negative";
  if (!(spacing_m >= 0.0 && coarse_spacing_m >= 0.0))
    return "the spacing of poses cannot be negative";
  if (most_iterations < 1) return "a refinement needs an iteration";
  if (covariances < 0) return "the number of covariances cannot be negative";
  if (covariances > 0 && n > kMostWithCovariances)
    return fmt::format("covariances are for at most {} landmarks", kMostWithCovariances);
  if (!known) return "";
  if (known->rows.size() < 2) return "known landmarks are two or more, or none";
  return known_problem(*known, n);
}

namespace {

/// A factor's pivots below this share of the matrix's diagonal are rounding.
constexpr double kLeastPivot = 1e-13;

/// L of A = L L'; empty where a pivot is no more than rounding of `diagonal`.
template <typename Matrix>
std::optional<Matrix> factor(const Matrix& A, const Eigen::VectorXd& diagonal) {
  if (A.rows() == 0) return A;
  const Eigen::LLT<Matrix> llt(A);
  if (llt.info() != Eigen::Success) return std::nullopt;
  Matrix L = llt.matrixL();
  const Eigen::ArrayXd pivots = L.diagonal().array().square();
  if (!(pivots > kLeastPivot * diagonal.array()).all()) return std::nullopt;
  return L;
}

template <typename Matrix>
Matrix inverse_of(const Matrix& L) {
  if (L.rows() == 0) return L;
  const Matrix inverse =
      L.template triangularView<Eigen::Lower>().solve(Matrix::Identity(L.rows(), L.cols()));
  return inverse.transpose() * inverse;
}

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// Below this distance a landmark is in no direction.
constexpr double kNoDirection_m = 1e-9;

/// d(R(angle) v) / d angle.
Eigen::Vector2d turning(double angle, const Eigen::Vector2d& v) {
  const Eigen::Vector2d turned = Eigen::Rotation2Dd(angle) * v;
  return {-turned(1), turned(0)};
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What Ceres logs goes to stderr however quiet its options are. Once: threads of a sweep solve
/// side by side, and the level is one plain number for all.
void silence_log() {
  static std::once_flag once;
  std::call_once(once, [] { FLAGS_minloglevel = google::GLOG_FATAL; });
}

ceres::Solver::Options solver_options(int most_iterations) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  // Eigen's own factor: the others go through a BLAS whose kernels change with the machine.
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.num_threads = 1;
  options.max_num_iterations = most_iterations;
  options.function_tolerance = 1e-9;
  options.parameter_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  options.minimizer_progress_to_stdout = false;
  return options;
}

}  // namespace

ChainInformation::ChainInformation(Eigen::Index poses, Eigen::Index shared)
    : D_(static_cast<std::size_t>(poses), Eigen::Matrix3d::Zero()),
      O_(static_cast<std::size_t>(poses), Eigen::Matrix3d::Zero()),
      B_(static_cast<std::size_t>(poses), Eigen::MatrixXd::Zero(shared, 3)),
      C_(Eigen::MatrixXd::Zero(shared, shared)) {}

void ChainInformation::add(Eigen::Index i, const Eigen::MatrixXd& J_first,
                           const Eigen::MatrixXd& J_second,
                           const std::vector<Eigen::Index>& columns,
                           const Eigen::MatrixXd& J_shared) {
  const auto first = static_cast<std::size_t>(i);
  const auto second = static_cast<std::size_t>(i + 1);
  const bool has_first = i >= 0;
  const bool has_second = J_second.size() > 0;
  if (has_first) D_[first] += J_first.transpose() * J_first;
  if (has_second) D_[second] += J_second.transpose() * J_second;
  if (has_first && has_second) O_[first] += J_second.transpose() * J_first;
  for (std::size_t a = 0; a < columns.size(); ++a) {
    const Eigen::RowVectorXd column = J_shared.col(static_cast<Eigen::Index>(a)).transpose();
    if (has_first) B_[first].row(columns[a]) += column * J_first;
    if (has_second) B_[second].row(columns[a]) += column * J_second;
    for (std::size_t b = 0; b < columns.size(); ++b)
      C_(columns[a], columns[b]) += column.dot(J_shared.col(static_cast<Eigen::Index>(b)));
  }
}

std::optional<ChainInformation::Covariance> ChainInformation::inverse() const {
  const std::size_t poses = D_.size();
  // Elimination from the first pose on: S_i is what is left of D_i, G_i = O_i S_i^-1 carries it on,
  // and R_i is what is left of B_i.
  std::vector<Eigen::Matrix3d> S_inverse(poses);
  std::vector<Eigen::MatrixXd> R = B_;
  Eigen::MatrixXd C = C_;
  Eigen::Matrix3d S = D_[0];
  for (std::size_t i = 0; i < poses; ++i) {
    const auto L = factor<Eigen::Matrix3d>(S, D_[i].diagonal());
    if (!L) return std::nullopt;
    S_inverse[i] = inverse_of(*L);
    C -= R[i] * S_inverse[i] * R[i].transpose();
    if (i + 1 == poses) break;
    const Eigen::Matrix3d G = O_[i] * S_inverse[i];
    S = D_[i + 1] - G * O_[i].transpose();
    R[i + 1] -= R[i] * G.transpose();
  }
  const auto L = factor<Eigen::MatrixXd>(C, C_.diagonal());
  if (!L) return std::nullopt;

  // Back: of each pose the inverse's block, and that towards the shared numbers.
  Covariance covariance{.shared = inverse_of(*L),
                        .poses = std::vector<Eigen::Matrix3d>(poses),
                        .shared_pose = std::vector<Eigen::MatrixXd>(poses)};
  Eigen::Matrix3d next = Eigen::Matrix3d::Zero();
  Eigen::MatrixXd next_shared = Eigen::MatrixXd::Zero(C.rows(), 3);
  for (std::size_t i = poses; i-- > 0;) {
    // x_i depends on what comes after it by x_i = -S_i^-1 (O_i' x_{i+1} + R_i' shared) + noise.
    const Eigen::Matrix3d A = -S_inverse[i] * O_[i].transpose();
    const Eigen::MatrixXd E = -S_inverse[i] * R[i].transpose();
    const Eigen::Matrix3d cross = A * next_shared.transpose() * E.transpose();
    covariance.shared_pose[i] = next_shared * A.transpose() + covariance.shared * E.transpose();
    covariance.poses[i] = S_inverse[i] + A * next * A.transpose() +
                          E * covariance.shared * E.transpose() + cross + cross.transpose();
    next = covariance.poses[i];
    next_shared = covariance.shared_pose[i];
  }
  return covariance;
}

bool MotionResidual::Evaluate(double const* const* parameters, double* residuals,
                              double** jacobians) const {
  const Eigen::Map<const Eigen::Vector3d> first(parameters[0]);
  const Eigen::Map<const Eigen::Vector3d> second(parameters[1]);
  const Eigen::Vector2d way = second.head<2>() - first.head<2>();
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(-first(2)).toRotationMatrix();
  Eigen::Vector3d error;
  error.head<2>() = R * way - motion_.step.head<2>();
  error(2) = second(2) - first(2) - motion_.step(2);
  Eigen::Map<Eigen::Vector3d> whitened(residuals);
  whitened = motion_.root_information * error;
  if (jacobians == nullptr) return true;

  if (jacobians[0] != nullptr) {
    Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
    J.topLeftCorner<2, 2>() = -R;
    J.topRightCorner<2, 1>() = -turning(-first(2), way);
    J(2, 2) = -1.0;
    Eigen::Map<RowMajor3> jacobian(jacobians[0]);
    jacobian = motion_.root_information * J;
  }
  if (jacobians[1] != nullptr) {
    Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
    J.topLeftCorner<2, 2>() = R;
    Eigen::Map<RowMajor3> jacobian(jacobians[1]);
    jacobian = motion_.root_information * J;
  }
  return true;
}

bool RangeResidual::Evaluate(double const* const* parameters, double* residuals,
                             double** jacobians) const {
  const Eigen::Map<const Eigen::Vector3d> first(parameters[0]);
  const Eigen::Map<const Eigen::Vector3d> second(parameters[1]);
  const Eigen::Map<const Eigen::Vector2d> landmark(parameters[2]);
  const double scale = parameters[3][0];
  const double offset_m = parameters[4][0];
  const Eigen::Vector2d gap = place_.pose(first, second).head<2>() - landmark;
  const double distance = gap.norm();
  residuals[0] = (scale * distance + offset_m - range_m_) / sigma_m_;
  if (jacobians == nullptr) return true;

  const Eigen::Vector2d direction =
      distance > kNoDirection_m ? Eigen::Vector2d(gap / distance) : Eigen::Vector2d::Zero();
  const Eigen::Vector2d slope = scale / sigma_m_ * direction;
  const auto fill_pose = [&](double* jacobian, double weight, double heading,
                             const Eigen::Vector3d& step) {
    if (jacobian == nullptr) return;
    Eigen::Map<Eigen::RowVector3d> row(jacobian);
    row.head<2>() = weight * slope.transpose();
    row(2) = weight * slope.dot(turning(heading, step.head<2>()));
  };
  fill_pose(jacobians[0], 1.0 - place_.share, first(2), place_.ahead);
  fill_pose(jacobians[1], place_.share, second(2), place_.behind);
  if (jacobians[2] != nullptr) Eigen::Map<Eigen::RowVector2d>{jacobians[2]} = -slope.transpose();
  if (jacobians[3] != nullptr) jacobians[3][0] = distance / sigma_m_;
  if (jacobians[4] != nullptr) jacobians[4][0] = 1.0 / sigma_m_;
  return true;
}

bool OffsetPrior::Evaluate(double const* const* parameters, double* residuals,
                           double** jacobians) const {
  residuals[0] = parameters[0][0] / sigma_m_;
  if (jacobians != nullptr && jacobians[0] != nullptr) jacobians[0][0] = 1.0 / sigma_m_;
  return true;
}

RefineProblem::RefineProblem(const RangeLog& log, const KeyPoses& keys,
                             const std::vector<bool>& is_placed, const RefineOptions& options)
    : options_(options), is_placed_(is_placed), is_known_(is_placed.size(), false) {
  if (options.known)
    for (const Eigen::Index row : options.known->rows)
      is_known_[static_cast<std::size_t>(row)] = true;
  for (const KeyMotion& motion : keys.motions())
    motions_.push_back(std::make_unique<MotionResidual>(motion));
  const Eigen::VectorXd& times = keys.path().time_s;
  for (const RangeMeasurement& measured : log.ranges) {
    const auto landmark = static_cast<std::size_t>(measured.landmark);
    if (!is_placed_[landmark] || measured.time_s < times(0) ||
        measured.time_s > times(times.size() - 1))
      continue;
    const BetweenPoses position = keys.at(measured.time_s);
    ranges_.push_back({.residual = std::make_unique<RangeResidual>(position, measured.range_m,
                                                                   options.range_sigma_m),
                       .before = position.before,
                       .landmark = landmark});
  }
}

RefineProblem::Outcome RefineProblem::solve(RefineState& state) const {
  silence_log();
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.disable_all_safety_checks = true;
  ceres::Problem problem(ownership);
  ceres::HuberLoss huber(options_.huber);
  for (std::size_t i = 0; i < motions_.size(); ++i)
    problem.AddResidualBlock(motions_[i].get(), nullptr, state.poses[i].data(),
                             state.poses[i + 1].data());
  for (const Range& range : ranges_) {
    const auto before = static_cast<std::size_t>(range.before);
    problem.AddResidualBlock(range.residual.get(), &huber, state.poses[before].data(),
                             state.poses[before + 1].data(), state.landmarks[range.landmark].data(),
                             &state.scale, &state.offsets_m[range.landmark]);
  }
  if (holds_first_pose()) problem.SetParameterBlockConstant(state.poses[0].data());
  if (!options_.estimate_scale && !ranges_.empty()) problem.SetParameterBlockConstant(&state.scale);
  std::vector<std::unique_ptr<OffsetPrior>> priors;
  for (std::size_t n = 0; n < is_placed_.size(); ++n) {
    if (!problem.HasParameterBlock(state.landmarks[n].data())) continue;
    if (is_held(n)) problem.SetParameterBlockConstant(state.landmarks[n].data());
    if (options_.offset_sigma_m > 0.0) {
      priors.push_back(std::make_unique<OffsetPrior>(options_.offset_sigma_m));
      problem.AddResidualBlock(priors.back().get(), nullptr, &state.offsets_m[n]);
    } else {
      problem.SetParameterBlockConstant(&state.offsets_m[n]);
    }
  }
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(options_.most_iterations), &problem, &summary);
  return {.is_usable = summary.IsSolutionUsable() && std::isfinite(summary.final_cost),
          .has_converged = summary.termination_type == ceres::CONVERGENCE,
          .cost = summary.final_cost,
          .iterations = summary.num_successful_steps + summary.num_unsuccessful_steps};
}

RefineProblem::Shared RefineProblem::shared() const {
  Shared shared;
  std::vector<bool> has_range(is_placed_.size(), false);
  for (const Range& range : ranges_) has_range[range.landmark] = true;
  for (std::size_t n = 0; n < is_placed_.size(); ++n) {
    shared.landmarks.push_back(is_held(n) ? -1 : shared.count);
    if (!is_held(n)) shared.count += 2;
  }
  if (options_.estimate_scale) shared.scale = shared.count++;
  for (std::size_t n = 0; n < is_placed_.size(); ++n) {
    const bool is_free = options_.offset_sigma_m > 0.0 && has_range[n];
    shared.offsets.push_back(is_free ? shared.count++ : -1);
  }
  return shared;
}

void RefineProblem::add_motions(const RefineState& state, ChainInformation& information) const {
  const Eigen::Index held = holds_first_pose() ? 1 : 0;
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const double* parameters[] = {state.poses[i].data(), state.poses[i + 1].data()};
    Eigen::Vector3d residual;
    RowMajor first(3, 3);
    RowMajor second(3, 3);
    double* jacobians[] = {first.data(), second.data()};
    motions_[i]->Evaluate(parameters, residual.data(), jacobians);
    information.add(static_cast<Eigen::Index>(i) - held, first, second, {}, {});
  }
}

void RefineProblem::add_ranges(const RefineState& state, const Shared& shared,
                               ChainInformation& information) const {
  const Eigen::Index held = holds_first_pose() ? 1 : 0;
  for (const Range& range : ranges_) {
    const auto before = static_cast<std::size_t>(range.before);
    const double* parameters[] = {state.poses[before].data(), state.poses[before + 1].data(),
                                  state.landmarks[range.landmark].data(), &state.scale,
                                  &state.offsets_m[range.landmark]};
    double residual = 0.0;
    RowMajor first(1, 3);
    RowMajor second(1, 3);
    Eigen::Vector4d rest;  // landmark, scale, offset
    double* jacobians[] = {first.data(), second.data(), rest.data(), rest.data() + 2,
                           rest.data() + 3};
    range.residual->Evaluate(parameters, &residual, jacobians);
    // Huber's weight is the slope of the loss in the squared residual.
    const double root =
        std::sqrt(std::abs(residual) > options_.huber ? options_.huber / std::abs(residual) : 1.0);
    std::vector<Eigen::Index> columns;
    std::vector<double> values;
    const auto take = [&](Eigen::Index column, double value) {
      columns.push_back(column);
      values.push_back(root * value);
    };
    if (const Eigen::Index column = shared.landmarks[range.landmark]; column >= 0) {
      take(column, rest(0));
      take(column + 1, rest(1));
    }
    if (shared.scale >= 0) take(shared.scale, rest(2));
    if (const Eigen::Index column = shared.offsets[range.landmark]; column >= 0)
      take(column, rest(3));
    information.add(
        range.before - held, root * first, root * second, columns,
        Eigen::Map<Eigen::RowVectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  }
}

std::optional<RefineProblem::Covariances> RefineProblem::covariances(
    const RefineState& state) const {
  const Shared positions = shared();
  const Eigen::Index held = holds_first_pose() ? 1 : 0;
  ChainInformation information(static_cast<Eigen::Index>(state.poses.size()) - held,
                               positions.count);
  add_motions(state, information);
  add_ranges(state, positions, information);
  for (const Eigen::Index column : positions.offsets)
    if (column >= 0)
      information.add(-1, {}, {}, {column},
                      Eigen::MatrixXd::Constant(1, 1, 1.0 / options_.offset_sigma_m));
  auto inverse = information.inverse();
  if (!inverse) return std::nullopt;
  if (held == 1) {
    inverse->poses.insert(inverse->poses.begin(), Eigen::Matrix3d::Zero());
    inverse->shared_pose.insert(inverse->shared_pose.begin(),
                                Eigen::MatrixXd::Zero(positions.count, 3));
  }
  Covariances covariances;
  covariances.are_of_first_pose =
      held == 1 &&
      !free_of_frame(
          {.poses = state.poses, .landmarks = state.landmarks, .columns = positions.landmarks},
          inverse->shared, inverse->poses, inverse->shared_pose);
  for (std::size_t n = 0; n < is_placed_.size(); ++n) {
    const Eigen::Index column = positions.landmarks[n];
    covariances.landmarks.emplace_back(Eigen::Matrix2d::Constant(is_placed_[n] ? 0.0 : kNaN));
    if (column >= 0) covariances.landmarks.back() = inverse->shared.block<2, 2>(column, column);
  }
  for (const Eigen::Matrix3d& pose : inverse->poses)
    covariances.positions.emplace_back(pose.topLeftCorner<2, 2>());
  return covariances;
}

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
