#include "reports/sections/results/results_figures.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/slug.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/best_line.hpp"
#include "render/figures/curves/level_curve.hpp"
#include "render/figures/curves/thinning.hpp"
#include "render/figures/diagrams/heat_map.hpp"
#include "render/figures/diagrams/method_comparison.hpp"
#include "render/figures/maps/map.hpp"
#include "render/figures/number_text.hpp"
#include "reports/sections/method_ranks.hpp"

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

/// Bands of more lines than these hide each other.
constexpr std::size_t kMostBands = 4;
/// With fewer groups of runs an interval of the mean is a guess: the runs themselves are shown.
constexpr std::size_t kFewestGroups = 5;
constexpr const char* kSingleRuns = "single runs";
constexpr const char* kSingleRunsRemark =
    " Small circles: single runs, which are too few for an interval.";
/// Levels, and values of a distribution, that span more than this are on a logarithmic axis.
constexpr double kWideSpan = 20.0;
/// A distribution over more runs has steps of several: 0.2 % is less than the width of a line.
constexpr std::size_t kMostSteps = 500;
/// Fewer different values have no distribution.
constexpr std::size_t kFewestValues = 3;
/// More panels than these are too narrow to be read.
constexpr std::size_t kMostPanels = 4;

std::string figure_id(const std::string& block, std::string what) {
  std::ranges::replace(what, '_', '-');
  return block + "-" + what;
}

std::string key_of(std::size_t line) { return fmt::format("line-{}", line + 1); }

/// The subject of all results of the block's setup: a diff finds them by it.
std::string record_of(const ResultsBlock& block) { return block.conditions.front().setup; }

bool spans_widely(std::vector<double> values) {
  if (values.empty()) return false;
  const auto [least, greatest] = std::ranges::minmax(values);
  return least > 0.0 && greatest > kWideSpan * least;
}

/// Of levels: a 0 among them does not count, since no logarithmic axis has it.
bool spans_widely_above_0(std::vector<double> levels) {
  std::erase(levels, 0.0);
  return levels.size() > 1 && spans_widely(std::move(levels));
}

void drop_level_0(ErrorLine& line) {
  if (line.x.empty() || line.x.front() != 0.0) return;
  for (std::vector<double>* values : {&line.x, &line.mean, &line.low, &line.high})
    if (!values->empty()) values->erase(values->begin());
}

bool is_known(double value) { return std::isfinite(value); }

/// Whether any two values differ: what is the same everywhere needs no figure.
bool distinguishes(const std::vector<ErrorLine>& lines) {
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  for (const ErrorLine& line : lines)
    for (const double mean : line.mean) {
      if (!is_known(mean)) continue;
      least = std::min(least, mean);
      greatest = std::max(greatest, mean);
    }
  return greatest > least;
}

Scale scale_of(const std::vector<Level>& levels) {
  std::vector<double> numbers;
  for (const Level& level : levels) numbers.push_back(std::get<double>(level.value));
  return spans_widely_above_0(std::move(numbers)) ? Scale::kLog : Scale::kLinear;
}

ErrorLine curve_of(const ResultsView& view, const ResultsBlock& block, const Quantity& quantity,
                   const ResultsLine& line, std::size_t index) {
  ErrorLine curve;
  curve.label = line.label;
  curve.key = key_of(index);
  if (line.run.empty()) curve.series = line.series;
  for (std::size_t i = 0; i < block.levels.size(); ++i) {
    const auto mean = view.mean(block.conditions[i], line, quantity);
    const auto interval = view.interval(mean, quantity);
    curve.x.push_back(std::get<double>(block.levels[i].value));
    curve.mean.push_back(mean ? mean->mean : kNaN);
    curve.low.push_back(interval ? interval->low : kNaN);
    curve.high.push_back(interval ? interval->high : kNaN);
  }
  return curve;
}

/// What the labels of some lines end with: "from scratch" of "SMACOF, from scratch" and "ISOMAP,
/// from scratch"; else the first one with the number of the others.
std::string joined_label(const std::vector<std::string>& labels) {
  constexpr std::string_view kComma = ", ";
  for (std::size_t at = labels.front().find(kComma); at != std::string::npos;
       at = labels.front().find(kComma, at + 1)) {
    const std::string end = labels.front().substr(at);
    if (std::ranges::all_of(labels, [&](const std::string& one) { return one.ends_with(end); }))
      return fmt::format("{} ({} methods)", end.substr(kComma.size()), labels.size());
  }
  return fmt::format("{} and {}", labels.front(), counted(std::ssize(labels) - 1, "other"));
}

