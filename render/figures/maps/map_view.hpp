#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/model/map_record.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// Limits of both axes.
struct PanelBox {
  Range x, y;
  bool holds(double px, double py) const {
    return x.low <= px && px <= x.high && y.low <= py && py <= y.high;
  }
};

/// What a map figure shows of its record, row by row.
struct MapView {
  std::vector<bool> has_estimate;
  std::vector<bool> has_truth;
  std::vector<bool> is_anchor;
  std::vector<double> error_m;         ///< NaN unless both places are known, in the frame of truth.
  std::vector<Eigen::Index> worst;     ///< Rows of the greatest errors, no anchors, worst first.
  std::vector<Eigen::Index> unmapped;  ///< Rows without an estimate.
  std::vector<Eigen::Index> outside;   ///< Rows whose estimate lies outside `limits`.
  std::optional<PanelBox> limits;      ///< Set if some estimates are too far off to be shown.
};

/// @throws InvalidInput if the record's parts disagree in size or hold infinities.
MapView view_of(const MapRecord& record);

}  // namespace mapproof
