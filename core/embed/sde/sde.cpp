#include "core/embed/sde/sde.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/embed/connected_graph.hpp"
#include "core/embed/sde/csdp.hpp"
#include "core/embed/sde/interior_point.hpp"
#include "core/embed/sde/lagrangian.hpp"
#include "core/graph/shortest_paths.hpp"
#include "core/linalg/centering.hpp"
#include "core/linalg/sign.hpp"
#include "core/linalg/symmetric_eigen.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kMostPairsToAskAgain = 2000;

void check(const Eigen::MatrixXd& distances, const SdeOptions& options) {
  if (distances.rows() < 3 || distances.cols() != distances.rows())
    throw InvalidInput("SDE needs a square matrix of at least 3 landmarks");
  for (const double bound : {options.relative_gap, options.constraint_residual})
    if (!(bound > 0.0 && bound < 1.0)) throw InvalidInput("SDE needs tolerances between 0 and 1");
}

/// Inner products by classical scaling of all distances: near to feasible, as the data are.
Eigen::MatrixXd data_gram(const unfolding::Problem& problem, const Eigen::MatrixXd& distances) {
  std::vector<Eigen::Index> first(static_cast<std::size_t>(problem.points()));
  for (std::size_t i = problem.point_of.size(); i-- > 0;)
    first[static_cast<std::size_t>(problem.point_of[i])] = static_cast<Eigen::Index>(i);
  const Eigen::MatrixXd complete =
      distances.allFinite() ? distances : completed_distances(distances);
  const Eigen::MatrixXd relative = complete(first, first) / std::sqrt(problem.scale);
  return double_centered(relative.cwiseAbs2());
}

/// Coordinates of the data, of a rank that suffices.
Eigen::MatrixXd low_rank_start(const unfolding::Problem& problem, const Eigen::MatrixXd& gram) {
  // Some point of the optimal face has at most this rank (Pataki's bound); most have less.
  const double bound = std::sqrt(2.0 * static_cast<double>(problem.squared.size()));
  const auto rank = std::min(
      {static_cast<Eigen::Index>(std::ceil(0.7 * bound)), problem.points() - 1, Eigen::Index{60}});
  const EigenPairs pairs = largest_eigenpairs(gram, rank);
  return pairs.vectors * pairs.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

bool meets(const Certificate& certificate, const SdeOptions& options) {
  return certificate.relative_gap <= options.relative_gap &&
         certificate.constraint_residual <= options.constraint_residual;
}

unfolding::CertifiedSolution certified(const unfolding::Problem& problem,
                                       unfolding::Solution solution) {
  const Certificate certificate = unfolding::certify(problem, solution);
  return {.solution = std::move(solution), .certificate = certificate};
}

/// Whether a bound shows that no points have the distances: a variance is not below zero.
bool is_impossible(const Certificate& certificate) { return certificate.dual < 0.0; }

/// By the requested solver; where ours decides nothing, CSDP runs too if that is cheap.
unfolding::CertifiedSolution solve(const unfolding::Problem& problem,
                                   const Eigen::MatrixXd& distances, const SdeOptions& options) {
  if (options.solver == SdpSolver::kCsdp)
    return certified(problem, unfolding::solve_with_csdp(problem).solution);
  const Eigen::MatrixXd gram = data_gram(problem, distances);
  if (options.solver == SdpSolver::kLowRank ||
      problem.squared.size() > unfolding::kMostInteriorPairs)
    return unfolding::solve_low_rank(
        problem, low_rank_start(problem, gram),
        {.relative_gap = options.relative_gap, .constraint_residual = options.constraint_residual});
  unfolding::CertifiedSolution own = unfolding::solve_by_interior_point(
      problem, gram,
      {.relative_gap = options.relative_gap, .constraint_residual = options.constraint_residual});
  if (meets(own.certificate, options) || is_impossible(own.certificate) ||
      problem.squared.size() > kMostPairsToAskAgain)
    return own;
  unfolding::CertifiedSolution other =
      certified(problem, unfolding::solve_with_csdp(problem).solution);
  return meets(other.certificate, options) ? other : own;
}

/// What was not certified, and by how much.
Status shortfall(const Certificate& certificate, const SdeOptions& options) {
  if (is_impossible(certificate))
    return status_of<StatusReason::kBoundBelowZero>(certificate.constraint_residual);
  const double excess = certificate.constraint_residual > options.constraint_residual
                            ? certificate.constraint_residual
                            : 0.0;
  if (!std::isfinite(certificate.dual)) return status_of<StatusReason::kNoBound>(excess);
  if (!(certificate.relative_gap > options.relative_gap))
    return status_of<StatusReason::kDistancesNotKept>(excess);
  if (certificate.dual < certificate.primal)
    return status_of<StatusReason::kVarianceTooGreat>(100.0 * certificate.dual / certificate.primal,
                                                      excess);
  return status_of<StatusReason::kLooseBound>(100.0 * certificate.relative_gap, excess);
}

/// Eigenvalues up to `floor` of the largest carry no direction.
void put_coordinates(const unfolding::Problem& problem, const Eigen::MatrixXd& Y, double floor,
                     Embedding& result) {
  const Eigen::MatrixXd rows = Y(problem.point_of, Eigen::all) * std::sqrt(problem.scale);
  // Y Y' has the eigenvalues of the smaller Y' Y.
  const Eigen::Index rank = std::min<Eigen::Index>(rows.cols(), 10);
  const EigenPairs pairs = largest_eigenpairs(rows.transpose() * rows, rank);
  result.spectrum = pairs.values.cwiseMax(0.0);
  result.coordinates.setZero(rows.rows(), 2);
  Eigen::Index axes = 0;
  for (;
       axes < std::min<Eigen::Index>(rank, 2) && result.spectrum(axes) > floor * result.spectrum(0);
       ++axes)
    result.coordinates.col(axes) = rows * pairs.vectors.col(axes);
  fix_signs(result.coordinates);
  if (axes < 2) result.statuses.push_back(status_of<StatusReason::kUnfoldedFlat>(axes));
}

}  // namespace

Embedding sde(const Eigen::MatrixXd& distances, const SdeOptions& options) {
  check(distances, options);
  const ConnectedGraph graph = connected_neighbour_graph(distances, options.neighbours);
  Embedding result;
  result.statuses = graph.statuses;
  if (!graph.connected) {
    result.coordinates.setConstant(distances.rows(), 2, kNaN);
    return result;
  }
  const unfolding::Problem problem =
      unfolding::neighbourhood_problem(distances, options.neighbours, graph.graph);
  if (problem.is_one_point()) {
    put_coordinates(problem, Eigen::MatrixXd::Zero(1, 1), 0.0, result);
    return result;
  }
  const unfolding::CertifiedSolution answer = solve(problem, distances, options);
  result.iterations = answer.solution.iterations;
  result.certificate = answer.certificate;
  // What is below the accuracy of the solve is not a spread.
  put_coordinates(problem, answer.solution.Y, options.relative_gap + options.constraint_residual,
                  result);
  if (!meets(answer.certificate, options))
    result.statuses.push_back(shortfall(answer.certificate, options));
  return result;
}

}  // namespace mapproof
