#include "reports/diff/figures/change_figure.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/text/words.hpp"
#include "render/plot/axis_map.hpp"
#include "render/plot/figure_json.hpp"
#include "reports/diff/figures/figure_layers.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLargestValue = std::size_t{1} << 25;  // Bytes of a figure's value.
constexpr std::size_t kMostPanels = 4;
constexpr std::size_t kMostLabels = 12;
constexpr std::size_t kMostQuantities = 3;
constexpr std::size_t kLongestName = 200;  // Characters.

Range together(const Range& a, const Range& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// Panels of one index of two figures, which can be drawn in one pair of axes.
bool are_alike(const Panel& a, const Panel& b) {
  return a.x.scale == b.x.scale && a.y.scale == b.y.scale;
}

/// Numbers are equal if both are none.
bool same(std::span<const double> a, std::span<const double> b) {
  return std::ranges::equal(
      a, b, [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

/// Whether two layers show the same data, whatever their marks are called.
bool same(const Layer& a, const Layer& b) {
  if (a.index() != b.index()) return false;
  if (const Cells* cells = std::get_if<Cells>(&a))
    return same(cells->values, std::get<Cells>(b).values);
  const LayerView left = view_of(a), right = view_of(b);
  return std::ranges::equal(left.coordinates, right.coordinates,
                            [](const Coordinates& x, const Coordinates& y) {
                              return x.name == y.name && same(x.values, y.values);
                            }) &&
         std::ranges::equal(left.texts, right.texts);
}

/// Without names, which must be unique in a figure.
Layer plain(Layer layer) {
  std::visit(
      [](auto& each) {
        if constexpr (requires { each.marks; }) each.marks.clear();
        if constexpr (requires { each.mark; }) each.mark = {};
      },
      layer);
  return layer;
}

/// Of a layer that differs: "ISOMAP, K = 9, current".
void set_side(Layer& layer, const std::string& side) {
  const std::string& label = label_of(layer);
  set_label(layer, label.empty() ? side : label + ", " + side);
}

Layer in_grey(Layer layer) {
  std::visit(
      [](auto& each) {
        if constexpr (requires { each.colour; }) each.colour = ThemeColour::kMuted;
      },
      layer);
  return layer;
}

/// What is grey itself would pass for the baseline.
Layer out_of_grey(Layer layer) {
  std::visit(
      [](auto& each) {
        if constexpr (requires { each.colour; })
          if (each.colour == ThemeColour::kMuted) each.colour = ThemeColour::kSeries1;
      },
      layer);
  return layer;
}

/// Labels would cover the new positions; an image is not in the figure's value.
bool is_drawn(const Layer& layer) {
  return !std::holds_alternative<PointLabels>(layer) &&
         !std::holds_alternative<ImageLayer>(layer) && !std::holds_alternative<Cells>(layer);
}

/// How far the values of cells moved; empty if they cannot be compared cell by cell.
std::optional<Layer> change_of_cells(const Layer& a, const Layer& b) {
  const Cells *before = std::get_if<Cells>(&a), *after = std::get_if<Cells>(&b);
  if (!before || !after || before->columns != after->columns ||
      before->values.size() != after->values.size())
    return std::nullopt;
  Cells change{.x = after->x, .y = after->y, .columns = after->columns, .values = {}};
  double most = 0.0;
  for (std::size_t i = 0; i < after->values.size(); ++i) {
    const double size = std::abs(after->values[i] - before->values[i]);
    change.values.push_back(size);
    if (std::isfinite(size)) most = std::max(most, size);
  }
  if (most == 0.0) return std::nullopt;
  change.colour_scale = {.limits = {0.0, most}, .bar_label = "size of the change"};
  return change;
}

/// The movements of a panel, and names of the farthest.
void add_moves(Panel& panel, const std::vector<MarkMove>& moves, std::size_t index) {
  Segments lines{.label = "moved", .colour = ThemeColour::kWarning, .arrow = true};
  PointLabels names;
  for (const MarkMove& move : moves) {
    if (move.panel != index || !std::isfinite(move.distance)) continue;
    lines.x0.push_back(move.baseline.x), lines.y0.push_back(move.baseline.y);
    lines.x1.push_back(move.current.x), lines.y1.push_back(move.current.y);
    const bool is_named = std::ranges::find(names.text, move.landmark) != names.text.end();
    if (move.landmark.empty() || is_named || names.text.size() >= kMostLabels) continue;
    names.x.push_back(move.current.x), names.y.push_back(move.current.y);
    names.text.push_back(move.landmark);
  }
  if (lines.x0.empty()) return;
  panel.layers.emplace_back(std::move(lines));
  if (!names.text.empty()) panel.layers.emplace_back(std::move(names));
}

/// A panel of both figures; empty if no layer that is drawn differs.
std::optional<Panel> changed_panel(const Panel& before, const Panel& after, const FigureDiff& diff,
                                   std::size_t index) {
  Panel panel = before;
  panel.layers.clear();
  std::vector<Layer> changed;
  for (std::size_t i = 0; i < after.layers.size(); ++i) {
    const Layer& layer = after.layers[i];
    const bool is_new =
        std::ranges::none_of(before.layers, [&](const Layer& other) { return same(other, layer); });
    if (!is_new) continue;
    if (std::optional<Layer> cells =
            i < before.layers.size() ? change_of_cells(before.layers[i], layer) : std::nullopt) {
      panel.layers.push_back(*std::move(cells));
    } else if (is_drawn(layer)) {
      changed.push_back(out_of_grey(plain(layer)));
      set_side(changed.back(), "current");
    }
  }
  bool any_lost = false;
  for (const Layer& layer : before.layers) {
    if (!is_drawn(layer)) continue;
    const bool is_lost =
        std::ranges::none_of(after.layers, [&](const Layer& other) { return same(other, layer); });
    panel.layers.push_back(in_grey(plain(layer)));
    if (is_lost) set_side(panel.layers.back(), "baseline");
    any_lost = any_lost || is_lost;
  }
  if (changed.empty() && !any_lost && std::ranges::none_of(panel.layers, [](const Layer& layer) {
        return std::holds_alternative<Cells>(layer);
      }))
    return std::nullopt;
  std::ranges::move(changed, std::back_inserter(panel.layers));
  add_moves(panel, diff.moves, index);
  return panel;
}

/// Leaves out the title and the notes of two figures if these differ: a heat map would show both
/// at one place. @return Whether they do.
bool drop_words_that_differ(Figure& a, Figure& b) {
  if (a.title == b.title && a.notes == b.notes) return false;
  for (Figure* figure : {&a, &b}) figure->title.clear(), figure->notes.clear();
  return true;
}

/// Limits that hold what two panels show.
void set_common_limits(Panel& panel, const Panel& other) {
  const PanelLimits a = panel_limits(panel), b = panel_limits(other);
  panel.x.limits = together(a.x, b.x);
  panel.y.limits = together(a.y, b.y);
}

bool can_be_drawn(const Figure& figure) { return problem(figure).empty(); }

/// A panel and what readers call what it shows.
struct NamedPanel {
  SubjectLabel label;
  Panel panel;
};

/// What is drawn of the record in which a landmark moved farthest.
std::optional<NamedPanel> panel_of_points(const std::vector<PointsDiff>& all) {
  const PointsDiff* farthest = nullptr;
  double most = 0.0;
  for (const PointsDiff& points : all)
    for (const PointMove& move : points.moves)
      if (std::isfinite(move.moved) && move.moved > most) most = move.moved, farthest = &points;
  if (!farthest) return std::nullopt;
  Segments lines{.label = "moved", .colour = ThemeColour::kWarning, .arrow = true};
  Scatter before{.label = "baseline", .colour = ThemeColour::kMuted, .filled = false};
  Scatter after{.label = "current", .colour = ThemeColour::kSeries1};
  PointLabels names;
  for (const PointMove& move : farthest->moves) {
    if (!std::isfinite(move.moved)) continue;
    before.x.push_back(move.baseline.x), before.y.push_back(move.baseline.y);
    after.x.push_back(move.current.x), after.y.push_back(move.current.y);
    names.text.push_back(printable(move.name, 40));
  }
  lines.x0 = before.x, lines.y0 = before.y, lines.x1 = after.x, lines.y1 = after.y;
  names.x = after.x, names.y = after.y;
  const bool in_metres = farthest->quantity != "landmark_shape";
  return NamedPanel{farthest->label.empty() ? SubjectLabel{farthest->record} : farthest->label,
                    Panel{.title = "",
                          .x = Axis{.label = in_metres ? "x [m]" : "x"},
                          .y = Axis{.label = in_metres ? "y [m]" : "y"},
                          .equal_aspect = true,
                          .layers = {lines, before, after, names}}};
}

/// The values of one quantity, run by run; empty: there is no pair of numbers.
std::optional<NamedPanel> panel_of(const Comparison& comparison) {
  Scatter runs{.colour = ThemeColour::kSeries1};
  const ScaledUnit unit = shown_unit(comparison);
  for (const Point& pair : comparison.values)
    runs.x.push_back(unit.factor * pair.x), runs.y.push_back(unit.factor * pair.y);
  if (runs.x.empty()) return std::nullopt;
  const auto [low_x, high_x] = std::ranges::minmax(runs.x);
  const auto [low_y, high_y] = std::ranges::minmax(runs.y);
  const double low = std::min(low_x, low_y), high = std::max(high_x, high_y);
  const Polyline equal{.label = "equal",
                       .x = {low, high},
                       .y = {low, high},
                       .colour = ThemeColour::kMuted,
                       .dash = Dash::kDashed};
  const std::string name = label_with_unit(in_unit(comparison.quantity, unit));
  const std::string all = counted(comparison.pairs, "run");
  runs.label = std::cmp_equal(runs.x.size(), comparison.pairs)
                   ? all
                   : fmt::format("{} of {}", runs.x.size(), all);
  return NamedPanel{comparison.label, Panel{.title = "",
                                            .x = Axis{.label = "baseline: " + name},
                                            .y = Axis{.label = "current: " + name},
                                            .layers = {equal, runs}}};
}

/// Whether all panels have the same part there.
bool share_part(const std::vector<NamedPanel>& panels, std::size_t index) {
  const auto has_it = [&](const NamedPanel& one) {
    return index < one.label.size() && one.label[index] == panels.front().label[index];
  };
  return index < panels.front().label.size() && std::ranges::all_of(panels, has_it);
}

/// A figure of these panels: the parts that all their names share stand in its title, the others,
/// which distinguish them, each in a line of the panel's.
Figure with_names(Figure figure, std::vector<NamedPanel> panels) {
  SubjectLabel shared;
  for (std::size_t i = 0; i < panels.front().label.size(); ++i)
    if (share_part(panels, i)) shared.push_back(panels.front().label[i]);
  if (!shared.empty()) figure.title += ": " + printable(label_text(shared), kLongestName);
  for (auto& [label, panel] : panels) {
    for (std::size_t i = 0; i < label.size(); ++i)
      if (!share_part(panels, i))
        panel.title += (panel.title.empty() ? "" : "\n") + printable(label[i], kLongestName);
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace

std::optional<FigureValues> figure_values(const DiffItem& item) {
  const auto is_figure = [](const std::filesystem::path& file) {
    return file.filename().string().ends_with(".figure.json");
  };
  if (!item.figure || !is_figure(item.baseline_figure) || !is_figure(item.current_figure))
    return std::nullopt;
  const auto read = [](const std::filesystem::path& file) {
    return figure_from_json(read_input(file, kLargestValue), file.string());
  };
  return FigureValues{read(item.baseline_figure), read(item.current_figure)};
}

std::optional<std::pair<Figure, Figure>> on_common_axes(const FigureValues& values) {
  const auto& [baseline, current] = values;
  if (!can_be_drawn(baseline) || !can_be_drawn(current) ||
      baseline.panels.size() != current.panels.size())
    return std::nullopt;
  std::pair<Figure, Figure> both{baseline, current};
  bool any_shift = false;
  for (std::size_t p = 0; p < baseline.panels.size(); ++p) {
    const Panel &a = baseline.panels[p], &b = current.panels[p];
    if (!are_alike(a, b)) return std::nullopt;
    const PanelLimits was = panel_limits(a), is = panel_limits(b);
    any_shift = any_shift || was.x != is.x || was.y != is.y;
    set_common_limits(both.first.panels[p], b);
    both.second.panels[p].x.limits = both.first.panels[p].x.limits;
    both.second.panels[p].y.limits = both.first.panels[p].y.limits;
  }
  const bool has_other_words = drop_words_that_differ(both.first, both.second);
  if (!(any_shift || has_other_words) || !can_be_drawn(both.first) || !can_be_drawn(both.second))
    return std::nullopt;
  return both;
}

std::optional<Figure> change_figure(const FigureValues& values, const FigureDiff& diff) {
  const auto& [baseline, current] = values;
  if (!can_be_drawn(baseline) || !can_be_drawn(current)) return std::nullopt;
  std::vector<std::pair<long, Panel>> panels;  // With the number of listed movements.
  const std::size_t count = std::min(baseline.panels.size(), current.panels.size());
  for (std::size_t p = 0; p < count; ++p) {
    const Panel &before = baseline.panels[p], &after = current.panels[p];
    if (!are_alike(before, after)) continue;
    std::optional<Panel> panel = changed_panel(before, after, diff, p);
    if (!panel) continue;
    const PanelLimits a = panel_limits(before), b = panel_limits(after);
    panel->x.limits = together(a.x, b.x), panel->y.limits = together(a.y, b.y);
    panels.emplace_back(std::ranges::count(diff.moves, p, &MarkMove::panel), *std::move(panel));
  }
  std::ranges::stable_sort(panels, std::greater(), &std::pair<long, Panel>::first);
  if (panels.size() > kMostPanels) panels.resize(kMostPanels);
  if (panels.empty()) return std::nullopt;
  Figure figure;
  figure.id = "change";
  figure.title = "What changed: grey is the baseline";
  for (auto& [moves, panel] : panels) figure.panels.push_back(std::move(panel));
  return can_be_drawn(figure) ? std::optional(std::move(figure)) : std::nullopt;
}

std::optional<Figure> change_figure(const RecordDiff& diff) {
  Figure figure;
  figure.id = "change";
  figure.title = "What changed in the records";
  std::vector<NamedPanel> panels;
  if (std::optional<NamedPanel> panel = panel_of_points(diff.points))
    panels.push_back(*std::move(panel));
  std::vector<const Comparison*> severe;
  for (const Comparison& comparison : diff.comparisons)
    if (comparison.beyond > 0) severe.push_back(&comparison);
  std::ranges::stable_sort(
      severe, [](const Comparison* a, const Comparison* b) { return shows_more(*a, *b); });
  for (const Comparison* comparison : severe) {
    if (panels.size() > kMostQuantities) break;
    if (std::optional<NamedPanel> panel = panel_of(*comparison))
      panels.push_back(*std::move(panel));
  }
  if (panels.empty()) return std::nullopt;
  figure = with_names(std::move(figure), std::move(panels));
  return can_be_drawn(figure) ? std::optional(std::move(figure)) : std::nullopt;
}

std::optional<Figure> change_figure(const DiffItem& item,
                                    const std::optional<FigureValues>& values) {
  if (values && item.figure) return change_figure(*values, *item.figure);
  return item.records ? change_figure(*item.records) : std::nullopt;
}

}  // namespace mapproof