/// Curves that are the same as one: drawn each, the last would hide the others.
std::vector<ErrorLine> joined(std::vector<ErrorLine> curves) {
  std::vector<ErrorLine> apart;
  while (!curves.empty()) {
    const ErrorLine first = curves.front();
    std::vector<std::string> labels;
    std::erase_if(curves, [&](const ErrorLine& one) {
      const bool is_same = one.x == first.x && one.mean == first.mean;
      if (is_same) labels.push_back(one.label);
      return is_same || one.key == first.key;
    });
    apart.push_back(first);
    if (labels.size() < 2) continue;
    apart.back().label = joined_label(labels);
    apart.back().series = std::nullopt;
  }
  return apart;
}

/// The curves of a block, those without a value left out; of many, or without intervals, the lines
/// alone, and those that are the same joined.
std::vector<ErrorLine> curves_of(const ResultsView& view, const ResultsBlock& block,
                                 const Quantity& quantity) {
  const std::vector<ResultsLine> lines = view.lines(block, quantity);
  const bool is_log = scale_of(block.levels) == Scale::kLog;
  std::vector<ErrorLine> curves;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    ErrorLine curve = curve_of(view, block, quantity, lines[i], i);
    if (std::ranges::none_of(curve.mean, is_known)) continue;
    if (lines.size() > kMostBands || view.groups() < kFewestGroups ||
        std::ranges::none_of(curve.low, is_known)) {
      curve.low.clear();
      curve.high.clear();
    }
    if (is_log) drop_level_0(curve);
    curves.push_back(std::move(curve));
  }
  return lines.size() > kMostBands ? joined(std::move(curves)) : curves;
}

/// "Regret with anchors" as "regret with anchors", but "MPE" as it is.
std::string in_sentence(std::string label) {
  if (label.size() < 2 || lower_case(label.substr(1, 1)) != label.substr(1, 1)) return label;
  return lower_case(label.substr(0, 1)) + label.substr(1);
}

/// Which method is best over the axis; empty of a quantity that has no better side.
std::string finding_of(const std::vector<ErrorLine>& lines, const Quantity& quantity,
                       const std::string& x_label) {
  if (quantity.better == Better::kNeither || lines.size() < 2) return "";
  return best_over(lines,
                   {in_sentence(quantity.label), quantity.unit, quantity.better == Better::kLower},
                   line_axis(x_label));
}

/// What lines do where none of them is called the best: of one, how it goes from the first x to the
/// last; of several, between which values they lie. Empty if nothing is known.
std::string course_of(const std::vector<ErrorLine>& lines, const Quantity& quantity) {
  std::vector<double> known;
  for (const ErrorLine& line : lines)
    std::ranges::copy_if(line.mean, std::back_inserter(known), is_known);
  if (known.empty()) return "";
  const auto words = [&](double value) {
    return with_unit(rounded_text(value, decimals_of(known)), quantity.unit);
  };
  const std::string first = words(known.front()), last = words(known.back());
  if (lines.size() == 1)
    return first == last
               ? fmt::format("{} stays at {}", in_sentence(quantity.label), first)
               : fmt::format("{} {} from {} to {}", in_sentence(quantity.label),
                             known.back() < known.front() ? "falls" : "rises", first, last);
  const auto [least, greatest] = std::ranges::minmax(known);
  return fmt::format("{} between {} and {}", in_sentence(quantity.label), words(least),
                     words(greatest));
}

/// The values of the runs that the curves are means of, if these are too few for intervals; none
/// of many curves.
std::vector<ErrorPoint> runs_of(const ResultsView& view, const ResultsBlock& block,
                                const Quantity& quantity) {
  const std::vector<ResultsLine> lines = view.lines(block, quantity);
  std::vector<ErrorPoint> points;
  if (view.groups() >= kFewestGroups || lines.size() > kMostBands) return points;
  const bool is_log = scale_of(block.levels) == Scale::kLog;
  for (const ResultsLine& line : lines)
    for (std::size_t i = 0; i < block.levels.size(); ++i) {
      const double x = std::get<double>(block.levels[i].value);
      const auto values = view.numbers(block.conditions[i], line, quantity).values;
      if (values.size() < 2 || (is_log && x == 0.0)) continue;
      for (const auto& [run, value] : values)
        points.push_back({.label = kSingleRuns,
                          .line = line.label,
                          .x = x,
                          .y = value,
                          .marker = Marker::kCircle,
                          .size = 0.6});
    }
  return points;
}

