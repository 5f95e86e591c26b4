#include "reports/diff/figures/figure_log.hpp"

#include <algorithm>
#include <utility>

#include "reports/diff/records/number_words.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostEntries = 200;

void keep_farthest(std::vector<MarkMove>& moves) {
  const auto far = [](const MarkMove& move) {
    return std::pair(move.distance_px.value_or(0.0), move.distance);
  };
  std::ranges::stable_sort(moves, std::ranges::greater(), far);
  if (moves.size() > kMostEntries) moves.resize(kMostEntries);
}

}  // namespace

std::string_view name(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::kMetadata:
      return "metadata";
    case ChangeKind::kStyle:
      return "style";
    case ChangeKind::kData:
      return "data";
  }
  return "";
}

bool FigureDiff::has(ChangeKind kind) const {
  if (kind == ChangeKind::kData && moved > 0) return true;
  return std::ranges::any_of(changes, [&](const FigureChange& c) { return c.kind == kind; });
}

void FigureLog::change(ChangeKind kind, const std::string& place, std::string_view what,
                       const std::string& baseline, const std::string& current) {
  if (baseline == current) return;
  if (varies_ && what != kRecordsWord && without_numbers(baseline) == without_numbers(current)) {
    ++diff_.masked;
    return;
  }
  ++diff_.total_changes;
  // Keeps the first ones of each kind, so that many of one kind do not hide another.
  const auto same_kind = std::ranges::count(diff_.changes, kind, &FigureChange::kind);
  if (same_kind < static_cast<std::ptrdiff_t>(kMostEntries))
    diff_.changes.push_back({kind, place, std::string(what), baseline, current});
}

void FigureLog::move(MarkMove move) {
  if (varies_) {
    ++diff_.masked;
    return;
  }
  ++diff_.moved;
  diff_.moves.push_back(std::move(move));
  if (diff_.moves.size() > 8 * kMostEntries) keep_farthest(diff_.moves);
}

void FigureLog::errors(double baseline, double current, double count) {
  baseline_errors_ += baseline;
  current_errors_ += current;
  errors_ += count;
}

FigureDiff FigureLog::take() {
  diff_.equal = diff_.total_changes + diff_.moved + diff_.within + diff_.masked == 0;
  if (errors_ > 0.0) {
    diff_.baseline_error = baseline_errors_ / errors_;
    diff_.current_error = current_errors_ / errors_;
  }
  const auto kind = [](const FigureChange& change) { return -static_cast<int>(change.kind); };
  std::ranges::stable_sort(diff_.changes, {}, kind);
  if (diff_.changes.size() > kMostEntries) diff_.changes.resize(kMostEntries);
  keep_farthest(diff_.moves);
  return std::move(diff_);
}

}  // namespace mapproof
