#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"
#include "core/model/range_log.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// How an estimated path was aligned to the true one before its error was taken. An error without
/// it has no meaning.
enum class Alignment {
  kNone,                 ///< Compared as it came: known landmarks or a given start tie the frame.
  kRigid,                ///< Best rotation and translation.
  kRigidWithReflection,  ///< Best rotation, translation and reflection.
  kSimilarity,           ///< Best rotation, translation and scale.
};

/// The name used in files: "none", "rigid", "rigid-with-reflection", "similarity".
std::string_view name(Alignment alignment);

/// Path and landmarks that one range-only method estimated.
struct SlamEstimate {
  Trajectory path;
  Points landmarks_m;                            ///< N x 2; NaN rows: no position was found.
  double range_scale = 1.0;                      ///< Measured range over distance, as estimated.
  std::vector<Eigen::Matrix2d> landmark_cov_m2;  ///< N, or empty if not asked for.
  std::vector<Eigen::Matrix2d> position_cov_m2;  ///< At `position_cov_rows`; may be empty.
  std::vector<Eigen::Index> position_cov_rows;   ///< Rows of `path`.
  Eigen::VectorXd singular_values;               ///< Descending; empty if not spectral.
  std::optional<double> noise_level;             ///< The singular value that noise alone reaches.
  std::optional<double> condition;               ///< Of the regression or upgrade.
  int iterations = 0;                            ///< Of an iterative method; 0 otherwise.
  std::optional<double> cost;                    ///< Final half sum of robust squared residuals.
  std::vector<Status> statuses;                  ///< Empty if all went well.
  Eigen::VectorXd range_offsets_m;  ///< N, added to all ranges of a landmark; or empty.
};

/// Position errors of a path after an alignment.
struct TrajectoryError {
  Alignment alignment = Alignment::kNone;
  double mean_m = 0.0;
  double rmse_m = 0.0;
  double last_tenth_m = 0.0;          ///< Mean over the last 10 % of the time.
  double best_tenth_m = 0.0;          ///< Least mean over 10 % of the time in one piece.
  double worst_tenth_m = 0.0;         ///< Greatest mean over 10 % of the time in one piece.
  std::optional<double> landmarks_m;  ///< Mean over the landmarks that have a true position.
  Eigen::Index poses = 0;             ///< True poses that were compared.
};

/// Path and landmarks in space that were estimated from ranges alone.
struct SpaceEstimate {
  SpacePoints landmarks_m;            ///< N x 3; NaN rows: no position was found.
  SpacePoints positions_m;            ///< T x 3, at the times of the ranges; 0 x 3: none.
  double range_scale = 1.0;           ///< Measured range over distance, where it can be determined.
  Eigen::VectorXd singular_values;    ///< Of the squared ranges, descending.
  std::optional<double> noise_level;  ///< The singular value that noise alone reaches.
  std::optional<double> condition;    ///< Of the regression or upgrade.
  std::vector<Status> statuses;       ///< Empty if all went well.

  bool empty() const { return positions_m.rows() == 0; }
};

/// What came of one flight's ranges: with some landmarks known, or with none.
struct SpaceRecord {
  bool knows_landmarks = false;
  SpaceEstimate estimate;  ///< In the frame of the ground truth, after the alignment.
  Alignment alignment = Alignment::kNone;  ///< With reflection where no landmark is known.
  std::optional<double>
      landmarks_error_m;  ///< Mean distances from the ground truth; empty: no map.
  std::optional<double> positions_error_m;
};

/// A simulated flight over landmarks at various heights, ranged to all at every step.
struct SpaceRun {
  SpacePoints landmarks_m;           ///< N x 3, the true positions.
  SpacePoints positions_m;           ///< T x 3, the true positions.
  std::vector<Eigen::Index> known;   ///< Rows whose position was given to one record.
  std::string noise;                 ///< In words.
  std::vector<SpaceRecord> records;  ///< With known landmarks first.
};

}  // namespace mapproof
