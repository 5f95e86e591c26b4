#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/range_slam/factors/factorization.hpp"
#include "core/range_slam/factors/spectral_map.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

/// Squared ranges over what odometry says the robot moved, for the state with heading.
struct HeadingColumns {
  Eigen::MatrixXd Y;                ///< 2N x K: 1/2 d^2, then its change over the distance moved.
  std::vector<Eigen::Index> steps;  ///< K: the step that each column begins at.
};

/// Rows n hold 1/2 d_nt^2, rows N + n hold (d_n,t+1^2 - d_nt^2) / (2 v_t) = [m, 1] [-cos, -sin,
/// (|p_t+1|^2 - |p_t|^2) / (2 v_t)]'. Steps that moved less than `least_m` are left out: there the
/// quotient is noise.
/// @param half_squares  N x T, finite.
/// @param moved_m       T - 1, by odometry; negative backwards.
/// @throws InvalidInput if a bound is broken, or unless least_m > 0.
HeadingColumns heading_columns(const Eigen::MatrixXd& half_squares, const Eigen::VectorXd& moved_m,
                               double least_m);

/// A map with the robot's headings.
struct HeadingMap {
  SpectralMap map;                  ///< X has K columns.
  Eigen::VectorXd heading_rad;      ///< K, in the frame of the map; empty without a map.
  Eigen::VectorXd singular_values;  ///< Of the 2N x K matrix, descending.
};

/// Range-only SLAM with the robot's headings, by the SVD of rank 7 [boots2013, eq. 4] of the
/// columns above: the state is [1, -x, -y, (x^2 + y^2)/2, -cos, -sin, (|p_t+1|^2 - |p_t|^2) / (2
/// v)].
///
/// The top block of U has rank 4: what is left after its null space is rotated away is upgraded as
/// without heading, or fixed by known landmarks; the last three states follow by regression on the
/// map.
/// @param known  Where empty, no landmark is known: the map is free to move and mirror.
/// @return kTooFewObservations below 4 landmarks or 8 columns.
/// @note O((2N)^2 K) time, as the paper has it.
HeadingMap map_with_heading(const HeadingColumns& columns,
                            const std::optional<KnownLandmarks>& known);

}  // namespace mapproof
