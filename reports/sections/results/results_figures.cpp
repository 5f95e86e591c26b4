#include "reports/sections/results/results_figures.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/slug.hpp"
#include "render/figures/diagrams/heat_map.hpp"
#include "render/figures/diagrams/method_comparison.hpp"
#include "reports/sections/results/paired_methods.hpp"
#include "reports/sections/results/results_conventions.hpp"
#include "reports/sections/results/results_curves.hpp"
#include "reports/sections/results/results_data_sets.hpp"
#include "reports/sections/results/results_distributions.hpp"

namespace mapproof {
namespace {

/// More cells than these have no names that a reader could follow.
constexpr std::size_t kMostLevels = 40;

/// A setup's conditions by two factors.
struct Grid {
  std::string x, y;                         ///< Factors.
  std::vector<double> x_levels, y_levels;   ///< Ascending.
  std::vector<const ResultsBlock*> blocks;  ///< Each along `x`, at one level of `y`.
};

/// The numbers that a factor has, ascending; empty if one of its levels is a text.
std::vector<double> numbers_of(const std::vector<const ResultsBlock*>& blocks,
                               const std::string& factor) {
  std::set<double> numbers;
  for (const ResultsBlock* block : blocks)
    for (const Condition& at : block->conditions)
      for (const Level& level : at.levels) {
        if (level.factor != factor) continue;
        const auto* number = std::get_if<double>(&level.value);
        if (number == nullptr) return {};
        numbers.insert(*number);
      }
  return {numbers.begin(), numbers.end()};
}

std::optional<Grid> grid_of(const ResultsView& view, const Label& setup) {
  Grid grid;
  for (const ResultsBlock& block : view.blocks()) {
    if (block.conditions.front().setup != setup.id) continue;
    if (!block.has_axis() || block.conditions.front().levels.size() != 2) return std::nullopt;
    grid.blocks.push_back(&block);
  }
  if (grid.blocks.size() < 2) return std::nullopt;
  grid.x = grid.blocks.front()->factor;
  for (const Level& level : grid.blocks.front()->conditions.front().levels)
    if (level.factor != grid.x) grid.y = level.factor;
  for (const ResultsBlock* block : grid.blocks)
    for (const Level& level : block->conditions.front().levels)
      if (level.factor != grid.x && level.factor != grid.y) return std::nullopt;
  grid.x_levels = numbers_of(grid.blocks, grid.x);
  grid.y_levels = numbers_of(grid.blocks, grid.y);
  if (grid.x_levels.size() < 2 || grid.y_levels.size() < 2 ||
      std::max(grid.x_levels.size(), grid.y_levels.size()) > kMostLevels)
    return std::nullopt;
  return grid;
}

std::vector<std::string> names_of(const std::vector<double>& levels) {
  std::vector<std::string> names;
  for (const double level : levels) names.push_back(fmt::format("{:.6g}", level));
  return names;
}

/// One per combination, row by row; NaN where there is none.
std::vector<double> means_over(const ResultsView& view, const Grid& grid, const std::string& setup,
                               const ResultsLine& line, const Quantity& quantity) {
  std::vector<double> means;
  for (const double y : grid.y_levels)
    for (const double x : grid.x_levels) {
      const auto mean = view.mean(condition(setup, {{grid.x, x}, {grid.y, y}}), line, quantity);
      means.push_back(mean ? mean->mean : kNaN);
    }
  return means;
}

/// A method of a setup, whichever of its blocks has it.
std::vector<ResultsLine> lines_in(const ResultsView& view, const Grid& grid,
                                  const Quantity& quantity) {
  std::vector<ResultsLine> lines;
  for (const ResultsBlock* block : grid.blocks)
    for (const ResultsLine& line : view.lines(*block, quantity))
      if (std::ranges::find(lines, line.method, &ResultsLine::method) == lines.end())
        lines.push_back(line);
  std::ranges::sort(lines, {}, &ResultsLine::index);
  return lines;
}

/// From the least to the greatest; nothing where none is known.
/// @param most  Values above it are those of maps that diverged.
std::optional<Range> span_of_known(std::vector<double> values, double most) {
  std::erase_if(values, [&](double value) { return !is_known(value) || value > most; });
  if (values.empty()) return std::nullopt;
  const auto [least, greatest] = std::ranges::minmax(values);
  return Range{least, greatest};
}

/// Nothing of too few groups of runs for tests, where no two mean ranks can differ by the critical
/// difference, and of distances from one of the methods itself.
std::optional<Figure> rank_figure(const ResultsView& view, const MethodComparison& comparison) {
  if (!has_rank_diagram(comparison) || is_distance_from_another(*comparison.quantity))
    return std::nullopt;
  if (critical_difference(comparison) > static_cast<double>(comparison.methods.size()) - 1.0)
    return std::nullopt;
  CriticalDifferenceSpec spec;
  spec.alpha = kSignificanceOfMethods;
  spec.id = id_below(comparison.id, "ranks-" + comparison.quantity->id);
  for (std::size_t i = 0; i < comparison.methods.size(); ++i)
    spec.methods.push_back({view.study().methods[comparison.methods[i].method].label,
                            comparison.ranks->mean_ranks[i]});
  spec.critical_difference = critical_difference(comparison);
  spec.units = comparison.ranks->units;
  spec.unit = "group";
  spec.friedman_p = comparison.ranks->chi_square_p;
  spec.title =
      fmt::format("{}{}{}: {}", comparison.block->title, comparison.level.empty() ? "" : ", ",
                  comparison.level, ranking_title(spec, in_sentence(comparison.quantity->label)));
  spec.record_ids = {record_of(*comparison.block)};
  Figure figure = critical_difference_figure(spec);
  if (const std::string note = disagreement_of(comparison, view); !note.empty())
    figure.caption += " " + note;
  return figure;
}

/// Ids leave out what file names must not hold, so that two may become one.
void make_ids_unique(StudyFigures& figures) {
  std::set<std::string> ids;
  for (FigureGroup& group : figures.groups)
    for (Figure& figure : group.figures) {
      const std::string id = figure.id;
      for (int i = 2; !ids.insert(figure.id).second; ++i) figure.id = fmt::format("{}-{}", id, i);
    }
}

}  // namespace

std::string heat_maps_id(const ResultsView& view, const std::string& setup) {
  return fmt::format("{}-{}-grid", view.study().name, view.setup_slug(setup));
}

FigureGroup heat_maps(const ResultsView& view, const Label& setup) {
  const std::string id = heat_maps_id(view, setup.id);
  FigureGroup group{id, setup.label.empty() ? "Heat maps" : setup.label + ": heat maps", "", {}};
  if (!view.study().results.are_repeats) return group;
  const std::optional<Grid> grid = grid_of(view, setup);
  if (!grid) return group;
  for (const std::string& known : view.study().quantities) {
    const Quantity& quantity = view.quantity(known);
    const std::vector<ResultsLine> lines = lines_in(view, *grid, quantity);
    const bool great_errors = view.has_great_errors(quantity);
    std::vector<std::vector<double>> means;
    std::vector<double> all;
    for (const ResultsLine& line : lines) {
      means.push_back(means_over(view, *grid, setup.id, line, quantity));
      all.insert(all.end(), means.back().begin(), means.back().end());
    }
    std::optional<Range> span;
    if (lines.size() > 1)
      span = span_of_known(std::move(all), great_errors ? kGreatestError_m : kInfinity);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const ResultsLine& line = lines[i];
      HeatMapSpec spec;
      spec.id = id_below(id, slug_of(quantity.id) + "-" + slug_of(line.method));
      spec.x_label = view.factor_label(grid->x);
      spec.y_label = view.factor_label(grid->y);
      spec.x_names = names_of(grid->x_levels);
      spec.y_names = names_of(grid->y_levels);
      spec.values = std::move(means[i]);
      spec.great_errors = great_errors;
      spec.shared_span = span;
      spec.decimals = view.decimals(quantity);
      spec.quantity = quantity.label;
      spec.unit = quantity.unit;
      spec.missing = "no run gave a value";
      spec.record_ids = {setup.id};
      if (std::ranges::none_of(spec.values, is_known)) continue;
      spec.title = fmt::format("{}, {}: {}", setup.label, line.label,
                               heat_map_finding(spec, in_sentence(quantity.label)));
      group.figures.push_back(heat_map_figure(spec));
    }
  }
  return group;
}

