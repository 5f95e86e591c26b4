#include "reports/diff/tables/record_tables.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/diff/tables/score_table.hpp"
#include "reports/diff/tables/table_parts.hpp"

namespace mapproof {
namespace {

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

/// The farthest move of each record, the farthest record first.
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
                   {"Baseline error", "", "", "Mean, where the truth is known"},
                   {"Current error", "", "", "Mean, where the truth is known"}};
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

/// Names on one side alone, and what could not be read.
void add_presence(std::vector<Block>& blocks, const RecordDiff& diff) {
  KeyValues facts;
  const auto add = [&](const std::string& key, const std::vector<std::string>& names) {
    if (!names.empty()) facts.items.push_back({key, {listed(names, kMostNames), Emphasis::kData}});
  };
  add("Runs missing", diff.missing_runs);
  add("Runs new", diff.new_runs);
  add("Subjects missing", diff.missing_subjects);
  add("Subjects new", diff.new_subjects);
  add("Other anchors in", diff.anchors);
  for (const RecordProblem& problem : diff.problems)
    if (facts.items.size() < kMostTableRows)
      facts.items.push_back({problem.file, {problem.what, Emphasis::kData}});
  facts.items.push_back({"Values compared", {fmt::format("{}", diff.values), Emphasis::kPlain}});
  facts.items.push_back({"Pairs of runs",
                         {diff.same_seeds ? "the same on both sides: compared pair by pair"
                                          : "none: the seeds or the worlds are others",
                          Emphasis::kPlain}});
  blocks.emplace_back(std::move(facts));
}

}  // namespace

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
    const std::string place = other.presence == Presence::kBaseline  ? "missing"
                              : other.presence == Presence::kCurrent ? "new"
                                                                     : other.first;
    table.rows.push_back(
        {{user_text(other.file), count(other.numbers), count(other.within), count(other.beyond),
          user_text(place), user_text(other.baseline), user_text(other.current)},
         "",
         false});
  }
  add_table(blocks, std::move(table), std::ssize(others));
}

void add_record_tables(std::vector<Block>& blocks, const RecordDiff& diff,
                       const std::string& suffix) {
  add_presence(blocks, diff);
  add_table(blocks,
            changes_table("settings-" + suffix, "Settings of the experiment", "Setting",
                          diff.settings, [](const auto& change) { return change.pointer; }),
            std::ssize(diff.settings));
  std::vector<const Comparison*> comparisons;
  for (const Comparison& comparison : diff.comparisons) comparisons.push_back(&comparison);
  add_score_table(blocks, "scores-" + suffix, "Scores", std::move(comparisons));
  add_points_table(blocks, diff, suffix);
  add_table(blocks,
            changes_table("statuses-" + suffix, "Statuses", "Record", diff.statuses,
                          [](const auto& change) { return change.record; }),
            std::ssize(diff.statuses));
  add_others_table(blocks, diff.others, suffix);
  add_table(blocks,
            changes_table("versions-" + suffix, "Versions, which are not judged", "What",
                          diff.provenance, [](const auto& change) { return change.pointer; }),
            std::ssize(diff.provenance));
}

}  // namespace mapproof
