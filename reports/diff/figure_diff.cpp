#include "reports/diff/figure_diff.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "reports/diff/figure_layers.hpp"
#include "reports/diff/figure_match.hpp"
#include "reports/diff/figure_places.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMost = 200;
constexpr double kWritten = 2e-5;  // Relative: data-* hold six digits.

/// With every number as "#": what is left of words that hold varying numbers.
std::string without_numbers(const std::string& text) {
  std::string words;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit)
      words += c;
    else if (words.empty() || words.back() != '#')
      words += '#';
  }
  return words;
}

std::string text_of(const Range& range) { return fmt::format("{} to {}", range.low, range.high); }

std::string text_of(const std::optional<Range>& limits) {
  return limits ? text_of(*limits) : std::string("what the data need");
}

std::string place_text(std::size_t panel, std::size_t panels, const LayerView& layer) {
  std::string place = panels > 1 ? fmt::format("panel {}, ", panel + 1) : "";
  place += layer.kind;
  const std::string name = !layer.label.empty()                ? layer.label
                           : layer.is_whole && layer.marks[0].id.size() > 0 ? layer.marks[0].id
                                                                            : "";
  if (!name.empty()) place += " \"" + printable(name) + "\"";
  return place;
}

/// Of one point: what it is called.
std::string point_text(const LayerView& layer, std::size_t point) {
  if (layer.has_mark_a_point()) {
    const std::string_view landmark = data_of(layer.marks[point], "landmark");
    if (!landmark.empty()) return "landmark " + printable(std::string(landmark));
    if (!layer.marks[point].id.empty()) return layer.marks[point].id;
  }
  if (!layer.texts.empty()) return "\"" + printable(layer.texts[point]) + "\"";
  return fmt::format("point {}", point + 1);
}

class Comparer {
 public:
  Comparer(const Figure& a, const Figure& b, const FigureOptions& options)
      : a_(a), b_(b), varies_(a.varies && b.varies), options_(options), pages_(a, b) {}

  FigureDiff run() {
    diff_.equal = false;
    compare_words();
    compare_frame();
    const std::size_t panels = std::min(a_.panels.size(), b_.panels.size());
    for (std::size_t p = 0; p < panels; ++p) compare_panel(p);
    if (errors_[2] > 0.0) {
      diff_.baseline_error = errors_[0] / errors_[2];
      diff_.current_error = errors_[1] / errors_[2];
    }
    const auto kind = [](const FigureChange& change) { return -static_cast<int>(change.kind); };
    std::ranges::stable_sort(diff_.changes, {}, kind);
    if (diff_.changes.size() > kMost) diff_.changes.resize(kMost);
    diff_.equal = diff_.total_changes + diff_.moved + diff_.within + diff_.masked == 0;
    const auto far = [](const MarkMove& move) {
      return std::pair(move.distance_px.value_or(0.0), move.distance);
    };
    std::ranges::stable_sort(diff_.moves, std::ranges::greater(), far);
    if (diff_.moves.size() > kMost) diff_.moves.resize(kMost);
    return std::move(diff_);
  }

 private:
  void change(ChangeKind kind, const std::string& place, std::string_view what,
              const std::string& before, const std::string& after) {
    if (before == after) return;
    if (varies_ && (kind == ChangeKind::kData || without_numbers(before) == without_numbers(after))) {
      ++diff_.masked;
      return;
    }
    ++diff_.total_changes;
    // Data changes are kept whatever came before; all are cut to kMost at the end.
    if (diff_.changes.size() < 4 * kMost || kind == ChangeKind::kData)
      diff_.changes.push_back({kind, place, std::string(what), before, after});
  }

