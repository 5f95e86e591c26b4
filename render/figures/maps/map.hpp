#pragma once

#include <string>

#include "core/model/map_record.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// One map: truth as open circles, estimates as dots, joined by lines; anchors as squares; the
/// worst landmarks labelled. Estimates far outside the room become arrows at the frame, and the
/// figure says so. Statuses are drawn below the title.
///
/// @param id    Of the figure, [a-z][a-z0-9-]*.
/// @param what  What it shows, where method, sensor and steps of the record do not say it: its
///              title, and the start of its caption. Empty: they do.
/// @throws InvalidInput if the record's parts disagree in size.
/// @note Pure: O(landmarks).
Figure map_figure(const MapRecord& record, const std::string& id, const std::string& what = "");

/// The panel of map_figure, for figures of several maps: each mark's id begins with `prefix`.
/// @throws InvalidInput as map_figure.
Panel map_panel(const MapRecord& record, const std::string& prefix);

}  // namespace mapproof
