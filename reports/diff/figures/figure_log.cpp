#include "reports/diff/figures/figure_log.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "reports/diff/records/map_transform.hpp"
#include "reports/diff/records/numbers_in_text.hpp"

namespace mapproof {

namespace {

constexpr double kWritten = 2e-5;  // Relative: data-* hold six digits.

/// A text of a figure that varies without what varies in it: its numbers, and "ms" and "µs", since
/// times have the unit that fits them.
std::string varying_words(std::string_view text) {
  std::string words = without_numbers(text);
  for (const std::string_view unit : {"ms", "µs"})
    for (std::size_t at = words.find(unit); at != std::string::npos;
         at = words.find(unit, at + 1)) {
      const std::size_t end = at + unit.size();
      const bool begins =
          at > 0 && std::string_view("[ \xA0").find(words[at - 1]) != std::string::npos;
      const bool ends =
          end == words.size() || std::isalnum(static_cast<unsigned char>(words[end])) == 0;
      if (begins && ends) words.replace(at, unit.size(), "s");
    }
  return words;
}

/// The name of one point.
std::string point_text(const LayerView& layer, std::size_t point) {
  if (layer.has_mark_a_point()) {
    const std::string_view landmark = data_of(layer.marks[point], "landmark");
    if (!landmark.empty()) return "landmark " + printable(std::string(landmark));
    if (!layer.marks[point].id.empty()) return layer.marks[point].id;
  }
  if (!layer.texts.empty()) return "\"" + printable(layer.texts[point]) + "\"";
  return fmt::format("point {}", point + 1);
}

/// "m" of "x [m]"; empty if the label names no unit.
std::string unit_of(const Axis& axis) {
  const std::size_t open = axis.label.rfind('['), close = axis.label.rfind(']');
  if (open == std::string::npos || close == std::string::npos || close < open) return "";
  return printable(axis.label.substr(open + 1, close - open - 1));
}

/// The unit of the axis along which a point moved, or of both.
std::string unit_of_move(const Panel& panel, Point before, Point after) {
  std::string x = unit_of(panel.x), y = unit_of(panel.y);
  if (before.x == after.x) return y;
  return before.y == after.y || x == y ? x : "";
}

/// The whole text as a number.
std::optional<double> number_of(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' ? std::optional(value) : std::nullopt;
}

constexpr std::size_t kMostEntries = 200;

/// FigureChange::what of a point of another name.
constexpr std::string_view kRenamedWord = "renamed";

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

void FigureLog::change(ChangeKind kind, const std::string& location, std::string_view what,
                       const std::string& baseline, const std::string& current) {
  if (baseline == current) return;
  if (varies_ && what != kRecordsWord && varying_words(baseline) == varying_words(current)) {
    ++diff_.masked;
    return;
  }
  ++diff_.total_changes;
  // Keeps the first ones of each kind, so that many of one kind do not hide another.
  const auto same_kind = std::ranges::count(diff_.changes, kind, &FigureChange::kind);
  if (same_kind < static_cast<std::ptrdiff_t>(kMostEntries))
    diff_.changes.push_back({kind, location, std::string(what), baseline, current});
}

void FigureLog::move(MarkMove move) {
  if (varies_) {
    ++diff_.masked;
    return;
  }
  ++diff_.moved;
  if (!move.landmark.empty()) moved_landmarks_.emplace(move.panel, move.landmark);
  diff_.moves.push_back(std::move(move));
  if (diff_.moves.size() > 8 * kMostEntries) keep_farthest(diff_.moves);
}

void FigureLog::within(std::size_t panel, std::string_view landmark) {
  if (landmark.empty())
    ++diff_.within;
  else
    within_landmarks_.emplace(panel, landmark);
}

void FigureLog::errors(double baseline, double current, double count) {
  baseline_errors_ += baseline;
  current_errors_ += current;
  errors_ += count;
}

void FigureLog::transform(std::string text) {
  if (!varies_) diff_.transforms.push_back(std::move(text));
}

FigureDiff FigureLog::take() {
  diff_.within_landmarks = std::ranges::count_if(within_landmarks_, [&](const auto& landmark) {
    return !moved_landmarks_.contains(landmark);
  });
  diff_.within += diff_.within_landmarks;
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

LayerDiff::LayerDiff(const ComparedPanel& panel, FigureLog& log) : panel_(panel), log_(log) {
  if (panel.panel >= panel.figure.panels.size()) return;
  for (const Layer& layer : panel.figure.panels[panel.panel].layers)
    for (const Mark& mark : view_of(layer).marks)
      if (data_of(mark, "kind") == "anchor") anchors_.emplace(data_of(mark, "landmark"));
}

std::string LayerDiff::location(const LayerView& layer) const {
  std::string text =
      panel_.figure.panels.size() > 1 ? fmt::format("panel {}, ", panel_.panel + 1) : "";
  text += layer.kind;
  std::string name = layer.label;
  if (name.empty() && layer.is_whole) name = layer.marks[0].id;
  if (!name.empty()) text += " \"" + printable(name) + "\"";
  return text;
}

/// Points without names appear and disappear with the data.
bool LayerDiff::may_vary(const LayerView& layer, std::size_t point) const {
  if (panel_.shared == nullptr) return false;
  if (!layer.has_mark_a_point()) return true;
  const std::string& name = layer.marks[point].id;
  return name.empty() || panel_.shared->contains(name);
}

void LayerDiff::lone(const Layer& layer, bool removed) {
  const LayerView view = view_of(layer);
  bool all_vary = panel_.shared != nullptr && !view.is_whole;
  for (std::size_t i = 0; i < view.points(); ++i) all_vary = all_vary && may_vary(view, i);
  if (all_vary) {
    log_.mask();
    return;
  }
  const std::string what = counted(static_cast<long long>(view.points()), "point");
  // An empty layer shows nothing.
  log_.change(is_empty(layer) ? ChangeKind::kMetadata : ChangeKind::kData, location(view),
              removed ? "layer removed" : "layer added", removed ? what : "", removed ? "" : what);
}

void LayerDiff::compare(const LayerView& a, const LayerView& b) {
  location_ = location(a);
  log_.change(ChangeKind::kStyle, location_, "label", a.label, b.label);
  for (std::size_t i = 0; i < a.styles.size(); ++i)
    log_.change(ChangeKind::kStyle, location_, a.styles[i].what, a.styles[i].value,
                b.styles[i].value);
  for (std::size_t i = 0; i < a.extents.size(); ++i)
    if (!panel_.options.position.holds(a.extents[i].value, b.extents[i].value))
      log_.change(ChangeKind::kData, location_, a.extents[i].what,
                  fmt::format("{}", a.extents[i].value), fmt::format("{}", b.extents[i].value));
  if (a.is_whole) compare_data(a.marks[0], b.marks[0]);
  std::vector<std::size_t> removed, added;
  const std::vector<Match> matches = match_points(a, b);
  const long moved_before = log_.moved();
  for (const Match& match : matches) {
    if (match.baseline && match.current) {
      compare_point(a, *match.baseline, b, *match.current);
    } else if (match.baseline ? may_vary(a, *match.baseline) : may_vary(b, *match.current)) {
      log_.mask();
    } else if (match.baseline) {
      removed.push_back(*match.baseline);
    } else {
      added.push_back(*match.current);
    }
  }
  take_renamed(a, removed, b, added);
  lone_points("removed", a, removed);
  lone_points("added", b, added);
  if (log_.moved() - moved_before > 2) note_transform(a, b, matches);
  compare_values(a, b, matches);
  add_errors(a, b);
}

/// Points of other names at equal positions are renamed.
void LayerDiff::take_renamed(const LayerView& a, std::vector<std::size_t>& removed,
                             const LayerView& b, std::vector<std::size_t>& added) {
  std::erase_if(removed, [&](std::size_t i) {
    const auto same = std::ranges::find_if(
        added, [&](std::size_t j) { return have_equal_coordinates(a, i, b, j); });
    if (same == added.end()) return false;
    log_.change(ChangeKind::kData, location_, kRenamedWord, point_text(a, i), point_text(b, *same));
    if (a.has_mark_a_point() && b.has_mark_a_point())
      log_.change(ChangeKind::kMetadata, location_, "id of a mark", a.marks[i].id,
                  b.marks[*same].id);
    added.erase(same);
    return true;
  });
}

/// Notes what moved all points of a layer together, where both axes have one scale.
void LayerDiff::note_transform(const LayerView& a, const LayerView& b,
                               const std::vector<Match>& matches) {
  const Panel& panel = panel_.figure.panels[panel_.panel];
  if (a.locations.size() != 1 || !panel.equal_aspect) return;
  const auto n = static_cast<Eigen::Index>(matches.size());
  Points before = Points::Constant(n, 2, kNaN), after = before;
  for (Eigen::Index row = 0; row < n; ++row) {
    const Match& match = matches[static_cast<std::size_t>(row)];
    if (!match.baseline || !match.current) continue;
    const Locations& at = a.locations.front();
    before.row(row) << a.coordinates[at.x].values[*match.baseline],
        a.coordinates[at.y].values[*match.baseline];
    after.row(row) << b.coordinates[at.x].values[*match.current],
        b.coordinates[at.y].values[*match.current];
  }
  const bool is_map =
      std::ranges::any_of(a.marks, [](const Mark& m) { return !data_of(m, "landmark").empty(); });
  if (const auto transform = map_transform(before, after))
    log_.transform(transform_text(*transform, is_map ? "landmark" : "point", unit_of(panel.x)));
}

void LayerDiff::lone_points(const char* what, const LayerView& layer,
                            const std::vector<std::size_t>& points) {
  if (points.empty()) return;
  const auto count = static_cast<long>(points.size());
  const std::string first = point_text(layer, points.front());
  const std::string text = count == 1 ? first : fmt::format("{} and {} more", first, count - 1);
  const bool removed = what[0] == 'r';
  log_.change(ChangeKind::kData, location_, fmt::format("{} {}", counted(count, "point"), what),
              removed ? text : "", removed ? "" : text);
}

void LayerDiff::compare_point(const LayerView& a, std::size_t i, const LayerView& b,
                              std::size_t j) {
  std::optional<MarkMove> farthest;
  bool is_within = false;
  for (const Locations& at : a.locations) {
    const Point before{a.coordinates[at.x].values[i], a.coordinates[at.y].values[i]};
    const Point after{b.coordinates[at.x].values[j], b.coordinates[at.y].values[j]};
    const Movement movement =
        panel_.locations.movement(panel_.panel, before, after, panel_.options.position);
    is_within |= movement == Movement::kWithin;
    if (movement != Movement::kBeyond) continue;
    MarkMove move = mark_move(a, i, before, after);
    if (!farthest || move.distance > farthest->distance) farthest = std::move(move);
  }
  if (i < a.texts.size() && j < b.texts.size() && panel_.shared == nullptr)
    // Labels are names of points; texts may be the values of cells.
    log_.change(a.kind == "labels" || !same_numbers(a.texts[i], b.texts[j]) ? ChangeKind::kData
                                                                            : ChangeKind::kStyle,
                location_, "text", a.texts[i], b.texts[j]);
  if (farthest) {
    log_.move(*std::move(farthest));
    return;
  }
  if (is_within)
    log_.within(panel_.panel,
                a.has_mark_a_point() ? data_of(a.marks[i], "landmark") : std::string_view());
  if (a.has_mark_a_point() && b.has_mark_a_point()) compare_data(a.marks[i], b.marks[j]);
}

MarkMove LayerDiff::mark_move(const LayerView& layer, std::size_t point, Point before,
                              Point after) const {
  MarkMove move{.location = location_,
                .mark = "",
                .landmark = "",
                .curve = "",
                .panel = panel_.panel,
                .point = point,
                .baseline = before,
                .current = after,
                .distance = std::hypot(after.x - before.x, after.y - before.y),
                .unit = unit_of_move(panel_.figure.panels[panel_.panel], before, after),
                .x_unit = unit_of(panel_.figure.panels[panel_.panel].x),
                .y_unit = unit_of(panel_.figure.panels[panel_.panel].y),
                .distance_px = panel_.locations.distance_px(panel_.panel, before, after),
                .is_line = layer.kind == "segments",
                .on_map = panel_.figure.panels[panel_.panel].equal_aspect};
  if (layer.has_mark_a_point() || layer.is_whole) {
    const Mark& mark = layer.is_whole ? layer.marks[0] : layer.marks[point];
    move.mark = mark.id;
    move.landmark = data_of(mark, "landmark");
    move.curve = data_of(mark, "curve");
  }
  return move;
}

/// Compares coordinates that are not positions: half axes, angles, cells.
void LayerDiff::compare_values(const LayerView& a, const LayerView& b,
                               const std::vector<Match>& matches) {
  for (std::size_t c = 0; c < a.coordinates.size(); ++c) {
    if (std::ranges::any_of(a.locations, [&](Locations at) { return at.x == c || at.y == c; }))
      continue;
    long count = 0;
    double first = 0.0, second = 0.0;
    for (const Match& match : matches) {
      if (!match.baseline || !match.current) continue;
      const double before = a.coordinates[c].values[*match.baseline];
      const double after = b.coordinates[c].values[*match.current];
      if (before == after || (std::isnan(before) && std::isnan(after))) continue;
      if (panel_.options.position.holds(before, after)) {
        log_.within();
      } else if (count++ == 0) {
        first = before;
        second = after;
      }
    }
    if (count > 0)
      log_.change(ChangeKind::kData, location_,
                  fmt::format("{} of {}", a.coordinates[c].name, counted(count, "point")),
                  fmt::format("{}", first), fmt::format("{}", second));
  }
}

void LayerDiff::compare_data(const Mark& a, const Mark& b) {
  log_.change(ChangeKind::kMetadata, location_, "id of a mark", a.id, b.id);
  if (a.data == b.data) return;
  for (const auto& [key, value] : a.data) {
    const std::string other(data_of(b, key));
    const auto first = number_of(value), second = number_of(other);
    if (first && second && Tolerance{1e-9, kWritten}.holds(*first, *second)) continue;
    if (key == "landmark") {
      log_.change(ChangeKind::kData, location_, kRenamedWord, "landmark " + value,
                  "landmark " + other);
      continue;
    }
    log_.change(first && second ? ChangeKind::kData : ChangeKind::kStyle, location_, "data-" + key,
                value, other);
  }
  for (const auto& [key, value] : b.data)
    if (std::ranges::none_of(a.data, [&](const auto& item) { return item.first == key; }))
      log_.change(ChangeKind::kMetadata, location_, "data-" + key, "", value);
}

void LayerDiff::add_errors(const LayerView& a, const LayerView& b) {
  // The segments of a map repeat the errors of its points.
  if (!a.has_mark_a_point() || !b.has_mark_a_point() || a.kind == "segments") return;
  double first = 0.0, second = 0.0, count = 0.0;
  for (const Match& match : match_points(a, b)) {
    if (!match.baseline || !match.current) continue;
    if (anchors_.contains(std::string(data_of(a.marks[*match.baseline], "landmark")))) continue;
    const auto before = number_of(std::string(data_of(a.marks[*match.baseline], "error")));
    const auto after = number_of(std::string(data_of(b.marks[*match.current], "error")));
    if (!before || !after || !std::isfinite(*before) || !std::isfinite(*after)) continue;
    first += *before;
    second += *after;
    count += 1.0;
  }
  log_.errors(first, second, count);
}

std::set<std::string> shared_names(const Panel& a, const Panel& b) {
  const auto names_of = [](const Panel& panel) {
    std::set<std::string> names;
    for (const Layer& layer : panel.layers) {
      const LayerView view = view_of(layer);
      if (!view.has_mark_a_point()) continue;
      for (const Mark& mark : view.marks) names.insert(mark.id);
    }
    return names;
  };
  const std::set<std::string> first = names_of(a), second = names_of(b);
  std::set<std::string> shared;
  std::ranges::set_intersection(first, second, std::inserter(shared, shared.end()));
  return shared;
}

}  // namespace mapproof
