#include "reports/diff/figures/figure_diff.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/words.hpp"
#include "render/plot/figure_fields.hpp"
#include "reports/diff/documents/excerpts.hpp"
#include "reports/diff/figures/figure_layers.hpp"
#include "reports/diff/figures/figure_log.hpp"
#include "reports/diff/figures/figure_match.hpp"
#include "reports/diff/figures/figure_positions.hpp"
#include "reports/diff/records/numbers_in_text.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostRecordIds = 3;
constexpr std::string_view kAlternativeText = "alternative text";

/// Whether a point is given, not estimated.
bool is_given(const MarkMove& move) {
  return move.location.find("\"true ") != std::string::npos ||
         move.location.find("\"ground_truth\"") != std::string::npos;
}

std::string text_of(const std::optional<Range>& limits) {
  return limits ? fmt::format("{} to {}", limits->low, limits->high)
                : std::string("what the data need");
}

/// Texts are not data, but the numbers in them are, except in a figure that varies.
ChangeKind kind_of(const std::string& a, const std::string& b, bool varies, ChangeKind of_words) {
  return varies || same_numbers(a, b) ? of_words : ChangeKind::kData;
}

void compare_words(const Figure& a, const Figure& b, FigureLog& log) {
  const bool varies = a.varies && b.varies;
  const auto words = [&](std::string_view what, const std::string& before,
                         const std::string& after) {
    log.change(kind_of(before, after, varies, ChangeKind::kMetadata), "figure", what, before,
               after);
  };
  log.change(ChangeKind::kMetadata, "figure", "id", a.id, b.id);
  words("title", a.title, b.title);
  words("caption", a.caption, b.caption);
  // In a figure that varies it contains the values, perhaps in a different order.
  if (a.alt != b.alt && varies)
    log.mask();
  else
    words(kAlternativeText, a.alt, b.alt);
  // This is data: the next comparison judges less of a figure that varies.
  log.change(ChangeKind::kData, "figure", "varies from run to run", a.varies ? "yes" : "no",
             b.varies ? "yes" : "no");
  if (a.record_ids != b.record_ids) {
    const std::string before = listed(a.record_ids, kMostRecordIds);
    const std::string after = listed(b.record_ids, kMostRecordIds);
    log.change(ChangeKind::kData, "figure", kRecordsWord, before,
               before == after ? "others" : after);
  }
  for (std::size_t i = 0; i < std::max(a.notes.size(), b.notes.size()); ++i) {
    const bool before = i < a.notes.size(), after = i < b.notes.size();
    const std::string first = before ? a.notes[i].text : "", second = after ? b.notes[i].text : "";
    log.change(kind_of(first, second, varies, ChangeKind::kStyle), "figure", "note", first, second);
    if (before && after)
      log.change(ChangeKind::kStyle, "figure", "colour of a note",
                 std::string(name_in_files(a.notes[i].colour)),
                 std::string(name_in_files(b.notes[i].colour)));
  }
}

std::string arrows_text(const Figure& figure) {
  std::string text;
  for (const PanelArrow& arrow : figure.arrows)
    text += fmt::format("after panel {}: {}; ", arrow.from + 1, arrow.label);
  return text;
}

void compare_frame(const Figure& a, const Figure& b, FigureLog& log) {
  const auto add = [&](std::string_view what, const std::string& before, const std::string& after) {
    log.change(ChangeKind::kStyle, "figure", what, before, after);
  };
  const auto panels = [](const Figure& figure) {
    return counted(static_cast<long long>(figure.panels.size()), "panel");
  };
  add("panels", panels(a), panels(b));
  add("columns", std::to_string(a.columns), std::to_string(b.columns));
  add("x axis", a.shared_x ? "shared" : "own", b.shared_x ? "shared" : "own");
  add("y axis", a.shared_y ? "shared" : "own", b.shared_y ? "shared" : "own");
  add("arrows", arrows_text(a), arrows_text(b));
}

/// The same axis of a panel on both sides.
struct AxisPair {
  const char* name;  ///< "x" or "y".
  const Axis& baseline;
  const Axis& current;
};

