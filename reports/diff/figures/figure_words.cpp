#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "reports/diff/documents/excerpts.hpp"
#include "reports/diff/figures/figure_diff.hpp"
#include "reports/diff/figures/figure_log.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostValueText = 60;  // Characters of a value in a sentence.

/// "41 mm", "1.2 m"; other units as they are.
std::string length_text(double length, const std::string& unit) {
  if (unit == "m" && length < 0.9995) return fmt::format("{:.3g} mm", 1000.0 * length);
  return fmt::format("{:.3g}{}{}", length, unit.empty() ? "" : " ", unit);
}

std::string change_sentence(const FigureChange& change) {
  const auto [before, after] = excerpts(change.baseline, change.current, kMostValueText);
  std::string text = change.place + ": " + change.what;
  if (change.baseline.empty() && change.current.empty()) return text;
  if (change.current.empty()) return text + " (was " + before + ")";
  if (change.baseline.empty()) return text + " (" + after + ")";
  return fmt::format("{} {} \u2192 {}", text, before, after);
}

/// The first change of that kind, and how many more there are; other records are told apart.
std::string first_of(const FigureDiff& diff, ChangeKind kind) {
  const FigureChange* first = nullptr;
  long count = 0;
  for (const FigureChange& change : diff.changes)
    if (change.kind == kind && change.what != kRecordsWord && count++ == 0) first = &change;
  if (first == nullptr) return "";
  return change_sentence(*first) +
         (count > 1 ? fmt::format(", and {} more", counted(count - 1, "change")) : "");
}

/// Whether places that are given, not estimated, moved: then it is another world.
bool truth_moved(const FigureDiff& diff) {
  return std::ranges::any_of(diff.moves, [](const MarkMove& move) {
    return move.place.find("\"true ") != std::string::npos ||
           move.place.find("\"truth\"") != std::string::npos;
  });
}

Verdict direction(const FigureDiff& diff) {
  const bool other_records =
      std::ranges::find(diff.changes, kRecordsWord, &FigureChange::what) != diff.changes.end();
  if (other_records || truth_moved(diff)) return Verdict::kChanged;
  if (!diff.baseline_error || !diff.current_error) return Verdict::kChanged;
  const double change = *diff.current_error - *diff.baseline_error;
  if (std::abs(change) <= 1e-6 * (1.0 + std::abs(*diff.baseline_error))) return Verdict::kChanged;
  return change > 0.0 ? Verdict::kWorse : Verdict::kBetter;
}

std::string data_cause(const FigureDiff& diff) {
  std::string text;
  if (!diff.moves.empty()) {
    text = move_text(diff.moves[0]);
    if (diff.moved > 1) text += fmt::format(", {} moved in all", diff.moved);
  }
  const std::string more = first_of(diff, ChangeKind::kData);
  if (!more.empty()) text += (text.empty() ? "" : "; ") + more;
  const auto records = std::ranges::find(diff.changes, kRecordsWord, &FigureChange::what);
  if (text.empty() && records != diff.changes.end())
    text = std::string(kMadeOfOthers) + ", " + records->baseline + " \u2192 " + records->current;
  if (direction(diff) != Verdict::kChanged)
    text +=
        fmt::format("; mean error {}", change_text(*diff.baseline_error, *diff.current_error, ""));
  return text;
}

}  // namespace

std::string move_text(const MarkMove& move) {
  const std::string of = move.curve.empty() ? move.place : printable(move.curve);
  const std::string who = move.landmark.empty() ? fmt::format("point {} of {}", move.point + 1, of)
                                                : "landmark " + printable(move.landmark);
  std::string text =
      std::isnan(move.distance)
          ? fmt::format(
                "{} {}", who,
                std::isnan(move.current.x + move.current.y) ? "lost its place" : "gained a place")
          : fmt::format("{} moved {}", who, length_text(move.distance, move.unit));
  if (move.distance_px) text += fmt::format(" ({:.1f} px)", *move.distance_px);
  return text;
}

Judgement judge(const FigureDiff& diff) {
  if (diff.equal) return {};
  if (diff.has(ChangeKind::kData)) return {direction(diff), true, data_cause(diff)};
  if (diff.has(ChangeKind::kStyle))
    return {Verdict::kStyle, true, first_of(diff, ChangeKind::kStyle)};
  if (diff.has(ChangeKind::kMetadata))
    return {Verdict::kStyle, true, "words alone: " + first_of(diff, ChangeKind::kMetadata)};
  if (diff.within > 0)
    return {Verdict::kWithinTolerance, false,
            counted(diff.within, "point") + " moved within tolerance"};
  if (diff.masked > 0)
    return {
        Verdict::kWithinTolerance, false,
        fmt::format("varies from run to run: {} not judged", counted(diff.masked, "difference"))};
  return {};
}

}  // namespace mapproof
