#include "reports/diff/tables/item_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "core/results/great_errors.hpp"
#include "render/plot/figure_json.hpp"
#include "reports/diff/figures/figure_diff.hpp"
#include "reports/diff/records/difference_summary.hpp"
#include "reports/diff/records/numbers_in_text.hpp"
#include "reports/diff/records/record_comparison.hpp"
#include "reports/diff/records/record_diff.hpp"
#include "reports/diff/tables/image_tables.hpp"
#include "reports/diff/tables/table_builder.hpp"
#include "reports/diff/verdict/tolerances.hpp"
#include "reports/model/format.hpp"
#include "reports/model/report.hpp"

namespace mapproof {
namespace {

std::string runs_text(const Comparison& c) {
  std::string text = fmt::format("{} of {}", c.beyond, c.pairs);
  if (c.lost > 0) text += fmt::format(", {} lost", c.lost);
  if (c.gained > 0) text += fmt::format(", {} gained", c.gained);
  return text;
}

Row row_of(const Comparison& c) {
  const ScaledUnit unit = shown_unit(c);
  const double scale = unit.factor * std::max(std::abs(c.baseline_mean), std::abs(c.current_mean));
  const bool errors_m = unit.unit == c.quantity.unit && has_great_errors(c.quantity, c.least_value);
  const auto mean = [&](double value) {
    // Digits that distinguish small values are those of a value that is shown.
    const double shown = errors_m && scale > kGreatestError_m ? std::abs(value) : scale;
    NumberCell cell = scaled_number(value, shown);
    cell.error_m = errors_m;
    return cell;
  };
  NumberCell before = mean(unit.factor * c.baseline_mean);
  NumberCell after = mean(unit.factor * c.current_mean);
  while (before.decimals == after.decimals && before.decimals < kMostDecimals &&
         before.value != after.value && format_cell(before) == format_cell(after))
    ++before.decimals, ++after.decimals;
  Row row{{user_text(label_text(c.label)), TextCell{label_with_unit(in_unit(c.quantity, unit))},
           before, after, TextCell{runs_text(c)}},
          "",
          false};
  row.cells.push_back(has_p(c) ? Cell(p_cell(c.test->p)) : Cell(MissingCell{}));
  row.cells.push_back(c.test ? Cell(NumberCell{c.test->change.ranks.effect, 2, true})
                             : Cell(MissingCell{}));
  row.cells.emplace_back(TextCell{std::string(label(verdict_of(c.outcome)))});
  return row;
}

/// Adds a table of the scores of both sides with their tests, in the order of shows_more().
/// @param comparisons  None is null.
/// @param secondary    Whether the item of the records has them, too.
void add_score_table(std::vector<Block>& blocks, const std::string& id, const std::string& caption,
                     std::vector<const Comparison*> comparisons, bool secondary) {
  std::ranges::stable_sort(
      comparisons, [](const Comparison* a, const Comparison* b) { return shows_more(*a, *b); });
  Table table{id, caption, {}, {}, {}, secondary};
  table.columns = {{"Subject", "", "", ""},
                   {"Score", "", "", ""},
                   {"Baseline", "", "", "Mean over the runs that both sides have"},
                   {"Current", "", "", "Mean over the runs that both sides have"},
                   {"Runs beyond tolerance", "", "", ""},
                   {"p", "", "", "Of a paired test, corrected for the number of tests"},
                   {"Effect", "", "", "Rank-biserial correlation, -1 to 1; above 0: greater"},
                   {"Outcome", "", "", ""}};
  const long total = std::ssize(comparisons);
  if (comparisons.size() > kMostTableRows) comparisons.resize(kMostTableRows);
  bool tested = false, equal = false;
  for (const Comparison* comparison : comparisons) {
    table.rows.push_back(row_of(*comparison));
    tested = tested || has_p(*comparison);
    equal = equal || (comparison->test && !has_p(*comparison));
  }
  if (equal)
    table.notes.emplace_back("No p where the changes are equal.");
  else if (!tested)
    table.notes.emplace_back("No p: there are too few pairs of runs or of groups to test.");
  add_table(blocks, std::move(table), total);
}

constexpr std::size_t kMostNames = 12;

/// Three columns of text: what, before, after.
Table changes_table(const std::string& id, const std::string& caption, const std::string& what,
                    const auto& changes, auto name_of) {
  Table table{id, caption, {}, {}, {}};
  table.columns = {{what, "", "", ""}, {"Baseline", "", "", ""}, {"Current", "", "", ""}};
  for (const auto& change : changes) {
    if (table.rows.size() == kMostTableRows) break;
    table.rows.push_back(
        {{user_text(name_of(change)), user_text(change.baseline.empty() ? "none" : change.baseline),
          user_text(change.current.empty() ? "none" : change.current)},
         "",
         false});
  }
  return table;
}

/// Lists the largest movement of each record, the largest first.
void add_points_table(std::vector<Block>& blocks, const RecordDiff& diff,
                      const std::string& suffix) {
  std::vector<const PointsDiff*> moved;
  for (const PointsDiff& points : diff.points)
    if (!points.moves.empty()) moved.push_back(&points);
  std::ranges::stable_sort(moved, std::ranges::greater{},
                           [](const PointsDiff* points) { return points->moves[0].moved; });
  Table table{"points-" + suffix, "Positions that moved, by record", {}, {}, {}};
  table.columns = {{"Record", "", "", ""},
                   {"Farthest", "", "", ""},
                   {"Moved", "", "", "Positions beyond tolerance"},
                   {"Baseline error", "", "", "Mean, where the ground truth is known", true},
                   {"Current error", "", "", "Mean, where the ground truth is known", true}};
  const auto error = [](const std::optional<double>& value) {
    return value ? Cell(scaled_number(*value, std::abs(*value))) : Cell(MissingCell{});
  };
  for (const PointsDiff* points : moved) {
    if (table.rows.size() == kMostTableRows) break;
    table.rows.push_back(
        {{user_text(points->record), user_text(move_text(points->moves[0], points->quantity)),
          TextCell{fmt::format("{} of {}", points->beyond, points->points)},
          error(points->baseline_error), error(points->current_error)},
         "",
         false});
  }
  add_table(blocks, std::move(table), std::ssize(moved));
}

/// Lists the names on only one side, and the files that cannot be read.
void add_presence(std::vector<Block>& blocks, const RecordDiff& diff) {
  KeyValues facts;
  const auto add = [&](const std::string& key, const std::vector<std::string>& names) {
    if (!names.empty()) facts.items.push_back({key, {listed(names, kMostNames), Emphasis::kData}});
  };
  add("Runs missing", diff.missing_runs);
  add("Runs new", diff.new_runs);
  add("Subjects missing", labels_of(diff, diff.missing_subjects));
  add("Subjects new", labels_of(diff, diff.new_subjects));
  add("Different anchors in", diff.anchors);
  for (const RecordProblem& problem : diff.problems)
    if (facts.items.size() < kMostTableRows)
      facts.items.push_back({problem.file, {problem.what, Emphasis::kData}});
  facts.items.push_back({"Values compared", {fmt::format("{}", diff.values), Emphasis::kPlain}});
  facts.items.push_back({"Pairs of runs",
                         {diff.same_seeds ? "the same on both sides: compared in pairs"
                                          : "none: the seeds or the true positions differ",
                          Emphasis::kPlain}});
  blocks.emplace_back(std::move(facts));
}

/// Adds a table of the files that are compared value by value, if there are any.
void add_others_table(std::vector<Block>& blocks, const std::vector<OtherDiff>& others,
                      const std::string& suffix) {
  Table table{"others-" + suffix, "Other values", {}, {}, {}};
  table.columns = {{"File", "", "", ""},
                   {"Numbers", "", "", ""},
                   {"Within tolerance", "", "", ""},
                   {"Beyond", "", "", ""},
                   {"First at", "", "", "JSON pointer or line"},
                   {"Baseline", "", "", ""},
                   {"Current", "", "", ""}};
  for (const OtherDiff& other : others) {
    if (table.rows.size() == kMostTableRows) break;
    const auto count = [](long value) { return NumberCell{static_cast<double>(value), 0}; };
    const std::string location = other.presence == Presence::kBaseline  ? "missing"
                                 : other.presence == Presence::kCurrent ? "new"
                                                                        : other.first;
    const auto [before, after] = readable_numbers(other.baseline, other.current);
    table.rows.push_back(
        {{user_text(other.file), count(other.numbers), count(other.within), count(other.beyond),
          user_text(location), user_text(before), user_text(after)},
         "",
         false});
  }
  add_table(blocks, std::move(table), std::ssize(others));
}

/// Adds the differences of the records: scores with their tests, positions, settings, warnings,
/// runs on only one side, versions, files that cannot be read.
/// @param suffix  The end of the tables' ids.
/// How the scores of many records differ: a row for each quantity.
void add_summary_table(std::vector<Block>& blocks, const RecordDiff& diff,
                       const std::string& suffix) {
  if (diff.comparisons.size() <= kMostTableRows) return;
  Table table{"summary-" + suffix, "How the scores differ, over all records", {}, {}, {}};
  const std::string ratio = "Quantile over the records of current / baseline, of their means";
  table.columns = {{"Score", "", "", ""},          {"Records that differ", "", "", ""},
                   {"Worse", "", "", ""},          {"Better", "", "", ""},
                   {"Ratio, 10 %", "", "", ratio}, {"50 %", "", "", ratio},
                   {"90 %", "", "", ratio}};
  const auto count = [](long n) { return NumberCell{static_cast<double>(n), 0, false}; };
  const auto quantile = [](double value) {
    return std::isfinite(value) ? Cell(NumberCell{value, 2, false}) : Cell(MissingCell{});
  };
  for (const QuantityDifferences& one : difference_summary(diff))
    table.rows.push_back(
        {{TextCell{one.quantity.label}, count(one.records), count(one.worse), count(one.better),
          quantile(one.low), quantile(one.median), quantile(one.high)},
         "",
         false});
  const long rows = std::ssize(table.rows);
  add_table(blocks, std::move(table), rows);
}

void add_record_tables(std::vector<Block>& blocks, const RecordDiff& diff,
                       const std::string& suffix) {
  add_presence(blocks, diff);
  add_summary_table(blocks, diff, suffix);
  add_table(blocks,
            changes_table("settings-" + suffix, "Settings of the experiment", "Setting",
                          diff.settings, [](const auto& change) { return change.pointer; }),
            std::ssize(diff.settings));
  std::vector<const Comparison*> comparisons;
  for (const Comparison& comparison : diff.comparisons) comparisons.push_back(&comparison);
  add_score_table(blocks, "scores-" + suffix, "Scores", std::move(comparisons), false);
  add_points_table(blocks, diff, suffix);
  add_table(blocks,
            changes_table("statuses-" + suffix, "Warnings", "Record", diff.statuses,
                          [](const auto& change) { return change.record; }),
            std::ssize(diff.statuses));
  add_others_table(blocks, diff.others, suffix);
  add_table(blocks,
            changes_table("versions-" + suffix, "Versions, which are not judged", "What",
                          diff.provenance, [](const auto& change) { return change.pointer; }),
            std::ssize(diff.provenance));
}

std::string who(const MarkMove& move) {
  if (!move.landmark.empty()) return "landmark " + move.landmark;
  if (!move.curve.empty()) return fmt::format("point {} of {}", move.point + 1, move.curve);
  return move.mark.empty() ? fmt::format("point {}", move.point + 1) : move.mark;
}

/// Both positions with their units, "(1.250, −0.500) m" on a map and "(500, 0.161 m)" on a curve,
/// with as many digits as distinguish them.
/// @param scale  The greatest coordinate on the map: its positions have the same decimals.
std::pair<std::string, std::string> positions_text(const MarkMove& move, double scale) {
  const bool is_map = move.on_map && scale > 0.0;
  const auto numbers = [&](double before, double after) {
    if (!is_map) return changed_numbers(before, after);
    int decimals = scaled_number(before, scale).decimals + 1;
    while (decimals < kMostDecimals && before != after &&
           number_text(before, decimals) == number_text(after, decimals))
      ++decimals;
    return std::pair(number_text(before, decimals), number_text(after, decimals));
  };
  const auto x = numbers(move.baseline.x, move.current.x);
  const auto y = numbers(move.baseline.y, move.current.y);
  const auto text = [&](Point at, const std::string& first, const std::string& second) {
    if (!std::isfinite(at.x) || !std::isfinite(at.y)) return std::string("none");
    if (is_map) return with_unit(fmt::format("({}, {})", first, second), move.x_unit);
    return fmt::format("({}, {})", with_unit(first, move.x_unit), with_unit(second, move.y_unit));
  };
  return {text(move.baseline, x.first, y.first), text(move.current, x.second, y.second)};
}

/// The unit of all distances; empty if they have several.
std::string common_unit(const std::vector<MarkMove>& moves) {
  const auto has_other = [&](const MarkMove& move) { return move.unit != moves.front().unit; };
  return moves.empty() || std::ranges::any_of(moves, has_other) ? "" : moves.front().unit;
}

/// Those of a figure, but for lines of errors, which draw the positions of the points again.
std::vector<MarkMove> moves_once(const std::vector<MarkMove>& moves) {
  const auto is_repeated = [&](const MarkMove& move) {
    const auto is_before = [&](const MarkMove& other) {
      if (&other == &move || other.landmark != move.landmark || other.panel != move.panel ||
          other.baseline != move.baseline || other.current != move.current)
        return false;
      return move.is_line == other.is_line ? &other < &move : move.is_line;
    };
    return !move.landmark.empty() && std::ranges::any_of(moves, is_before);
  };
  std::vector<MarkMove> once;
  std::ranges::remove_copy_if(moves, std::back_inserter(once), is_repeated);
  return once;
}

Table moves_table(const FigureDiff& diff, const std::string& suffix) {
  const std::vector<MarkMove> moves = moves_once(diff.moves);
  const bool has_places = std::ranges::any_of(
      moves, [&](const MarkMove& move) { return move.location != moves.front().location; });
  Table table{"moves-" + suffix, "What moved", {}, {}, {}};
  table.columns = {{"What", "", "", ""},
                   {"Distance", common_unit(moves), "", "In the units of the axes"},
                   {"On the page", "px", "", "On the page of the report's theme"},
                   {"From", "", "", ""},
                   {"To", "", "", ""}};
  if (has_places) table.columns.push_back({"Where", "", "", ""});
  double distance = 0.0;
  std::map<std::size_t, double> scales;  // By panel.
  for (const MarkMove& move : moves) {
    if (std::isfinite(move.distance)) distance = std::max(distance, move.distance);
    for (const double at : {move.baseline.x, move.baseline.y, move.current.x, move.current.y})
      if (std::isfinite(at)) scales[move.panel] = std::max(scales[move.panel], std::abs(at));
  }
  for (const MarkMove& move : moves) {
    const auto [from, to] = positions_text(move, scales[move.panel]);
    NumberCell moved = scaled_number(move.distance, distance);
    moved.error_m = move.unit == "m";
    Row row{{user_text(who(move)), moved,
             move.distance_px ? Cell(NumberCell{*move.distance_px, 1}) : Cell(MissingCell{}),
             user_text(from), user_text(to)},
            "",
            false};
    if (has_places) row.cells.push_back(user_text(move.location));
    table.rows.push_back(std::move(row));
  }
  if (!has_places && !moves.empty())
    table.notes.push_back("All are of " + user_text(moves.front().location).text + ".");
  if (diff.within > 0)
    table.notes.push_back(counted(diff.within, diff.within == diff.within_landmarks
                                                   ? "more landmark"
                                                   : "more point") +
                          " moved within tolerance.");
  if (diff.baseline_error && diff.current_error)
    table.notes.push_back("Mean error of the positions drawn, without anchors: " +
                          change_text(*diff.baseline_error, *diff.current_error, "m", true) + ".");
  return table;
}

/// Adds tables of the movements, with both positions, and of the other changes.
/// @param suffix  The end of the tables' ids.
void add_figure_tables(std::vector<Block>& blocks, const FigureDiff& diff,
                       const std::string& suffix) {
  Table moves = moves_table(diff, suffix);
  const long shown = std::ssize(moves.rows);
  add_table(blocks, std::move(moves), shown + diff.moved - std::ssize(diff.moves));
  Table changes{"changes-" + suffix, "Changes of the figure's value", {}, {}, {}, true};
  changes.columns = {{"Where", "", "", ""},
                     {"What", "", "", ""},
                     {"Kind", "", "", "Data; style; or metadata: title, caption, alternative text"},
                     {"Baseline", "", "", ""},
                     {"Current", "", "", ""}};
  for (const FigureChange& change : diff.changes) {
    const auto [before, after] = readable_numbers(change.baseline, change.current);
    changes.rows.push_back(
        {{user_text(change.location), user_text(change.what),
          TextCell{std::string(name(change.kind))}, user_text(before), user_text(after)},
         "",
         false});
  }
  if (diff.masked > 0)
    changes.notes.push_back("Varies from run to run: " + counted(diff.masked, "difference") +
                            " not judged.");
  add_table(blocks, std::move(changes), diff.total_changes);
}

constexpr std::size_t kLargestFigure = std::size_t{1} << 28;  // Bytes.
constexpr std::size_t kMostItemNames = 6;

/// The ids of the records from which either side of the figure was made.
std::set<std::string> record_ids(const DiffItem& item) {
  std::set<std::string> ids;
  for (const auto& path : {item.baseline_figure, item.current_figure}) {
    if (path.empty()) continue;
    try {
      const Figure figure = figure_from_json(read_input(path, kLargestFigure), path.string());
      ids.insert(figure.record_ids.begin(), figure.record_ids.end());
    } catch (const IoError&) {  // The verdict is then: unreadable.
    }
  }
  return ids;
}

/// The scores of the records that the figure shows.
std::vector<const Comparison*> tied_scores(const DiffItem& item, const DiffResult& all) {
  std::vector<const Comparison*> scores;
  std::set<const Comparison*> seen;
  const std::set<std::string> ids = record_ids(item);
  for (const DiffItem& other : all.items) {
    if (!other.records) continue;
    for (const std::string& id : ids)
      for (const Comparison* comparison : tie(*other.records, id).comparisons)
        if (seen.insert(comparison).second) scores.push_back(comparison);
  }
  return scores;
}

/// The renderers of the images of one side, each once.
std::vector<std::string> renderers(const DiffResult& result, std::string ImageDiff::*side) {
  std::set<std::string> names;
  for (const DiffItem& item : result.items)
    for (const ImageFile& file : item.images)
      if (!(file.diff.*side).empty()) names.insert(file.diff.*side);
  return {names.begin(), names.end()};
}

}  // namespace

std::vector<Block> item_blocks(const DiffItem& item, const DiffResult& all, std::size_t number) {
  const std::string suffix = fmt::format("{}", number);
  std::vector<Block> blocks;
  if (item.figure) {
    add_figure_tables(blocks, *item.figure, suffix);
    if (item.figure->has(ChangeKind::kData))
      add_score_table(blocks, "tied-" + suffix, "Scores of the records that the figure shows",
                      tied_scores(item, all), true);
  }
  if (item.records) add_record_tables(blocks, *item.records, suffix);
  add_others_table(blocks, item.documents, suffix);
  add_image_tables(blocks, item.images, suffix, item.figure.has_value());
  return blocks;
}

KeyValues whole_facts(const DiffResult& result) {
  KeyValues facts;
  const auto add = [&](const std::string& key, const std::string& text, Emphasis emphasis) {
    if (!text.empty()) facts.items.push_back({key, {text, emphasis}});
  };
  const auto side = [](const std::string& title, const std::string& path) {
    return title.empty() ? path : fmt::format("{}: {}", title, path);
  };
  add("Baseline", side(result.baseline_title, result.baseline), Emphasis::kData);
  add("Current", side(result.current_title, result.current), Emphasis::kData);
  std::vector<std::string> allowed;
  for (const Verdict verdict : result.allowed) allowed.emplace_back(label(verdict));
  add("Also allowed to pass", listed(allowed, kVerdicts.size()), Emphasis::kPlain);
  add("Versions that differ", listed(version_changes(result), kMostItemNames), Emphasis::kData);
  const auto before = renderers(result, &ImageDiff::baseline_renderer);
  const auto after = renderers(result, &ImageDiff::current_renderer);
  if (before == after) {
    add("Images drawn by", listed(before, kMostItemNames), Emphasis::kData);
  } else {
    add("Baseline drawn by", listed(before, kMostItemNames), Emphasis::kData);
    add("Current drawn by", listed(after, kMostItemNames), Emphasis::kData);
  }
  return facts;
}

}  // namespace mapproof
