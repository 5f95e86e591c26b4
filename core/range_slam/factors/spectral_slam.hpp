#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"
#include "core/model/range_log.hpp"
#include "core/model/slam/slam.hpp"
#include "core/range_slam/factors/factorization.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"
#include "core/range_slam/factors/spectral_map.hpp"
#include "core/range_slam/factors/windowed_ranges.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

/// Landmarks, and a scale that all ranges share, determined by a path.
struct LandmarksOnPath {
  Points landmarks_m;  ///< N x 2.
  double range_scale =
      1.0;  ///< Measured range over distance; 1 where the path does not determine it.
};

/// The linear regression of squared ranges on a path, Y = b (|m|^2/2 - m'p + |p|^2/2), with one b
/// for all landmarks: the square of the range scale.
///
/// A metric upgrade in noise errs in the ratio of landmarks to path, which their products leave
/// free (m s and p / s), so that a path of the right scale leaves the landmarks to be determined.
/// @param positions_m  T x 2, not on one line. On a circle b is not determined, and taken for 1.
/// @param Y            N x T, 1/2 d^2, m^2.
/// @throws InvalidInput unless sizes agree, all is finite and the path spans the plane.
/// @note O(N T) time.
LandmarksOnPath landmarks_on_path(const Points& positions_m, const Eigen::MatrixXd& Y);

/// Squared ranges over the motion of the robot by odometry, for the state with heading.
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
/// @param known  Where empty, no landmark is known: the map is defined up to a rigid motion and a
/// reflection.
/// @return kTooFewObservations below 4 landmarks or 8 columns.
/// @note O((2N)^2 K) time, as the paper has it.
HeadingMap map_with_heading(const HeadingColumns& columns,
                            const std::optional<KnownLandmarks>& known);

/// A dead-reckoned path compared with a map that is defined up to a rigid motion, a reflection and
/// a scale.
struct OdometryFit {
  double scale = 1.0;      ///< Length on the map over length by odometry.
  bool mirrored = false;   ///< The map is reflected: its path turns against the robot.
  double agreement = 0.0;  ///< 0 if mirror image and original fit odometry alike, 1 if one alone.
};

/// Compares short pieces of both paths, each free to rotate and translate, so that the drift of
/// odometry over the whole does no harm: of each piece the similarity that takes the odometry to
/// the map, by least squares, as it is and mirrored.
/// @param positions_m, odometry_m  T x 2, the same times.
/// @param piece  Poses in a piece, >= 2.
/// @return Scale 1 and agreement 0 where nothing moves; scale 1 where the map does not.
/// @throws InvalidInput if a bound is broken.
OdometryFit fit_to_odometry(const Points& positions_m, const Points& odometry_m,
                            Eigen::Index piece);

struct SpectralSlamOptions {
  std::optional<KnownLandmarks> known{};  ///< Empty: no landmark is known.
  bool with_heading = false;              ///< By map_with_heading(): a factorisation of rank 7.
  std::optional<WindowOptions> window{};  ///< Empty: chosen by choose_window().
  double heading_step_m = 1.0;            ///< Travel from one column with heading to the next, > 0.
  int replicates = 0;      ///< Of bootstrap_landmarks(), blocks a window long; 0: no covariances.
  std::uint64_t seed = 1;  ///< Of the bootstrap.
};

/// The estimate, and how it came about.
struct SpectralSlam {
  SlamEstimate estimate;
  WindowSearch window;    ///< Without candidates where the window was given.
  MetricUpgrade upgrade;  ///< Where no landmark was known and heading not asked for.
  Eigen::MatrixXd Y;      ///< 1/2 d^2 at the times of the path, m^2: N x its size.
};

/// Spectral SLAM on a log of single measurements [boots2013]: windowed ranges at the odometry's
/// times, factorisation, map, and positions by localise().
///
/// No landmark known: odometry determines the reflection and the scale, and the map is defined up
/// to a rigid motion. No ground truth is used.
/// @param odometry  The dead-reckoned path, with headings where `with_heading`.
/// @return `path` at those times of odometry at which every landmark's range is determined
/// (kUndetermined
///         counts the others). With known landmarks positions are localise() of the map and Y;
///         without, odometry gives them their scale, and they the landmarks and the ranges theirs.
///         `range_scale` is that of the window times this correction, and Y is free of it;
///         `upgrade` is as it came. kUndetermined also where odometry does not distinguish the map
///         from its mirror image. Empty path, NaN landmarks and a status where no map came out:
///         kTooFewObservations if too few poses are determined; kDegenerateGeometry with a map
///         whose landmarks lie nearly on one line.
/// @throws InvalidInput if a bound is broken: for ranges that check_ranges() refuses, a
///         path_problem(), a known_problem(), a windowed_size_problem().
SpectralSlam spectral_slam(const RangeLog& log, const Trajectory& odometry,
                           const SpectralSlamOptions& options = {});

}  // namespace mapproof