  void compare_words() {
    change(ChangeKind::kMetadata, "figure", "id", a_.id, b_.id);
    change(ChangeKind::kMetadata, "figure", "title", a_.title, b_.title);
    change(ChangeKind::kMetadata, "figure", "caption", a_.caption, b_.caption);
    change(ChangeKind::kMetadata, "figure", "alternative text", a_.alt, b_.alt);
    change(ChangeKind::kMetadata, "figure", "varies", a_.varies ? "yes" : "no",
           b_.varies ? "yes" : "no");
    if (a_.record_ids != b_.record_ids)
      change(ChangeKind::kData, "figure", "records", listed(a_.record_ids, 3),
             listed(b_.record_ids, 3) == listed(a_.record_ids, 3) ? "others"
                                                                  : listed(b_.record_ids, 3));
    for (std::size_t i = 0; i < std::max(a_.notes.size(), b_.notes.size()); ++i) {
      const Note* before = i < a_.notes.size() ? &a_.notes[i] : nullptr;
      const Note* after = i < b_.notes.size() ? &b_.notes[i] : nullptr;
      change(ChangeKind::kStyle, "figure", "note", before ? before->text : "",
             after ? after->text : "");
      if (before && after)
        change(ChangeKind::kStyle, "figure", "colour of a note", std::string(name(before->ink)),
               std::string(name(after->ink)));
    }
  }

  void compare_frame() {
    const auto count = [](std::size_t n) { return counted(static_cast<long long>(n), "panel"); };
    change(ChangeKind::kStyle, "figure", "panels", count(a_.panels.size()),
           count(b_.panels.size()));
    change(ChangeKind::kStyle, "figure", "columns", fmt::format("{}", a_.columns),
           fmt::format("{}", b_.columns));
    const auto shared = [](const Figure& f) {
      return fmt::format("x {}, y {}", f.shared_x ? "shared" : "own", f.shared_y ? "shared" : "own");
    };
    change(ChangeKind::kStyle, "figure", "axes", shared(a_), shared(b_));
    const auto arrows = [](const Figure& f) {
      std::string text;
      for (const PanelArrow& arrow : f.arrows)
        text += fmt::format("after panel {}: {}; ", arrow.from + 1, arrow.label);
      return text;
    };
    change(ChangeKind::kStyle, "figure", "arrows", arrows(a_), arrows(b_));
  }

  void compare_axis(const std::string& place, const char* which, const Axis& a, const Axis& b) {
    const auto what = [&](const char* of) { return fmt::format("{} of {}", of, which); };
    change(ChangeKind::kStyle, place, what("label"), a.label, b.label);
    change(ChangeKind::kStyle, place, what("scale"), a.scale == Scale::kLog ? "log" : "linear",
           b.scale == Scale::kLog ? "log" : "linear");
    change(ChangeKind::kStyle, place, what("limits"), text_of(a.limits), text_of(b.limits));
    change(ChangeKind::kStyle, place, what("ticks"), a.whole ? "whole numbers" : "any",
           b.whole ? "whole numbers" : "any");
  }

  void compare_panel(std::size_t p) {
    const Panel& a = a_.panels[p];
    const Panel& b = b_.panels[p];
    panel_ = p;
    const std::string place = fmt::format("panel {}", p + 1);
    change(ChangeKind::kStyle, place, "title", a.title, b.title);
    compare_axis(place, "x", a.x, b.x);
    compare_axis(place, "y", a.y, b.y);
    change(ChangeKind::kStyle, place, "aspect", a.equal_aspect ? "equal" : "free",
           b.equal_aspect ? "equal" : "free");
    change(ChangeKind::kStyle, place, "frame", a.bare ? "bare" : "with axes",
           b.bare ? "bare" : "with axes");
    std::optional<std::size_t> last;
    for (const Match& match : match_layers(a.layers, b.layers)) {
      if (!match.baseline || !match.current) {
        lone_layer(a, b, match);
        continue;
      }
      const LayerView before = view_of(a.layers[*match.baseline]);
      if (last && *match.current < *last)
        change(ChangeKind::kStyle, place_text(p, a_.panels.size(), before), "order of layers",
               fmt::format("{}", *match.baseline + 1), fmt::format("{}", *match.current + 1));
      last = std::max(last.value_or(0), *match.current);
      if (a.layers[*match.baseline] == b.layers[*match.current])
        add_errors(before, before);
      else
        compare_layer(before, view_of(b.layers[*match.current]));
    }
  }

