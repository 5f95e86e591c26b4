#pragma once

#include <optional>

#include "reports/diff/records/record_diff.hpp"

namespace mapproof {

/// How far points moved between two sides. Shapes without a frame are aligned to each other first,
/// by place, turn, scale and mirror.
/// @return Nothing if every point is equal.
std::optional<PointsDiff> points_diff(const std::string& record, const PlacedPoints& baseline,
                                      const PlacedPoints& current, const Tolerances& tolerances);

/// Whether two sets of true places are the same within tolerance.
bool same_places(const PlacedPoints& baseline, const PlacedPoints& current,
                 const Tolerances& tolerances);

}  // namespace mapproof
