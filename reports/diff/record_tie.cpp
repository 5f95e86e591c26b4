#include <algorithm>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/diff/figure_log.hpp"
#include "reports/diff/item_diff.hpp"
#include "reports/diff/record_words.hpp"

namespace mapproof {
namespace {

/// What the records say of all that a figure names.
struct Ties {
  std::vector<const Comparison*> comparisons;  ///< Beyond tolerance.
  std::string run;                             ///< Of the point that moved farthest.
  const PointsDiff* farthest = nullptr;
};

Ties ties_of(const std::vector<std::string>& ids, const RecordContext& context) {
  Ties ties;
  for (const RecordDiff* records : context.records)
    for (const std::string& id : ids) {
      const RecordTie one = tie(*records, id);
      for (const Comparison* comparison : one.comparisons)
        if (verdict_of(comparison->outcome) > Verdict::kWithinTolerance)
          ties.comparisons.push_back(comparison);
      for (const PointsDiff* points : one.points) {
        if (points->moves.empty()) continue;
        if (ties.farthest && points->moves[0].moved <= ties.farthest->moves[0].moved) continue;
        ties.farthest = points;
        ties.run = one.run;
      }
    }
  return ties;
}

/// The quantity that the figure is about, by its id; others count where that one does not differ.
std::vector<const Comparison*> primary(const std::string& id,
                                       const std::vector<const Comparison*>& all) {
  const bool shows_moe = id.find("moe") != std::string::npos;
  std::vector<const Comparison*> some;
  for (const Comparison* comparison : all)
    if (comparison->quantity == (shows_moe ? "moe_percent" : "mpe_m") ||
        comparison->quantity == "mean_m")
      some.push_back(comparison);
  return some.empty() ? all : some;
}

std::string pixels_of(const FigureDiff& diff, const std::string& landmark) {
  for (const MarkMove& move : diff.moves)
    if (move.landmark == landmark && move.distance_px)
      return fmt::format(" ({:.1f} px)", *move.distance_px);
  return "";
}

/// What moved: a landmark of a record, else what the figure itself says.
std::string what_moved(const FigureDiff& diff, const Ties& ties, const Judgement& own) {
  if (ties.farthest == nullptr) return own.cause;
  const PointMove& move = ties.farthest->moves[0];
  return fmt::format("{}{} in record {}", move_text(move, ties.farthest->quantity),
                     pixels_of(diff, move.name), ties.farthest->record);
}

const FigureChange* other_records(const FigureDiff& diff) {
  const auto found = std::ranges::find(diff.changes, kRecordsWord, &FigureChange::what);
  return found == diff.changes.end() ? nullptr : &*found;
}

}  // namespace

Judgement tied_judgement(const std::string& id, const FigureDiff& diff, const Judgement& own,
                         const std::vector<std::string>& record_ids, const RecordContext& context) {
  if (context.records.empty()) return own;
  const Ties ties = ties_of(record_ids, context);
  Judgement judgement{Verdict::kChanged, true, ""};
  std::string why;
  for (const RecordDiff* records : context.records)
    if (const std::string settings = settings_text(*records); !settings.empty() && why.empty())
      why = settings + "; ";
  if (const FigureChange* change = other_records(diff))
    why += fmt::format("it shows other records, {} \u2192 {}; ", change->baseline, change->current);
  why += what_moved(diff, ties, own);

  const std::vector<const Comparison*> shown = primary(id, ties.comparisons);
  if (const Comparison* first = most_telling(shown)) {
    // Of other records there is no better or worse.
    if (other_records(diff) == nullptr) judgement.verdict = Verdict::kBetter;
    for (const Comparison* comparison : shown)
      if (other_records(diff) == nullptr)
        judgement.verdict = heavier(judgement.verdict, verdict_of(comparison->outcome));
    const auto of_run = std::ranges::find_if(shown, [&](const Comparison* c) {
      return c->quantity == first->quantity &&
             std::ranges::any_of(c->largest,
                                 [&](const PairedValue& pair) { return pair.run == ties.run; });
    });
    why += ", " + (of_run != shown.end() && !ties.run.empty()
                       ? comparison_text(**of_run, ties.run)
                       : comparison_text(*first) + " of " + first->subject);
  } else if (ties.farthest == nullptr) {
    why += record_ids.empty() ? "" : "; its records did not change: it is made of them otherwise";
  }
  judgement.cause = fmt::format("{} changed because {}", id, why);
  return judgement;
}

}  // namespace mapproof
