#include "reports/sections/study_figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "core/base/text/words.hpp"
#include "reports/sections/figures/figure_builders.hpp"
#include "reports/sections/variation_summary.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

void append(std::vector<Figure>& all, std::vector<Figure> more) {
  for (Figure& figure : more) all.push_back(std::move(figure));
}

/// The paper's figures carry their numbers.
void number(std::vector<Figure>& figures) {
  for (Figure& figure : figures)
    if (const std::string words = paper_number(figure.id); !words.empty())
      figure.title = fmt::format("{}. {}", words, figure.title);
}

constexpr std::size_t kManyPanels = 5;

/// How the ids of film strips begin (docs/figures.md).
constexpr std::string_view kForming = "forming-";

/// What the marks of a panel show, as a number. Whatever its axes, its styles and its units are,
/// equal curves, points, cells and ellipses give the same.
class ShownMarks {
 public:
  void operator()(const Polyline& line) {
    if (!line.mark.id.empty()) see(line.label, line.x, line.y);
  }
  void operator()(const Scatter& points) {
    if (!points.marks.empty()) see(points.label, points.x, points.y);
  }
  void operator()(const Cells& cells) { see(cells.label, {}, cells.values); }
  void operator()(const Ellipses& ellipses) { see(ellipses.label, ellipses.a, ellipses.b); }
  void operator()(const auto& /*lines and words beside them*/) {}

  /// 0 without marks.
  std::uint64_t number() const {
    if (x_.empty() && y_.empty()) return 0;
    std::string shown = labels_;
    for (const std::vector<double>* values : {&x_, &y_}) append_parts(*values, shown);
    return std::hash<std::string>()(shown);
  }

 private:
  void see(const std::string& label, const std::vector<double>& x, const std::vector<double>& y) {
    labels_ += label + '\n';
    x_.insert(x_.end(), x.begin(), x.end());
    y_.insert(y_.end(), y.begin(), y.end());
  }

  /// As parts of the greatest, which no change of unit moves but by a rounding error.
  static void append_parts(const std::vector<double>& values, std::string& shown) {
    constexpr double kParts = 1e5;
    double greatest = 0.0;
    for (const double value : values)
      if (std::isfinite(value)) greatest = std::max(greatest, std::abs(value));
    if (greatest == 0.0) greatest = 1.0;
    for (const double value : values)
      shown += std::isfinite(value)
                   ? std::to_string(std::llround(kParts * (value / greatest))) + ','
                   : "-,";
    shown += '\n';
  }

  std::string labels_;
  std::vector<double> x_, y_;
};

std::uint64_t number_of_marks(const Panel& panel) {
  ShownMarks marks;
  for (const Layer& layer : panel.layers) std::visit(marks, layer);
  return marks.number();
}

FigureGroup scene_group(FigureSource& source) {
  FigureGroup group{
      "scenes",
      "In space",
      "What a scan takes in; the room with the map of least mean MPE, the median run; where its "
      "landmarks lie in the space of their observations; and how the map forms. Drawn by VTK "
      "without a screen.",
      {},
      study_scenes(source),
      {},
      2,
      Interest::kMost};
  if (!group.scenes.empty()) group.films = study_films(source);
  return group;
}

bool any_begins(const std::vector<Figure>& figures, std::string_view start) {
  return std::ranges::any_of(figures,
                             [&](const Figure& figure) { return figure.id.starts_with(start); });
}

/// What the figures of maps show behind those of all methods.
std::string folded_maps(const std::vector<Figure>& figures) {
  std::vector<std::string> kinds;
  if (any_begins(figures, "errors-")) kinds.emplace_back("errors over the floor");
  if (any_begins(figures, "fig-")) kinds.emplace_back("maps as the paper shows them");
  if (any_begins(figures, "map-")) kinds.emplace_back("each method on its median run");
  return listed(kinds, kinds.size());
}

}  // namespace

