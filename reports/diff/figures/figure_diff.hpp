#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "reports/diff/figures/figure_log.hpp"
#include "reports/diff/verdict/verdict.hpp"

namespace mapproof {

/// Compares two figures mark by mark. Layers are matched by kind and label, marks by id and else
/// by their place in the layer. In figures marked `varies` on both sides are not judged:
/// places, numbers, limits, the alternative text, how many nameless points a layer has, and of
/// which layer a named point is.
/// @note O(points); layers of a panel squared.
FigureDiff figure_diff(const Figure& baseline, const Figure& current,
                       const FigureOptions& options = {});

/// The heaviest verdict that the figures alone allow: identical, within tolerance, style, and of
/// data better, worse (by the errors of their marks) or changed; with its cause.
Judgement judge(const FigureDiff& diff);

/// "landmark L17 moved 0.041 m (9.1 px)".
std::string move_text(const MarkMove& move);

}  // namespace mapproof
