#pragma once

#include <optional>
#include <utility>

#include "render/plot/figure.hpp"
#include "reports/diff/diff_result.hpp"

namespace mapproof {

/// The values of a figure on both sides.
struct FigureValues {
  Figure baseline, current;
};

/// Reads the values of a 2-D figure; empty if the item has none on both sides.
/// @throws IoError
std::optional<FigureValues> figure_values(const DiffItem& item);

/// Both figures with the limits of axes that hold what either shows, so that a shifted limit moves
/// no mark on the page, and without titles and notes that differ; empty if limits and words are
/// equal, or if their panels differ in number or scale.
std::optional<std::pair<Figure, Figure>> on_common_axes(const FigureValues& values);

/// What changed between two figures, on common axes: the baseline in grey, the layers that differ
/// as the current figure has them, all under their names in the legend, and a line from the old to
/// the new position of each mark that moved. Cells show the size of their change. At most four
/// panels, those with most movements. Empty if no layer that is drawn differs.
std::optional<Figure> change_figure(const FigureValues& values, const FigureDiff& diff);

/// What changed between two sets of records: the old and the new positions of the landmarks of the
/// record in which one moved farthest, joined by lines; and for up to three quantities, the most
/// severe first, each run's current value over its baseline, also of runs that are equal; the
/// legend has their number. What all panels show is named in the title, the rest in theirs. Empty
/// if there is neither.
std::optional<Figure> change_figure(const RecordDiff& diff);

/// What changed in an item: between its figure's values if they are given, else in its records.
std::optional<Figure> change_figure(const DiffItem& item,
                                    const std::optional<FigureValues>& values);

}  // namespace mapproof