StudyFigures study_figures(const Study& study, std::span<const Timing> timings,
                           const StudyReader& read) {
  FigureSource source(study, read);
  std::vector<Figure> scans = idea_figures(source);
  append(scans, measurement_figures(source));

  StudyFigures figures;
  const auto add = [&](const char* id, const char* title, const std::string& words,
                       std::vector<Figure> group, std::size_t open = kFiguresOpen,
                       Interest interest = Interest::kSome) {
    number(group);
    if (!group.empty())
      figures.groups.push_back({.id = id,
                                .title = title,
                                .words = words,
                                .figures = std::move(group),
                                .open = open,
                                .interest = interest});
  };
  add("observations", "From observations to a map",
      "Drawn from actual runs: no pose of the robot enters a map.", std::move(scans), 2);
  add("curves", "Error over observations",
      "Mean over runs; bands and bars are 95 % intervals of the mean, layouts being the units. "
      "Each method has its best parameter at the last checkpoint.",
      curve_figures(source));
  std::vector<Figure> maps = map_figures(source);
  const auto compared = static_cast<std::size_t>(std::ranges::count_if(
      maps, [](const Figure& figure) { return figure.id.starts_with("maps-"); }));
  add("maps", "Maps",
      fmt::format(
          "All methods on one run, the best first, with the same axes; a landmark that is chosen "
          "in "
          "one map is highlighted in all. {}The last figures show each method on its own median "
          "run: neither its best map nor its worst.",
          any_begins(maps, "fig-") ? "Where the paper shows a map, the run whose MPE is nearest to "
                                     "it is shown with the median run. "
                                   : ""),
      std::move(maps), compared, Interest::kMost);
  if (!figures.groups.empty() && figures.groups.back().id == "maps")
    figures.groups.back().folded = folded_maps(figures.groups.back().figures);
  std::vector<Figure> forming = forming_figures(source);
  const bool scatters = any_begins(forming, "scatter-");
  add("forming", scatters ? "How maps form and scatter" : "How maps form",
      scatters
          ? "The method of least mean MPE of each sensor: the median run over its checkpoints, "
            "and the scatter over the runs of that layout."
          : "The method of least mean MPE of each sensor: the median run over its checkpoints.",
      std::move(forming));
  if (FigureGroup scenes = scene_group(source); !scenes.scenes.empty())
    figures.groups.push_back(std::move(scenes));
  add("parameters", "Error over parameters",
      "At the last checkpoint; bands and bars are 95 % intervals of the mean.",
      parameter_figures(source), 0, Interest::kFew);
  add("comparison", "Methods side by side",
      "Each at its best parameter. Ranks are over layouts, since runs in one layout are not "
      "independent; distances and eigenvalues are of the median run of the best method.",
      comparison_figures(source), 3, Interest::kFew);
  add("conditions", "Error over conditions",
      "What happens if one thing is changed: methods with the parameters that the experiment "
      "names. "
      "The levels of one figure share their random numbers.",
      condition_figures(source), 0, Interest::kFew);
  add("cost", "Accuracy against seconds",
      "Seconds of one map beyond what the methods of a history share: distances, the order of "
      "neighbours, and the map that a method starts from. They differ from one start of the "
      "program to the next.",
      cost_figures(source, timings), kFiguresOpen, Interest::kFew);
  return figures;
}

std::vector<const Figure*> all_figures(const StudyFigures& figures) {
  std::vector<const Figure*> all;
  for (const FigureGroup& group : figures.groups)
    for (const Figure& figure : group.figures) all.push_back(&figure);
  return all;
}

std::vector<const Scene*> all_scenes(const StudyFigures& figures) {
  std::vector<const Scene*> all;
  for (const FigureGroup& group : figures.groups)
    for (const Scene& scene : group.scenes) all.push_back(&scene);
  return all;
}

std::vector<const Film*> all_films(const StudyFigures& figures) {
  std::vector<const Film*> all;
  for (const FigureGroup& group : figures.groups)
    for (const Film& film : group.films) all.push_back(&film);
  return all;
}

FigureBlock figure_block(const Figure& figure) {
  FigureBlock block{figure.id, figure.title, figure.caption, figure.alt, figure.record_ids};
  block.wide = figure.panels.size() >= kManyPanels;
  block.tall = figure.panels.size() > 1 && figure.columns == 1;
  block.is_map = !figure.panels.empty() && figure.panels.front().equal_aspect;
  for (const Panel& panel : figure.panels) block.shows.push_back(number_of_marks(panel));
  if (!figure.id.starts_with(kForming)) return block;
  for (const Panel& panel : figure.panels) block.steps.push_back(panel.title);
  return block;
}

FigureBlock figure_block(const Scene& scene) {
  return {scene.id, scene.title, scene.caption, scene.alt, scene.record_ids, "scene"};
}

Gallery gallery_of(const FigureGroup& group, std::size_t first) {
  Gallery gallery;
  for (const Figure& figure : group.figures) gallery.figures.push_back(figure_block(figure));
  for (const Scene& scene : group.scenes) gallery.figures.push_back(figure_block(scene));
  gallery.figures.erase(gallery.figures.begin(),
                        gallery.figures.begin() + static_cast<std::ptrdiff_t>(first));
  gallery.open = group.open - std::min(group.open, first);
  gallery.folded = group.folded;
  return gallery;
}

}  // namespace mapproof
