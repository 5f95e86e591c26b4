#include "reports/diff/tables/figure_tables.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/diff/tables/table_parts.hpp"
#include "reports/diff/verdict/tolerances.hpp"

namespace mapproof {
namespace {

std::string who(const MarkMove& move) {
  if (!move.landmark.empty()) return "landmark " + move.landmark;
  const std::string of = move.curve.empty() ? "" : " of " + move.curve;
  return move.mark.empty() ? fmt::format("point {}{}", move.point + 1, of) : move.mark + of;
}

/// "(1.25, -0.5)", with as many digits as tell it from the other.
std::string place_text(Point at, Point other) {
  if (!std::isfinite(at.x) || !std::isfinite(at.y)) return "none";
  const auto digits = [](double a, double b) {
    int enough = 4;
    while (enough < 17 && a != b &&
           fmt::format("{:.{}g}", a, enough) == fmt::format("{:.{}g}", b, enough))
      ++enough;
    return enough;
  };
  return fmt::format("({:.{}g}, {:.{}g})", at.x, digits(at.x, other.x), at.y,
                     digits(at.y, other.y));
}

Table moves_table(const FigureDiff& diff, const std::string& suffix) {
  Table table{"moves-" + suffix, "What moved", {}, {}, {}};
  table.columns = {{"What", "", "", ""},
                   {"Where", "", "", ""},
                   {"From", "", "", "In the units of the axes"},
                   {"To", "", "", "In the units of the axes"},
                   {"Distance", "", "", "In the units of the axes"},
                   {"On the page", "px", "", "On the page of the report's theme"}};
  double scale = 0.0;
  for (const MarkMove& move : diff.moves)
    if (std::isfinite(move.distance)) scale = std::max(scale, move.distance);
  for (const MarkMove& move : diff.moves) {
    Row row{
        {user_text(who(move)), user_text(move.place),
         TextCell{place_text(move.baseline, move.current)},
         TextCell{place_text(move.current, move.baseline)}, scaled_number(move.distance, scale)},
        "",
        false};
    row.cells.push_back(move.distance_px ? Cell(NumberCell{*move.distance_px, 1})
                                         : Cell(MissingCell{}));
    table.rows.push_back(std::move(row));
  }
  if (diff.within > 0)
    table.notes.push_back(counted(diff.within, "more point") + " moved within tolerance.");
  if (diff.baseline_error && diff.current_error)
    table.notes.push_back("Mean error of the marks: " +
                          change_text(*diff.baseline_error, *diff.current_error, "") + ".");
  return table;
}

}  // namespace

void add_figure_tables(std::vector<Block>& blocks, const FigureDiff& diff,
                       const std::string& suffix) {
  add_table(blocks, moves_table(diff, suffix), diff.moved);
  Table changes{"changes-" + suffix, "What changed in the figure's value", {}, {}, {}};
  changes.columns = {{"Where", "", "", ""},
                     {"What", "", "", ""},
                     {"Kind", "", "", "Data; style; or metadata: title, caption, words"},
                     {"Baseline", "", "", ""},
                     {"Current", "", "", ""}};
  for (const FigureChange& change : diff.changes)
    changes.rows.push_back(
        {{user_text(change.place), user_text(change.what), TextCell{std::string(name(change.kind))},
          user_text(change.baseline), user_text(change.current)},
         "",
         false});
  if (diff.masked > 0)
    changes.notes.push_back("Varies from run to run: " + counted(diff.masked, "difference") +
                            " not judged.");
  add_table(blocks, std::move(changes), diff.total_changes);
}

}  // namespace mapproof
