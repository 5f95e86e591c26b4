#pragma once

#include <optional>
#include <string>
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
  std::vector<bool> has_ground_truth;
  std::vector<bool> is_anchor;
  std::vector<double>
      error_m;  ///< NaN unless both positions are known, in the frame of the ground truth.
  std::vector<Eigen::Index> worst;     ///< Rows of the greatest errors, no anchors, worst first.
  std::vector<Eigen::Index> unmapped;  ///< Rows without an estimate.
  std::vector<Eigen::Index> outside;   ///< Rows whose estimate lies outside `limits`.
  std::optional<PanelBox> limits;      ///< Those given, or of what is shown if some
                                       ///< estimates are too far off.
};

/// @param limits  Of the figure; unset: all but estimates that are too far off.
/// @throws InvalidInput if the record's parts disagree in size or hold infinities.
MapView view_of(const MapRecord& record, const std::optional<PanelBox>& limits = std::nullopt);

/// One map: ground truth as open circles, estimates as dots, joined by lines; anchors as squares;
/// the worst landmarks labelled. Estimates far outside the room become arrows at the frame, and the
/// figure says so. Of more than 5000 landmarks some 1000 are drawn, which the figure states.
/// Statuses are drawn below the title.
///
/// @param id    Of the figure, [a-z][a-z0-9-]*.
/// @param what  What it shows, where method, sensor and steps of the record do not: its
///              title, and the start of its caption. Empty: they do.
/// @throws InvalidInput if the record's parts disagree in size.
/// @note Pure: O(landmarks).
Figure map_figure(const MapRecord& record, const std::string& id, const std::string& what = "");

/// What the marks of maps in metres are, of those that the panels have: "Open circles: true
/// positions; dots: estimates, joined by their errors; squares: anchors."
std::string marks_text(const std::vector<Panel>& panels);

/// The panel of map_figure, for figures of several maps: each mark's id begins with `prefix`.
/// @param limits  As of view_of().
/// @throws InvalidInput as map_figure.
Panel map_panel(const MapRecord& record, const std::string& prefix,
                const std::optional<PanelBox>& limits = std::nullopt);

}  // namespace mapproof
