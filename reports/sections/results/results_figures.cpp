#include "reports/sections/results/results_figures.hpp"

#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "render/figures/diagrams/method_comparison.hpp"
#include "reports/sections/method_ranks.hpp"
#include "reports/sections/results/results_curves.hpp"
#include "reports/sections/results/results_data_sets.hpp"
#include "reports/sections/results/results_distributions.hpp"
#include "reports/sections/results/results_grids.hpp"
#include "reports/sections/results/results_parts.hpp"

namespace mapproof {
namespace {

/// Nothing where no two mean ranks can differ by the critical difference, as over few groups of
/// runs, and of distances from one of the methods itself.
std::optional<Figure> rank_figure(const ResultsView& view, const MethodComparison& comparison) {
  if (!has_rank_diagram(comparison) || is_distance_from_another(*comparison.quantity))
    return std::nullopt;
  if (critical_difference(comparison) > static_cast<double>(comparison.methods.size()) - 1.0)
    return std::nullopt;
  CriticalDifferenceSpec spec;
  spec.alpha = kSignificanceOfMethods;
  spec.id = figure_id(comparison.id, "ranks-" + comparison.quantity->id);
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

std::string why_no_figure(const ResultsView& view, const ResultsBlock& block,
                          const Quantity& quantity) {
  if (block.has_axis()) return why_no_curve(view, block, quantity);
  return view.study().results.are_repeats ? why_no_distribution(view, block, quantity) : "";
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