  void lone_layer(const Panel& a, const Panel& b, const Match& match) {
    const bool removed = match.baseline.has_value();
    const Layer& layer = removed ? a.layers[*match.baseline] : b.layers[*match.current];
    const LayerView view = view_of(layer);
    const std::string place = place_text(panel_, a_.panels.size(), view);
    const std::string what = counted(static_cast<long long>(view.points()), "point");
    // An empty layer shows nothing.
    const ChangeKind kind = is_empty(layer) ? ChangeKind::kMetadata : ChangeKind::kData;
    change(kind, place, removed ? "layer removed" : "layer added", removed ? what : "",
           removed ? "" : what);
  }

  void compare_layer(const LayerView& a, const LayerView& b) {
    const std::string place = place_text(panel_, a_.panels.size(), a);
    change(ChangeKind::kStyle, place, "label", a.label, b.label);
    for (std::size_t i = 0; i < a.looks.size(); ++i)
      change(ChangeKind::kStyle, place, a.looks[i].what, a.looks[i].value, b.looks[i].value);
    for (std::size_t i = 0; i < a.extents.size(); ++i)
      if (!options_.position.holds(a.extents[i].value, b.extents[i].value))
        change(ChangeKind::kData, place, a.extents[i].what, fmt::format("{}", a.extents[i].value),
               fmt::format("{}", b.extents[i].value));
    if (a.is_whole) compare_data(place, a.marks[0], b.marks[0]);
    long removed = 0, added = 0;
    std::string first_removed, first_added;
    for (const Match& match : match_points(a, b)) {
      if (match.baseline && match.current) {
        compare_point(place, a, *match.baseline, b, *match.current);
      } else if (match.baseline) {
        if (removed++ == 0) first_removed = point_text(a, *match.baseline);
      } else if (added++ == 0) {
        first_added = point_text(b, *match.current);
      }
    }
    lone_points(place, "removed", removed, first_removed);
    lone_points(place, "added", added, first_added);
    report_values(place, a);
    add_errors(a, b);
  }

  void lone_points(const std::string& place, const char* what, long count,
                   const std::string& first) {
    if (count == 0) return;
    const std::string text =
        count == 1 ? first : fmt::format("{} and {} more", first, count - 1);
    const bool removed = what[0] == 'r';
    change(ChangeKind::kData, place, fmt::format("{} {}", counted(count, "point"), what),
           removed ? text : "", removed ? "" : text);
  }

  void compare_point(const std::string& place, const LayerView& a, std::size_t i,
                     const LayerView& b, std::size_t j) {
    std::optional<MarkMove> farthest;
    bool moved = false, within = false;
    for (const Places& at : a.places) {
      const Point before{a.coordinates[at.x].values[i], a.coordinates[at.y].values[i]};
      const Point after{b.coordinates[at.x].values[j], b.coordinates[at.y].values[j]};
      const Movement movement = pages_.movement(panel_, before, after, options_.position);
      if (movement == Movement::kNone) continue;
      within |= movement == Movement::kWithin;
      if (movement != Movement::kBeyond) continue;
      moved = true;
      MarkMove move = mark_move(place, a, i, before, after);
      if (!farthest || move.distance > farthest->distance) farthest = std::move(move);
    }
    if (moved)
      note(*std::move(farthest));
    else
      diff_.within += within ? 1 : 0;
    compare_values(a, i, b, j);
    if (i < a.texts.size() && j < b.texts.size())
      change(ChangeKind::kStyle, place, "text", a.texts[i], b.texts[j]);
    if (!moved && a.has_mark_a_point() && b.has_mark_a_point())
      compare_data(place, a.marks[i], b.marks[j]);
  }

  MarkMove mark_move(const std::string& place, const LayerView& layer, std::size_t point,
                     Point before, Point after) const {
    MarkMove move{.place = place,
                  .mark = "",
                  .landmark = "",
                  .point = point,
                  .baseline = before,
                  .current = after,
                  .distance = std::hypot(after.x - before.x, after.y - before.y),
                  .distance_px = pages_.distance_px(panel_, before, after)};
    if (!a_.panels[panel_].equal_aspect && before.x == after.x)
      move.distance = std::abs(after.y - before.y);
    if (layer.has_mark_a_point() || layer.is_whole) {
      const Mark& mark = layer.is_whole ? layer.marks[0] : layer.marks[point];
      move.mark = mark.id;
      move.landmark = data_of(mark, layer.is_whole ? "curve" : "landmark");
    }
    return move;
  }