std::optional<Figure> curve_figure(const ResultsView& view, const ResultsBlock& block,
                                   const Quantity& quantity) {
  LevelCurveSpec spec;
  spec.id = figure_id(block.id, quantity.id);
  spec.title = block.title + ": " + quantity.label;
  spec.x_label = view.factor_label(block.factor);
  spec.x_scale = scale_of(block.levels);
  spec.y_label = label_with_unit(quantity);
  spec.quantity = quantity.label;
  spec.great_errors = view.has_great_errors(quantity);
  spec.record_ids = {record_of(block)};
  spec.methods = curves_of(view, block, quantity);
  spec.points = runs_of(view, block, quantity);
  if (!spec.points.empty()) spec.remark = kSingleRunsRemark;
  if (!distinguishes(spec.methods)) return std::nullopt;
  if (const std::string best = finding_of(spec.methods, quantity, spec.x_label); !best.empty())
    spec.title = block.title + ": " + best;
  else if (const std::string course = course_of(spec.methods, quantity); !course.empty())
    spec.title = block.title + ": " + course;
  if (quantity.unit == "%") spec.log_from = HUGE_VAL;
  Figure figure = level_curve_figure(spec);
  if (spec.x_scale == Scale::kLog && std::get<double>(block.levels.front().value) == 0.0)
    figure.caption += " The table has the level 0, which a logarithmic axis has not.";
  return figure;
}

/// The curves of several blocks, a panel each on one y axis.
std::optional<Figure> overview_figure(const ResultsView& view, const ResultsOverview& overview,
                                      const Quantity& quantity) {
  const bool has_axes = std::ranges::all_of(overview.blocks, &ResultsBlock::has_axis);
  if (!has_axes || overview.blocks.size() > kMostPanels) return std::nullopt;
  ErrorLinesSpec spec;
  spec.id = figure_id(overview.id, quantity.id);
  spec.title = fmt::format("{}: {}", overview.title, quantity.label);
  spec.y_label = label_with_unit(quantity);
  spec.quantity = quantity.label;
  spec.great_errors = view.has_great_errors(quantity);
  spec.record_ids = {record_of(*overview.blocks.front())};
  for (std::size_t i = 0; i < overview.blocks.size(); ++i) {
    const ResultsBlock& block = *overview.blocks[i];
    ErrorPanel& panel = spec.panels.emplace_back();
    panel.title = overview.names[i];
    panel.x.label = view.factor_label(block.factor);
    panel.x.scale = scale_of(block.levels);
    panel.lines = curves_of(view, block, quantity);
    panel.points = runs_of(view, block, quantity);
    if (!panel.points.empty()) spec.remark = kSingleRunsRemark;
  }
  if (std::ranges::all_of(spec.panels, [](const ErrorPanel& panel) { return panel.lines.empty(); }))
    return std::nullopt;
  spec.over = fmt::format(" over {} by {}", view.factor_label(overview.blocks.front()->factor),
                          overview.factors);
  return error_lines_figure(spec);
}

/// The share of runs at or below a value, in steps; of many runs each step is of several.
ErrorLine distribution_of(const ValuesByRun& runs) {
  std::vector<double> values;
  for (const auto& [run, value] : runs) values.push_back(value);
  std::ranges::sort(values);
  ErrorLine curve;
  double share = 0.0;
  const std::size_t steps = std::min(values.size(), kMostSteps);
  for (std::size_t step = 1, before = 0; step <= steps; ++step) {
    const std::size_t end = step * values.size() / steps;
    const double value = values[end - 1];
    curve.x.insert(curve.x.end(), {value, value});
    curve.mean.push_back(share);
    for (; before < end; ++before) share += 100.0 / static_cast<double>(values.size());
    curve.mean.push_back(share);
  }
  return curve;
}

/// Whether any method has values of several runs at one level.
bool has_several_runs(const ResultsView& view, const ResultsBlock& block,
                      const Quantity& quantity) {
  for (const ResultsLine& line : view.lines(block, quantity))
    for (const Condition& at : block.conditions)
      if (view.numbers(at, line, quantity).values.size() > 1) return true;
  return false;
}