std::string why_no_figure(const ResultsView& view, const ResultsBlock& block,
                          const Quantity& quantity) {
  if (block.has_axis()) return why_no_curve(view, block, quantity);
  return view.study().results.are_repeats ? why_no_distribution(view, block, quantity) : "";
}

std::vector<std::string> figures_of_quantity(const ResultsView& view, const std::string& quantity) {
  std::vector<std::string> ids;
  for (const ResultsOverview& overview : view.overviews())
    ids.push_back(id_below(overview.id, quantity));
  for (const ResultsBlock& block : view.blocks()) {
    ids.push_back(data_sets_figure_id(block, view.quantity(quantity)));
    ids.push_back(id_below(block.id, quantity));
  }
  return ids;
}

StudyFigures results_figures(const ResultsView& view,
                             const std::vector<MethodComparison>& comparisons) {
  StudyFigures figures;
  for (const ResultsOverview& overview : view.overviews()) {
    FigureGroup group{overview.id, overview.title, "", {}};
    for (const std::string& id : view.study().quantities)
      if (auto figure = overview_figure(view, overview, view.study().results.quantities.at(id)))
        group.figures.push_back(*std::move(figure));
    if (!group.empty()) figures.groups.push_back(std::move(group));
  }
  for (const Label& setup : view.study().setups)
    if (FigureGroup grid = heat_maps(view, setup); !grid.empty())
      figures.groups.push_back(std::move(grid));
  for (const ResultsBlock& block : view.blocks()) {
    FigureGroup group{block.id, block.title, "", {}};
    if (auto figure = data_sets_figure(view, block)) group.figures.push_back(*std::move(figure));
    for (const Quantity* quantity : view.quantities(block)) {
      auto figure = block.has_axis() ? curve_figure(view, block, *quantity)
                                     : distribution_figure(view, block, *quantity);
      if (figure) group.figures.push_back(*std::move(figure));
    }
    for (const MethodComparison& comparison : comparisons)
      if (comparison.block == &block)
        if (auto figure = rank_figure(view, comparison))
          group.figures.push_back(*std::move(figure));
    if (!group.empty()) figures.groups.push_back(std::move(group));
  }
  make_ids_unique(figures);
  return figures;
}

}  // namespace mapproof
