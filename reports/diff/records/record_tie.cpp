#include "reports/diff/records/record_tie.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/text/words.hpp"
#include "reports/diff/records/record_comparison.hpp"

namespace mapproof {
namespace {

/// The comparisons of all records that a figure names.
struct Ties {
  std::vector<const Comparison*> comparisons;  ///< Beyond tolerance.
  std::string run;                             ///< The run of the point that moved farthest.
  const PointsDiff* farthest = nullptr;
  const OtherDiff* other =
      nullptr;  ///< A file that belongs only to a record that the figure names.
};

Ties ties_of(const std::vector<std::string>& ids, const RecordContext& context) {
  Ties ties;
  for (const RecordDiff* records : context.records)
    for (const std::string& id : ids) {
      const RecordTie one = tie(*records, id);
      for (const Comparison* comparison : one.comparisons)
        if (verdict_of(comparison->outcome) > Verdict::kWithinTolerance)
          ties.comparisons.push_back(comparison);
      if (ties.other == nullptr && !one.others.empty()) ties.other = one.others[0];
      for (const PointsDiff* points : one.points) {
        if (points->moves.empty()) continue;
        if (ties.farthest && points->moves[0].moved <= ties.farthest->moves[0].moved) continue;
        ties.farthest = points;
        ties.run = one.run;
      }
    }
  return ties;
}

/// "mpe-m" for "mpe_m", as in ids of figures.
std::string in_figure_id(std::string quantity) {
  std::ranges::replace(quantity, '_', '-');
  return quantity;
}

/// The comparisons of the quantity that the figure shows, by its id; if that quantity does not
/// differ, of the others.
std::vector<const Comparison*> primary(const std::string& id,
                                       const std::vector<const Comparison*>& all) {
  const bool shows_moe = id.find("moe") != std::string::npos;
  std::vector<const Comparison*> some;
  for (const Comparison* comparison : all)
    if (id.ends_with("-" + in_figure_id(comparison->quantity.id))) some.push_back(comparison);
  if (!some.empty()) return some;
  for (const Comparison* comparison : all)
    if (comparison->quantity.id == (shows_moe ? "moe_percent" : "mpe_m") ||
        comparison->quantity.id == "path_mean_m")
      some.push_back(comparison);
  return some.empty() ? all : some;
}

std::string pixels_of(const FigureDiff& diff, const std::string& landmark) {
  for (const MarkMove& move : diff.moves)
    if (move.landmark == landmark && move.distance_px)
      return fmt::format(" ({:.1f} px)", *move.distance_px);
  return "";
}

const FigureChange* other_records(const FigureDiff& diff) {
  const auto found = std::ranges::find(diff.changes, kRecordsWord, &FigureChange::what);
  return found == diff.changes.end() ? nullptr : &*found;
}

/// The cause where no score and no position of the records that the figure names changed.
std::string elsewhere_text(const Ties& ties, const RecordContext& context) {
  if (ties.other != nullptr) return other_text(*ties.other);
  Verdict heaviest = Verdict::kIdentical;
  for (const RecordDiff* records : context.records) {
    if (!settings_text(*records).empty()) return "";
    heaviest = heavier(heaviest, records->judgement.verdict);
  }
  if (heaviest <= Verdict::kWithinTolerance)
    return "its records did not change: it was made from them in a different way";
  // The effect of runs and files on only one side is unknown.
  return heaviest < Verdict::kMissing && heaviest != Verdict::kNew
             ? "no score and no position of its records changed"
             : "";
}

/// The causes besides scores: the experiment, the records that the figure shows, the largest
/// movement.
std::vector<std::string> reasons(const FigureDiff& diff, const Ties& ties, const Judgement& own,
                                 bool names_records, const RecordContext& context) {
  std::vector<std::string> why;
  for (const RecordDiff* records : context.records)
    if (const std::string settings = settings_text(*records); !settings.empty() && why.empty())
      why.push_back(settings);
  const FigureChange* others = other_records(diff);
  if (others != nullptr)
    why.push_back(
        fmt::format("it shows other records, {} \u2192 {}", others->baseline, others->current));
  if (ties.farthest != nullptr) {
    const PointsDiff& farthest = *ties.farthest;
    why.push_back(
        fmt::format("{}{} in record {}", moves_text(farthest),
                    farthest.transform.empty() ? pixels_of(diff, farthest.moves[0].name) : "",
                    farthest.record));
    return why;
  }
  if (others == nullptr || !own.cause.starts_with(kMadeOfOthers)) why.push_back(own.cause);
  if (others == nullptr && ties.comparisons.empty() && names_records)
    if (const std::string text = elsewhere_text(ties, context); !text.empty()) why.push_back(text);
  return why;
}

/// Whether a figure shows ranks, which can stay while the values of the records change.
bool shows_ranks(const std::string& id) {
  return id.starts_with("ranks-") || id.find("-ranks-") != std::string::npos;
}

}  // namespace

bool is_stale(const std::string& id, const std::vector<std::string>& record_ids,
              const RecordContext& context) {
  if (context.records.empty() || record_ids.empty() || shows_ranks(id)) return false;
  const Ties ties = ties_of(record_ids, context);
  if (ties.farthest != nullptr) return true;
  return std::ranges::any_of(ties.comparisons, [&](const Comparison* comparison) {
    return id.ends_with("-" + in_figure_id(comparison->quantity.id));
  });
}

Judgement tied_judgement(const std::string& id, const FigureDiff& diff, const Judgement& own,
                         const std::vector<std::string>& record_ids, const RecordContext& context) {
  if (context.records.empty()) return own;
  const Ties ties = ties_of(record_ids, context);
  Judgement judgement{Verdict::kChanged, true, ""};
  for (const RecordDiff* records : context.records)
    if (judgement.shared_cause.empty()) judgement.shared_cause = settings_text(*records);
  std::string why;
  for (const std::string& reason : reasons(diff, ties, own, !record_ids.empty(), context))
    why += (why.empty() ? "" : "; ") + reason;

  const std::vector<const Comparison*> shown = primary(id, ties.comparisons);
  if (const Comparison* first = most_telling(shown)) {
    // Different records are neither better nor worse.
    if (other_records(diff) == nullptr) judgement.verdict = Verdict::kBetter;
    for (const Comparison* comparison : shown)
      if (other_records(diff) == nullptr)
        judgement.verdict = heavier(judgement.verdict, verdict_of(comparison->outcome));
    const auto of_run = std::ranges::find_if(shown, [&](const Comparison* c) {
      return c->quantity.id == first->quantity.id &&
             std::ranges::any_of(c->largest,
                                 [&](const PairedValue& pair) { return pair.run == ties.run; });
    });
    why += ", " +
           (of_run != shown.end() && !ties.run.empty()
                ? comparison_text(**of_run, ties.run)
                : comparison_text(*first) + " of " + label_text(first->label)) +
           directions_text(ties.comparisons, *first);
  }
  judgement.cause = fmt::format("{} changed because {}", id, why);
  return judgement;
}

}  // namespace mapproof