/// Whether the methods have enough different values at the levels of a block.
bool has_different_values(const ResultsView& view, const ResultsBlock& block,
                          const Quantity& quantity) {
  std::set<double> values;
  for (const ResultsLine& line : view.lines(block, quantity))
    for (const Condition& at : block.conditions)
      for (const auto& [run, value] : view.numbers(at, line, quantity).values) {
        values.insert(value);
        if (values.size() >= kFewestValues) return true;
      }
  return false;
}

/// Where no factor has numbers: the distribution over runs, a panel per level. Steps between two
/// values would show nothing but a share, which the table has.
std::optional<Figure> distribution_figure(const ResultsView& view, const ResultsBlock& block,
                                          const Quantity& quantity) {
  if (!view.study().results.are_repeats || block.conditions.size() > kMostPanels ||
      !has_several_runs(view, block, quantity) || !has_different_values(view, block, quantity))
    return std::nullopt;
  ErrorLinesSpec spec;
  spec.id = figure_id(block.id, quantity.id);
  spec.title = block.title + ": " + quantity.label;
  spec.y_label = "runs at or below [%]";
  spec.quantity = "share of runs whose " + quantity.label + " is at or below a value";
  spec.caption =
      fmt::format("Lines: the share of runs whose {} is at or below a value.", quantity.label);
  spec.record_ids = {record_of(block)};
  spec.log_from = HUGE_VAL;
  const std::vector<ResultsLine> lines = view.lines(block, quantity);
  std::vector<double> values;
  for (std::size_t i = 0; i < block.conditions.size(); ++i) {
    ErrorPanel& panel = spec.panels.emplace_back();
    if (!block.factor.empty()) panel.title = view.level_words(block.levels[i]);
    panel.x.label = label_with_unit(quantity);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const auto runs = view.numbers(block.conditions[i], lines[k], quantity).values;
      ErrorLine curve = distribution_of(runs);
      if (curve.x.empty()) continue;
      values.insert(values.end(), curve.x.begin(), curve.x.end());
      curve.label = lines[k].label;
      curve.key = key_of(k);
      curve.series = lines[k].series;
      panel.lines.push_back(std::move(curve));
    }
  }
  if (spans_widely(values))
    for (ErrorPanel& panel : spec.panels) panel.x.scale = Scale::kLog;
  return error_lines_figure(spec);
}

std::optional<Figure> rank_figure(const ResultsView& view, const MethodComparison& comparison) {
  if (!has_rank_diagram(comparison)) return std::nullopt;
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

/// An id that no figure of the group has.
std::string free_id(const FigureGroup& group, const std::string& id) {
  std::string free = id;
  for (int i = 2; std::ranges::find(group.figures, free, &Figure::id) != group.figures.end(); ++i)
    free = fmt::format("{}-{}", id, i);
  return free;
}

Polyline path_line(const std::string& label, const Trajectory& path, ThemeColour colour,
                   double width) {
  constexpr double kShareOfSpan = 5e-4;  // Less than a line's width.
  const Eigen::RowVector2d span =
      path.positions_m.colwise().maxCoeff() - path.positions_m.colwise().minCoeff();
  const ThinLine thin = thin_path(path, kShareOfSpan * span.maxCoeff());
  return {.label = label, .x = thin.x, .y = thin.y, .colour = colour, .width = width};
}

std::string alignment_words(const GivenPath& path) {
  switch (path.alignment) {
    case Alignment::kRigid:
      return ", to which it was aligned by rotation and translation";
    case Alignment::kSimilarity:
      return ", to which it was aligned by rotation, translation and scale";
    default:
      return ", as it was given: nothing was aligned";
  }
}

Figure path_figure(const GivenPath& path, std::string id) {
  Figure figure;
  figure.id = std::move(id);
  figure.title = path.id;
  figure.record_ids = {"paths/" + path.id};
  Panel& panel = figure.panels.emplace_back();
  panel.x.label = "x [m]";
  panel.y.label = "y [m]";
  panel.equal_aspect = true;
  if (path.ground_truth)
    panel.layers.emplace_back(
        path_line("ground truth", *path.ground_truth, ThemeColour::kText, 0.6));
  panel.layers.emplace_back(path_line("estimate", path.path, ThemeColour::kSeries1, 1.0));
  figure.caption =
      fmt::format("The path {} of {} poses{}{}.", path.id, path.path.size(),
                  path.ground_truth ? " and its ground truth" : "", alignment_words(path));
  constexpr double kMicrometres = 1e6;  // Below, a distance is rounding alone.
  if (path.rms_m)
    figure.caption += fmt::format(" RMS distance from the ground truth: {:.3g} m.",
                                  std::round(kMicrometres * *path.rms_m) / kMicrometres);
  figure.alt = figure.caption;
  require_valid(figure);
  return figure;
}

}  // namespace

