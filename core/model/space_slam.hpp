#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/slam.hpp"
#include "core/model/space_points.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// Path and landmarks in space that were estimated from ranges alone.
struct SpaceEstimate {
  SpacePoints landmarks_m;            ///< N x 3; NaN rows: no place came out.
  SpacePoints positions_m;            ///< T x 3, at the times of the ranges; 0 x 3: none.
  double range_scale = 1.0;           ///< Measured range over distance, where it can be told.
  Eigen::VectorXd singular_values;    ///< Of the squared ranges, descending.
  std::optional<double> noise_level;  ///< The singular value that noise alone reaches.
  std::optional<double> condition;    ///< Of the regression or upgrade.
  std::vector<Status> statuses;       ///< Empty if all went well.

  bool empty() const { return positions_m.rows() == 0; }
};

/// What came of one flight's ranges: with some landmarks known, or with none.
struct SpaceRecord {
  bool knows_landmarks = false;
  SpaceEstimate estimate;                   ///< In the frame of the truth, after the alignment.
  Alignment alignment = Alignment::kNone;   ///< With mirror where no landmark is known.
  std::optional<double> landmarks_error_m;  ///< Mean distances from the truth; empty: no map.
  std::optional<double> positions_error_m;
};

/// A simulated flight over landmarks at various heights, ranged to all at every step.
struct SpaceRun {
  SpacePoints landmarks_m;           ///< N x 3, the truth.
  SpacePoints positions_m;           ///< T x 3, the truth.
  std::vector<Eigen::Index> known;   ///< Rows whose place one record was given.
  std::string noise;                 ///< In words.
  std::vector<SpaceRecord> records;  ///< With known landmarks first.
};

}  // namespace mapproof
