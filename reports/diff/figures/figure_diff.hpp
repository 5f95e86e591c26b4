#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "reports/diff/figures/figure_log.hpp"
#include "reports/diff/verdict/verdict.hpp"

namespace mapproof {

/// Compares two figures mark by mark. Layers are matched by kind and label, marks by id or else by
/// their index in the layer. If both figures are marked `varies`, these are not judged: positions,
/// numbers, "ms" and "µs" behind them, limits, the alternative text, the number of nameless points
/// of a layer, and the layer of a named point.
/// @note Time O(points), and quadratic in the layers of a panel.
FigureDiff figure_diff(const Figure& baseline, const Figure& current,
                       const FigureOptions& options = {});

/// The heaviest verdict that follows from the figures alone, with its cause: identical, within
/// tolerance or style; for data better, worse (by the errors of their marks) or changed.
Judgement judge(const FigureDiff& diff);

/// "landmark L17 moved 0.041 m (9.1 px)".
std::string move_text(const MarkMove& move);

}  // namespace mapproof