FigureGroup heat_maps(const ResultsView& view, const Label& setup) {
  const std::string id = fmt::format("{}-{}-grid", view.study().name, view.setup_slug(setup.id));
  FigureGroup group{id, setup.label, "", {}};
  if (!view.study().results.are_repeats) return group;
  const std::optional<Grid> grid = grid_of(view, setup);
  if (!grid) return group;
  for (const std::string& known : view.study().quantities) {
    const Quantity& quantity = view.quantity(known);
    const std::vector<ResultsLine> lines = lines_in(view, *grid, quantity);
    std::vector<double> all;
    for (const ResultsLine& line : lines)
      for (const double mean : means_over(view, *grid, setup.id, line, quantity))
        all.push_back(mean);
    const int decimals = decimals_of(all);
    for (const ResultsLine& line : lines) {
      HeatMapSpec spec;
      spec.id = fmt::format("{}-{}-{}", id, slug_of(quantity.id), slug_of(line.method));
      spec.title = fmt::format("{}, {}: {}", setup.label, line.label, quantity.label);
      spec.x_label = view.factor_label(grid->x);
      spec.y_label = view.factor_label(grid->y);
      spec.x_names = names_of(grid->x_levels);
      spec.y_names = names_of(grid->y_levels);
      spec.values = means_over(view, *grid, setup.id, line, quantity);
      spec.decimals = decimals;
      spec.quantity = quantity.label;
      spec.unit = quantity.unit;
      spec.missing = "no run gave a value";
      spec.record_ids = {setup.id};
      if (std::ranges::any_of(spec.values, [](double mean) { return std::isfinite(mean); }))
        group.figures.push_back(heat_map_figure(spec));
    }
  }
  return group;
}

FigureGroup given_figures(const ResultsStudy& study, const std::vector<MapRecord>& maps,
                          const std::vector<GivenPath>& paths) {
  FigureGroup group{study.name + "-maps", "Maps and paths", "", {}};
  for (const MapRecord& map : maps) {
    const std::string id = free_id(group, study.name + "-map-" + slug_of(map.id));
    group.figures.push_back(map_figure(map, id, map.id));
    group.figures.back().record_ids = {"maps/" + map.id};
  }
  for (const GivenPath& path : paths)
    group.figures.push_back(
        path_figure(path, free_id(group, study.name + "-path-" + slug_of(path.id))));
  return group;
}

namespace {

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
  if (block.has_axis()) {
    const std::vector<ErrorLine> curves = curves_of(view, block, quantity);
    if (curves.empty())
      return fmt::format("{}: there is no curve, since no run gave a value.", quantity.label);
    if (distinguishes(curves)) return "";
    const double mean = *std::ranges::find_if(curves.front().mean, is_known);
    const std::string value = with_unit(fmt::format("{:.6g}", mean), quantity.unit);
    const bool are_repeats = view.study().results.are_repeats;
    return fmt::format("{}: there is no curve, since the {} is {} at every level{}.",
                       quantity.label, are_repeats ? "mean" : "value", value,
                       curves.size() == 1 ? ""
                       : are_repeats      ? ", for every method"
                                          : ", for every method and run");
  }
  if (!view.study().results.are_repeats) return "";
  if (block.conditions.size() > kMostPanels)
    return fmt::format(
        "{}: there is no figure of the distribution over runs, which shows {} levels at most.",
        quantity.label, kMostPanels);
  if (!has_several_runs(view, block, quantity))
    return fmt::format(
        "{}: there is no figure of the distribution over runs, since no method has two values at "
        "one level.",
        quantity.label);
  if (!has_different_values(view, block, quantity))
    return fmt::format(
        "{}: there is no figure of the distribution over runs, which have fewer than {} different "
        "values.",
        quantity.label, kFewestValues);
  return "";
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