void compare_axis(const std::string& location, const AxisPair& axes, bool varies, FigureLog& log) {
  const Axis &a = axes.baseline, &b = axes.current;
  const auto add = [&](const char* what, const std::string& before, const std::string& after) {
    log.change(ChangeKind::kStyle, location, fmt::format("{} of {}", what, axes.name), before,
               after);
  };
  add("label", a.label, b.label);
  add("scale", a.scale == Scale::kLog ? "log" : "linear",
      b.scale == Scale::kLog ? "log" : "linear");
  if (varies && a.limits != b.limits)
    log.mask();
  else
    add("limits", text_of(a.limits), text_of(b.limits));
  add("ticks", a.whole ? "whole numbers" : "any", b.whole ? "whole numbers" : "any");
  add("names", listed(a.names, a.names.size() + 1), listed(b.names, b.names.size() + 1));
}

void compare_axes(const std::string& location, const Panel& a, const Panel& b, bool varies,
                  FigureLog& log) {
  log.change(ChangeKind::kStyle, location, "title", a.title, b.title);
  compare_axis(location, {"x", a.x, b.x}, varies, log);
  compare_axis(location, {"y", a.y, b.y}, varies, log);
  log.change(ChangeKind::kStyle, location, "aspect", a.equal_aspect ? "equal" : "free",
             b.equal_aspect ? "equal" : "free");
  log.change(ChangeKind::kStyle, location, "frame", a.bare ? "bare" : "with axes",
             b.bare ? "bare" : "with axes");
}

void compare_layers(const Panel& a, const Panel& b, LayerDiff& layers, FigureLog& log) {
  std::size_t last = 0;
  for (const Match& match : match_layers(a.layers, b.layers)) {
    if (!match.baseline || !match.current) {
      layers.lone(match.baseline ? a.layers[*match.baseline] : b.layers[*match.current],
                  match.baseline.has_value());
      continue;
    }
    const LayerView before = view_of(a.layers[*match.baseline]);
    if (*match.current < last)
      log.change(ChangeKind::kStyle, layers.location(before), "order of layers",
                 fmt::format("after layer {}", last + 1),
                 fmt::format("layer {}", *match.current + 1));
    last = std::max(last, *match.current);
    if (a.layers[*match.baseline] == b.layers[*match.current])
      layers.add_errors(before, before);
    else
      layers.compare(before, view_of(b.layers[*match.current]));
  }
}

constexpr std::size_t kMostValueText = 60;  // Characters of a value in a sentence.
constexpr std::size_t kMostTitle = 160;     // Of a title, which is read as a whole.

/// "41 mm", "1.2 m"; other units as they are.
std::string length_text(double length, const std::string& unit) {
  if (unit == "m" && length > kGreatestError_m) return kGreatErrorText;
  if (unit == "m" && length < 0.9995) return fmt::format("{:.3g} mm", 1000.0 * length);
  return fmt::format("{:.3g}{}{}", length, unit.empty() ? "" : " ", unit);
}

/// Without the full stop of a text that a sentence holds.
std::string without_stop(std::string text) {
  if (text.ends_with('.') && !text.ends_with("..")) text.pop_back();
  return text;
}

std::string change_sentence(const FigureChange& change) {
  const auto [baseline, current] = readable_numbers(change.baseline, change.current);
  auto [before, after] =
      excerpts(baseline, current, change.what == "title" ? kMostTitle : kMostValueText);
  before = without_stop(std::move(before)), after = without_stop(std::move(after));
  std::string text = change.location + ": " + change.what;
  if (change.baseline.empty() && change.current.empty()) return text;
  if (change.current.empty()) return text + " (was " + before + ")";
  if (change.baseline.empty()) return text + " (" + after + ")";
  return fmt::format("{} {} \u2192 {}", text, before, after);
}

/// Whether a text repeats in its numbers what the figure draws.
bool repeats_data(const FigureChange& change) {
  return change.what == "caption" || change.what == kAlternativeText;
}

/// The first change of that kind, and the number of others. A change of records has a sentence of
/// its own.
/// @param data_are_named  Texts that repeat the data are then left out.
std::string first_of(const FigureDiff& diff, ChangeKind kind, bool data_are_named = false) {
  const FigureChange* first = nullptr;
  long count = 0;
  for (const FigureChange& change : diff.changes)
    if (change.kind == kind && change.what != kRecordsWord &&
        !(data_are_named && repeats_data(change)) && count++ == 0)
      first = &change;
  if (first == nullptr) return "";
  return change_sentence(*first) +
         (count > 1 ? fmt::format(", and {}", counted(count - 1, "other change")) : "");
}