  void note(MarkMove move) {
    if (varies_) {
      ++diff_.masked;
      return;
    }
    ++diff_.moved;
    diff_.moves.push_back(std::move(move));
    if (diff_.moves.size() > 8 * kMost) trim_moves();
  }

  void trim_moves() {
    std::ranges::stable_sort(diff_.moves, std::ranges::greater(), [](const MarkMove& m) {
      return std::pair(m.distance_px.value_or(0.0), m.distance);
    });
    diff_.moves.resize(kMost);
  }

  /// Coordinates that are no place: half axes, turns, cells.
  void compare_values(const LayerView& a, std::size_t i, const LayerView& b, std::size_t j) {
    if (values_.size() != a.coordinates.size()) values_.assign(a.coordinates.size(), {});
    for (std::size_t c = 0; c < a.coordinates.size(); ++c) {
      if (std::ranges::any_of(a.places, [&](Places at) { return at.x == c || at.y == c; })) continue;
      const double before = a.coordinates[c].values[i], after = b.coordinates[c].values[j];
      if (before == after || (std::isnan(before) && std::isnan(after))) continue;
      if (options_.position.holds(before, after)) {
        ++diff_.within;
        continue;
      }
      if (values_[c].count++ == 0) values_[c].first = {before, after};
    }
  }

  void report_values(const std::string& place, const LayerView& layer) {
    for (std::size_t c = 0; c < values_.size() && c < layer.coordinates.size(); ++c)
      if (values_[c].count > 0)
        change(ChangeKind::kData, place,
               fmt::format("{} of {}", layer.coordinates[c].name,
                           counted(values_[c].count, "point")),
               fmt::format("{}", values_[c].first.x), fmt::format("{}", values_[c].first.y));
    values_.clear();
  }

  void compare_data(const std::string& place, const Mark& a, const Mark& b) {
    change(ChangeKind::kMetadata, place, "id of a mark", a.id, b.id);
    if (a.data == b.data) return;
    for (const auto& [key, value] : a.data) {
      const std::string other(data_of(b, key));
      char* end = nullptr;
      char* other_end = nullptr;
      const double first = std::strtod(value.c_str(), &end);
      const double second = std::strtod(other.c_str(), &other_end);
      const bool numbers = end != value.c_str() && *end == '\0' && other_end != other.c_str() &&
                           *other_end == '\0';
      if (numbers && Tolerance{1e-9, kWritten}.holds(first, second)) continue;
      change(numbers ? ChangeKind::kData : ChangeKind::kStyle, place, "data-" + key, value, other);
    }
    for (const auto& [key, value] : b.data)
      if (std::ranges::none_of(a.data, [&](const auto& item) { return item.first == key; }))
        change(ChangeKind::kMetadata, place, "data-" + key, "", value);
  }

  void add_errors(const LayerView& a, const LayerView& b) {
    if (!a.has_mark_a_point() || !b.has_mark_a_point() || a.kind == "segments") return;
    double first = 0.0, second = 0.0, count = 0.0;
    for (const Match& match : match_points(a, b)) {
      if (!match.baseline || !match.current) continue;
      const std::string before(data_of(a.marks[*match.baseline], "error"));
      const std::string after(data_of(b.marks[*match.current], "error"));
      if (before.empty() || after.empty()) continue;
      first += std::strtod(before.c_str(), nullptr);
      second += std::strtod(after.c_str(), nullptr);
      count += 1.0;
    }
    errors_[0] += first;
    errors_[1] += second;
    errors_[2] += count;
  }

  struct ValueChanges {
    long count = 0;
    Point first;  ///< Before and after.
  };

  const Figure& a_;
  const Figure& b_;
  const bool varies_;
  const FigureOptions& options_;
  const FigurePlaces pages_;
  FigureDiff diff_;
  std::size_t panel_ = 0;
  std::vector<ValueChanges> values_;
  std::array<double, 3> errors_{};  ///< Sums of both sides, and how many.
};

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

FigureDiff figure_diff(const Figure& baseline, const Figure& current,
                       const FigureOptions& options) {
  if (baseline == current) {
    FigureDiff diff;
    diff.equal = true;
    return diff;
  }
  return Comparer(baseline, current, options).run();
}

}  // namespace mapproof
