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
/// it means nothing.
enum class Alignment {
  kNone,                 ///< Compared as it came: known landmarks or a given start tie the frame.
  kRigid,                ///< Best rotation and translation.
  kRigidWithReflection,  ///< Best rotation, translation and mirror.
  kSimilarity,           ///< Best rotation, translation and scale.
};

/// The name used in files: "none", "rigid", "rigid-with-reflection", "similarity".
std::string_view name(Alignment alignment);

/// Path and landmarks that one range-only method estimated.
struct SlamEstimate {
  Trajectory path;
  Points landmarks_m;                            ///< N x 2; NaN rows: no place came out.
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
  std::optional<double> landmarks_m;  ///< Mean over the landmarks that have a true place.
  Eigen::Index poses = 0;             ///< True poses that were compared.
};

}  // namespace mapproof