/// Whether positions that are given, not estimated, moved: the experiments then differ.
bool ground_truth_moved(const FigureDiff& diff) {
  return std::ranges::any_of(diff.moves, is_given);
}

Verdict direction(const FigureDiff& diff) {
  const bool other_records =
      std::ranges::find(diff.changes, kRecordsWord, &FigureChange::what) != diff.changes.end();
  if (other_records || ground_truth_moved(diff)) return Verdict::kChanged;
  if (!diff.baseline_error || !diff.current_error) return Verdict::kChanged;
  const double change = *diff.current_error - *diff.baseline_error;
  if (std::abs(change) <= 1e-6 * (1.0 + std::abs(*diff.baseline_error))) return Verdict::kChanged;
  return change > 0.0 ? Verdict::kWorse : Verdict::kBetter;
}

/// "27 landmarks": each once, however many layers draw it; else the points that are drawn.
std::string moved_text(const FigureDiff& diff) {
  std::set<std::string> landmarks;
  for (const MarkMove& move : diff.moves) landmarks.insert(move.landmark);
  const bool all_known = diff.moved == std::ssize(diff.moves) && !landmarks.contains("");
  return all_known ? counted(std::ssize(landmarks), "landmark")
                   : counted(diff.moved, "drawn point");
}

std::string data_cause(const FigureDiff& diff) {
  std::string text;
  if (!diff.transforms.empty()) {
    text = diff.transforms.front();
  } else if (!diff.moves.empty()) {
    text = move_text(diff.moves[0]);
    if (diff.moved > 1) text += fmt::format(", {} moved in all", moved_text(diff));
  }
  const std::string more = first_of(diff, ChangeKind::kData, !text.empty());
  if (!more.empty()) text += (text.empty() ? "" : "; ") + more;
  const auto records = std::ranges::find(diff.changes, kRecordsWord, &FigureChange::what);
  if (text.empty() && records != diff.changes.end())
    text = std::string(kMadeOfOthers) + ", " + records->baseline + " \u2192 " + records->current;
  if (direction(diff) != Verdict::kChanged)
    text += fmt::format("; mean error of the positions drawn, without anchors, {}",
                        change_text(*diff.baseline_error, *diff.current_error, "m", true));
  return text;
}

}  // namespace

FigureDiff figure_diff(const Figure& a, const Figure& b, const FigureOptions& options) {
  const bool varies = a.varies && b.varies;
  FigureLog log(varies);
  if (a == b) return log.take();
  const FigurePositions locations(a, b);
  compare_words(a, b, log);
  compare_frame(a, b, log);
  for (std::size_t p = 0; p < std::max(a.panels.size(), b.panels.size()); ++p) {
    if (p >= a.panels.size() || p >= b.panels.size()) {
      const bool removed = p < a.panels.size();
      LayerDiff layers({p, a, locations, options}, log);
      for (const Layer& layer : (removed ? a : b).panels[p].layers) layers.lone(layer, removed);
      continue;
    }
    compare_axes(fmt::format("panel {}", p + 1), a.panels[p], b.panels[p], varies, log);
    const auto shared = varies ? shared_names(a.panels[p], b.panels[p]) : std::set<std::string>();
    LayerDiff layers({p, a, locations, options, varies ? &shared : nullptr}, log);
    compare_layers(a.panels[p], b.panels[p], layers, log);
  }
  return log.take();
}

std::string move_text(const MarkMove& move) {
  const std::string of = move.curve.empty() ? move.location : printable(move.curve);
  const std::string who = move.landmark.empty()
                              ? fmt::format("point {} of {}", move.point + 1, of)
                              : (is_given(move) ? "the true position of landmark " : "landmark ") +
                                    printable(move.landmark);
  std::string text =
      std::isnan(move.distance)
          ? fmt::format("{} {}", who,
                        std::isnan(move.current.x + move.current.y) ? "lost its position"
                                                                    : "gained a position")
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
    return {Verdict::kStyle, true, "only texts: " + first_of(diff, ChangeKind::kMetadata)};
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
