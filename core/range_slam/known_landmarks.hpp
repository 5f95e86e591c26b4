#pragma once

#include <string>
#include <vector>

#include "core/model/points.hpp"
#include "core/range_slam/factors/factorization.hpp"
#include "core/range_slam/factors/spectral_map.hpp"

namespace mapproof {

/// Landmarks whose position is given.
struct KnownLandmarks {
  std::vector<Eigen::Index> rows;  ///< In the map, all different.
  Points positions_m;              ///< As many as rows.
};

/// A known set at or above this condition number counts as degenerate.
inline constexpr double kDegenerateCondition = 1e6;

/// Map and path from the positions of four landmarks or more, by linear regression from U to C
/// [boots2013, algorithm 1, line 3].
///
/// The mean of X's first row, which should be 1, is the square of a common scale of the ranges;
/// it is divided out and returned.
/// @param factors  Of rank 4 or more.
/// @param known    Finite.
/// @return Empty with kTooFewObservations below four known landmarks, with kDegenerateGeometry
///         where they lie on one line or circle, with kFailed where the ranges do not determine
///         positions; `condition` is that of their C about their centre, in units of their spread.
/// @throws InvalidInput if a bound is broken.
/// @note O(T) time.
SpectralMap map_from_known_landmarks(const Factorization& factors, const KnownLandmarks& known);

/// The same in d dimensions: from d + 2 known positions or more, on no one hyperplane or sphere.
/// @param factors      Of rank d + 2 or more.
/// @param rows         In the map, all different.
/// @param positions_m  As many as rows, x d; finite.
SpectralMap map_from_known_positions(const Factorization& factors,
                                     const std::vector<Eigen::Index>& rows,
                                     const Eigen::MatrixXd& positions_m);

/// Why known landmarks cannot be used with n landmarks: a position for each of some different
/// rows is needed; empty if nothing.
std::string known_problem(const KnownLandmarks& known, Eigen::Index n);
std::string known_problem(const std::vector<Eigen::Index>& rows, const Eigen::MatrixXd& positions_m,
                          Eigen::Index n);

}  // namespace mapproof
