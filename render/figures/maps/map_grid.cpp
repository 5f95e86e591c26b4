#include "render/figures/maps/map_grid.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/maps/map.hpp"
#include "render/figures/score_text.hpp"
#include "render/plot/axis_map.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostFrames = 10;
constexpr double kSmall = 0.65;  // Size of marks in a strip.

void require_consistent(const MapGridSpec& spec) {
  const auto refuse = [&spec](const std::string& what) {
    throw InvalidInput("figure " + printable(spec.id) + ": " + what);
  };
  if (spec.maps.empty()) refuse("no map");
  if (spec.framing == 0) refuse("no map that its limits are of");
  for (const TitledMap& one : spec.maps)
    if (one.map.frame != spec.maps.front().map.frame) refuse("maps in different frames");
}

/// The first and the last, and others evenly between them.
std::vector<const TitledMap*> thinned(const std::vector<TitledMap>& maps) {
  std::vector<const TitledMap*> chosen;
  const std::size_t count = std::min(maps.size(), kMostFrames);
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(&maps[count == 1 ? 0 : i * (maps.size() - 1) / (count - 1)]);
  return chosen;
}

std::vector<const TitledMap*> all_of(const std::vector<TitledMap>& maps) {
  std::vector<const TitledMap*> all;
  for (const TitledMap& one : maps) all.push_back(&one);
  return all;
}

/// The score, or the first error alone.
std::string scored(const TitledMap& one, bool whole) {
  const std::string words = one.map.score ? score_text(*one.map.score) : "";
  if (words.empty()) return "no score";
  return whole ? words : words.substr(0, words.find(','));
}

/// The same, an error a line.
std::string in_lines(std::string words) {
  for (std::size_t at = 0; (at = words.find(", ", at)) != std::string::npos;)
    words.replace(at, 2, "\n");
  return words;
}

std::string in_one_line(std::string title) {
  if (const std::size_t end = title.find('\n'); end != std::string::npos)
    title.replace(end, 1, ", ");
  return title;
}

/// For a panel of a strip: no names, small marks.
void make_small(Panel& panel) {
  std::erase_if(panel.layers,
                [](const Layer& layer) { return std::holds_alternative<PointLabels>(layer); });
  for (Layer& layer : panel.layers)
    if (auto* points = std::get_if<Scatter>(&layer)) points->size *= kSmall;
}

Panel grid_panel(const std::vector<const TitledMap*>& maps, std::size_t i,
                 const std::optional<PanelBox>& limits = std::nullopt) {
  return map_panel(maps[i]->map, fmt::format("map-{}-", i + 1), limits);
}

/// Common limits of all panels: those that the first panels need, but for those with estimates far
/// off. Unset if these are all, and no estimate is outside.
std::optional<PanelBox> limits_of(const std::vector<Panel>& first, std::size_t all) {
  std::vector<PanelBox> whole, cut;
  for (const Panel& panel : first) {
    const auto [x, y] = panel_limits(panel);
    (panel.x.limits ? cut : whole).push_back({x, y});
  }
  if (whole.size() == all) return std::nullopt;
  const std::vector<PanelBox>& framing = whole.empty() ? cut : whole;
  PanelBox limits = framing.front();
  for (const auto& [x, y] : framing)
    limits = {{std::min(limits.x.low, x.low), std::max(limits.x.high, x.high)},
              {std::min(limits.y.low, y.low), std::max(limits.y.high, y.high)}};
  return limits;
}

/// The panels of all maps with their common limits. Each is drawn once, and once more only if it
/// needs other limits than its own.
std::vector<Panel> grid_panels(const MapGridSpec& spec, const std::vector<const TitledMap*>& maps) {
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < std::min(maps.size(), spec.framing); ++i)
    panels.push_back(grid_panel(maps, i));
  const std::optional<PanelBox> limits = limits_of(panels, maps.size());
  if (!limits) return panels;
  panels.clear();
  for (std::size_t i = 0; i < maps.size(); ++i) panels.push_back(grid_panel(maps, i, limits));
  return panels;
}

Figure grid_of(const MapGridSpec& spec, const std::vector<const TitledMap*>& maps, bool named) {
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.shared_x = figure.shared_y = true;
  figure.panels = grid_panels(spec, maps);
  std::vector<std::string> without_position;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const MapRecord& record = maps[i]->map;
    Panel& panel = figure.panels[i];
    panel.title = maps[i]->title + "\n" + in_lines(scored(*maps[i], named));
    if (!named) make_small(panel);
    figure.record_ids.push_back(record.id);
    figure.alt += (i == 0 ? "" : "; ") + in_one_line(maps[i]->title) + " " + scored(*maps[i], true);
    if (record.estimate.array().isNaN().any())
      without_position.push_back(in_one_line(maps[i]->title));
  }
  figure.alt = fmt::format("{}: {}.", counted(maps.size(), "map"), figure.alt);
  figure.caption = spec.title + ". ";
  figure.caption += maps.front()->map.frame == Frame::kGroundTruth
                        ? marks_text(figure.panels)
                        : "Translation, rotation, scale and reflection are arbitrary.";
  if (!without_position.empty()) {
    const std::string text =
        "Landmarks without a position are left out of: " + listed(without_position, 4) + ".";
    figure.caption += " " + text;
    figure.notes.push_back({text, ThemeColour::kWarning});
  }
  require_valid(figure);
  return figure;
}

}  // namespace

Figure film_strip_figure(const MapGridSpec& spec) {
  require_consistent(spec);
  Figure figure = grid_of(spec, thinned(spec.maps), false);
  figure.columns = 5;
  return figure;
}

Figure map_pair_figure(const MapGridSpec& spec) {
  require_consistent(spec);
  return grid_of(spec, all_of(spec.maps), true);
}

Figure map_wall_figure(const MapGridSpec& spec) {
  require_consistent(spec);
  Figure figure = grid_of(spec, all_of(spec.maps), false);
  figure.columns = 4;
  return figure;
}

}  // namespace mapproof
