#include "render/style/edits.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "render/base/geometry.hpp"

namespace mapproof {
namespace {

std::string_view value_of(const Mark& mark, std::string_view key) {
  const auto found = std::ranges::find(mark.data, key, &std::pair<std::string, std::string>::first);
  return found == mark.data.end() ? std::string_view() : std::string_view(found->second);
}

/// A landmark's mark in a panel, and where it is.
struct MarkedPoint {
  std::string landmark;
  Point at;
  bool is_true = false;
};

void add_points(const Layer& layer, std::vector<MarkedPoint>& points) {
  const auto add = [&](const auto& shapes) {
    for (std::size_t i = 0; i < shapes.marks.size(); ++i) {
      const std::string_view landmark = value_of(shapes.marks[i], "landmark");
      const std::string_view kind = value_of(shapes.marks[i], "kind");
      if (landmark.empty()) continue;
      points.push_back({std::string(landmark),
                        {shapes.x[i], shapes.y[i]},
                        kind == "true" || kind == "anchor" || kind == "landmark"});
    }
  };
  if (const auto* scatter = std::get_if<Scatter>(&layer)) add(*scatter);
  if (const auto* ellipses = std::get_if<Ellipses>(&layer)) add(*ellipses);
}

std::vector<MarkedPoint> points_of(const Panel& panel) {
  std::vector<MarkedPoint> points;
  for (const Layer& layer : panel.layers) add_points(layer, points);
  return points;
}

/// Calls `drop` on the marks of a layer from the last to the first; erases those for which it is
/// true.
template <typename Shapes, typename... Columns>
void erase_marks(Shapes& shapes, const std::set<std::string>& kept, Columns... columns) {
  for (std::size_t i = shapes.marks.size(); i-- > 0;) {
    const std::string_view landmark = value_of(shapes.marks[i], "landmark");
    if (landmark.empty() || kept.contains(std::string(landmark))) continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    ((shapes.*columns).erase((shapes.*columns).begin() + at), ...);
    shapes.marks.erase(shapes.marks.begin() + at);
  }
}

bool are_alike(const Axis& a, const Axis& b) {
  return a.label == b.label && a.scale == b.scale && a.names == b.names;
}

/// Adds the panels of one more figure; its first line of notes stands under its title, its warnings
/// on top of the whole.
void add_figure(const Figure& figure, const std::string& title, Figure& whole) {
  std::string head = title;
  for (const Note& note : figure.notes) {
    if (note.colour == ThemeColour::kText && head == title)
      head += "\n" + note.text;
    else
      whole.notes.push_back({title + ": " + note.text, note.colour});
  }
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    Panel panel = figure.panels[p];
    const std::string below = panel.title.empty() ? "" : "\n" + panel.title;
    panel.title = (p == 0 ? head : "") + (p == 0 ? below : panel.title);
    prefix_mark_ids(panel, fmt::format("p{}-", whole.panels.size() + 1));
    whole.panels.push_back(std::move(panel));
  }
  whole.record_ids.insert(whole.record_ids.end(), figure.record_ids.begin(),
                          figure.record_ids.end());
  whole.varies |= figure.varies;
  const auto add_words = [&title](const std::string& text, std::string& all) {
    if (!text.empty()) all += (all.empty() ? "" : " ") + title + ": " + text;
  };
  add_words(figure.caption, whole.caption);
  add_words(figure.alt, whole.alt);
}

/// Those whose text is not kept.
void erase_labels(PointLabels& labels, const std::set<std::string>& kept) {
  for (std::size_t i = labels.text.size(); i-- > 0;) {
    if (kept.contains(labels.text[i])) continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    labels.x.erase(labels.x.begin() + at);
    labels.y.erase(labels.y.begin() + at);
    labels.text.erase(labels.text.begin() + at);
  }
}

}  // namespace

std::vector<std::string> landmarks_of(const Figure& figure) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const Panel& panel : figure.panels)
    for (const MarkedPoint& point : points_of(panel))
      if (seen.insert(point.landmark).second) names.push_back(point.landmark);
  return names;
}

void name_landmarks(Figure& figure, const std::vector<std::string>& names) {
  const std::set<std::string> wanted(names.begin(), names.end());
  for (Panel& panel : figure.panels) {
    const std::vector<MarkedPoint> points = points_of(panel);
    if (points.empty()) continue;
    std::erase_if(panel.layers,
                  [](const Layer& layer) { return std::holds_alternative<PointLabels>(layer); });
    PointLabels labels;
    std::map<std::string, std::size_t> chosen;  // Landmark to the place in `points`.
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto [position, is_new] = chosen.emplace(points[i].landmark, i);
      if (!is_new && points[i].is_true && !points[position->second].is_true) position->second = i;
    }
    for (const auto& [landmark, i] : chosen) {
      if (!wanted.contains(landmark)) continue;
      labels.x.push_back(points[i].at.x);
      labels.y.push_back(points[i].at.y);
      labels.text.push_back(landmark);
    }
    if (!labels.x.empty()) panel.layers.emplace_back(std::move(labels));
  }
}

void show_landmarks(Figure& figure, const std::vector<std::string>& names) {
  const std::set<std::string> kept(names.begin(), names.end());
  for (Panel& panel : figure.panels) {
    for (Layer& layer : panel.layers) {
      if (auto* points = std::get_if<Scatter>(&layer))
        erase_marks(*points, kept, &Scatter::x, &Scatter::y);
      if (auto* lines = std::get_if<Segments>(&layer))
        erase_marks(*lines, kept, &Segments::x0, &Segments::y0, &Segments::x1, &Segments::y1);
      if (auto* shapes = std::get_if<Ellipses>(&layer))
        erase_marks(*shapes, kept, &Ellipses::x, &Ellipses::y, &Ellipses::a, &Ellipses::b,
                    &Ellipses::rotation_rad);
      if (auto* labels = std::get_if<PointLabels>(&layer)) erase_labels(*labels, kept);
    }
    std::erase_if(panel.layers, is_empty);
  }
}

Figure joined_figure(const std::string& id, const std::vector<Figure>& figures,
                     const std::vector<std::string>& titles) {
  if (figures.size() < 2) throw InvalidInput("several panels need two figures");
  Figure whole;
  whole.id = id;
  std::vector<std::string> heads;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    heads.push_back(i < titles.size() && !titles[i].empty() ? titles[i] : figures[i].title);
    add_figure(figures[i], heads.back(), whole);
  }
  whole.title = listed(heads, 3);
  const Panel& first = whole.panels.front();
  const auto all = [&](auto holds) { return std::ranges::all_of(whole.panels, holds); };
  const bool one_aspect =
      all([&](const Panel& panel) { return panel.equal_aspect == first.equal_aspect; });
  const bool drawn = all([](const Panel& panel) { return !panel.bare; });
  whole.shared_x =
      one_aspect && drawn && all([&](const Panel& panel) { return are_alike(panel.x, first.x); });
  whole.shared_y =
      one_aspect && drawn && all([&](const Panel& panel) { return are_alike(panel.y, first.y); });
  whole.columns = 4;
  require_valid(whole);
  return whole;
}

}  // namespace mapproof
