#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/graph/neighbours.hpp"
#include "core/model/certificate.hpp"

namespace mapproof::unfolding {

/// Two points whose distance is kept.
using Pair = std::pair<Eigen::Index, Eigen::Index>;

/// Maximum variance unfolding [weinberger2004] of points that stand for one landmark or several at
/// the same position:
///
///   max  sum_i mass_i |y_i|^2   s.t.  |y_i - y_j|^2 = squared_ij for all pairs,
///                                     sum_i mass_i y_i = 0,
///
/// a semidefinite program in K = Y Y'. Its dual, with L(w) the Laplacian of the weights w,
///
///   min  sum_ij w_ij squared_ij   s.t.  L(w) - diag(mass) + mass mass' / sum(mass) is psd.
struct Problem {
  Eigen::VectorXd mass;        ///< How many landmarks each point stands for.
  std::vector<Pair> pairs;     ///< Ascending, first < second, connecting all points.
  Eigen::VectorXd squared;     ///< Per pair, > 0, the largest 1.
  double scale = 1.0;          ///< Times `squared`: the unit of the data.
  double inconsistency = 0.0;  ///< How far squared distances that have to be one differ at most.
  std::vector<Eigen::Index> point_of;  ///< Of each landmark.

  Eigen::Index points() const { return mass.size(); }
  /// Whether all landmarks are at one position: then there are no pairs.
  bool is_one_point() const { return points() <= 1; }
};

/// All pairs within {i} and the neighbours listed of i, for every i, and all edges; ascending, the
/// first of a pair the lower.
std::vector<Pair> kept_pairs(const NeighbourLists& nearest, const Graph& graph);

/// The program that keeps the distances of all pairs within {i} and its K nearest, for every i, and
/// those of `bridges`. Landmarks at one position (squared distance up to 1e-14 of the largest)
/// become one point.
/// @param distances  n x n, symmetric, zero diagonal; pairs at infinite distance are left out.
/// @param graph      Whose edges are kept too (the bridges are among them).
Problem neighbourhood_problem(const Eigen::MatrixXd& distances, const NeighbourOptions& options,
                              const Graph& graph);

/// A solution: coordinates whose inner products are K, and the dual's weights.
struct Solution {
  SdpSolver solver = SdpSolver::kLowRank;
  Eigen::MatrixXd Y;  ///< points x rank; its mass-weighted mean is zero.
  Eigen::VectorXd w;  ///< Per pair, free of sign.
  int iterations = 0;
};

/// A solution with its dual certificate.
struct CertifiedSolution {
  Solution solution;
  Certificate certificate;
};

/// T = M^-1/2 L(w) M^-1/2 + 2 u u' with M = diag(mass) and u its unit vector of sqrt(mass): w is
/// feasible exactly if T >= I (the second term only lifts the eigenvalue 0 that L(w) always has).
Eigen::MatrixXd dual_matrix(const Problem& problem, const Eigen::VectorXd& w);

/// Certifies Y Y': w, scaled until it is feasible, gives an upper bound on every solution.
/// @note O(n^3) time.
Certificate certify(const Problem& problem, const Solution& solution);

}  // namespace mapproof::unfolding
