#include "reports/sections/results/results_figures.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/slug.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/best_line.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/curves/level_curve.hpp"
#include "render/figures/curves/method_series.hpp"
#include "render/figures/curves/thinning.hpp"
#include "render/figures/diagrams/heat_map.hpp"
#include "render/figures/diagrams/method_comparison.hpp"
#include "render/figures/diagrams/value_dots.hpp"
#include "render/figures/score_text.hpp"
#include "render/figures/unit_scale.hpp"
#include "reports/sections/method_ranks.hpp"
#include "reports/sections/results/crossed_names.hpp"
#include "reports/sections/tables/cells.hpp"

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

/// Of more lines some may hide others.
constexpr std::size_t kMostApart = 4;
constexpr const char* kSingleRuns = "single runs";
constexpr const char* kSingleRunsRemark =
    " Small circles: single runs, which are too few for an interval.";
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

/// `low` and `high` are of the interval or, of few groups of runs, of the runs themselves.
ErrorLine curve_of(const ResultsView& view, const ResultsBlock& block, const Quantity& quantity,
                   const ResultsLine& line, std::size_t index) {
  ErrorLine curve;
  curve.label = line.label;
  curve.key = key_of(index);
  if (line.run.empty()) curve.series = line.series;
  for (std::size_t i = 0; i < block.levels.size(); ++i) {
    const auto mean = view.mean(block.conditions[i], line, quantity);
    const auto spread = view.spread(block.conditions[i], line, quantity);
    curve.x.push_back(std::get<double>(block.levels[i].value));
    curve.mean.push_back(mean ? mean->mean : kNaN);
    curve.low.push_back(spread ? spread->low : kNaN);
    curve.high.push_back(spread ? spread->high : kNaN);
  }
  return curve;
}

/// How curves that are the same are named: what only their labels end with, "from scratch (2
/// methods)" of "SMACOF, from scratch" and "ISOMAP, from scratch"; else two by both labels, more by
/// the first one and their number.
std::string joined_label(const std::vector<std::string>& labels,
                         const std::vector<std::string>& others) {
  constexpr std::string_view kComma = ", ";
  for (std::size_t at = labels.front().find(kComma); at != std::string::npos;
       at = labels.front().find(kComma, at + 1)) {
    const std::string end = labels.front().substr(at);
    const auto has_end = [&](const std::string& one) { return one.ends_with(end); };
    if (std::ranges::all_of(labels, has_end) && std::ranges::none_of(others, has_end))
      return fmt::format("{} ({} methods)", end.substr(kComma.size()), labels.size());
  }
  constexpr std::size_t kLongest = 40;  // Of a label, in characters.
  if (labels.size() == 2 && labels[0].size() + labels[1].size() < kLongest)
    return labels[0] + " and " + labels[1];
  return fmt::format("{} and {}", labels.front(), counted(std::ssize(labels) - 1, "other"));
}

/// Curves of a block.
struct Curves {
  std::vector<ErrorLine> lines;
  std::vector<std::string> joined = {};  ///< Labels of those that are several.
  /// Of those, the label of the first line: what is joined has its values.
  std::map<std::string, std::string> joined_by_first = {};
  bool lacks_compared_with = false;  ///< What the others are compared with is left out.
  bool has_bands = false;            ///< Else `low` and `high` serve findings alone.
};

/// As they are drawn.
std::vector<ErrorLine> drawn(Curves curves) {
  for (ErrorLine& line : curves.lines)
    if (!curves.has_bands || std::ranges::none_of(line.low, is_known)) {
      line.low.clear();
      line.high.clear();
    }
  return std::move(curves.lines);
}

/// Joins curves that are the same to one, in the style of the first: drawn each, the last would
/// hide the others.
void join_same(Curves& curves) {
  std::vector<ErrorLine> apart;
  for (const ErrorLine& first : curves.lines) {
    const auto is_same = [&](const ErrorLine& one) {
      return one.x == first.x && one.mean == first.mean;
    };
    if (std::ranges::any_of(apart, is_same)) continue;
    std::vector<std::string> labels, others;
    for (const ErrorLine& one : curves.lines) (is_same(one) ? labels : others).push_back(one.label);
    apart.push_back(first);
    if (labels.size() == 1) continue;
    apart.back().label = joined_label(labels, others);
    curves.joined.push_back(apart.back().label);
    curves.joined_by_first[first.label] = apart.back().label;
  }
  curves.lines = std::move(apart);
}

/// A distance from the results of another method, which are 0 of that method itself.
bool is_distance_from_another(const Quantity& quantity) {
  return quantity.id.starts_with("gap_") || quantity.id.starts_with("greatest_gap_");
}

/// A distance of parts per million: what counts is how little it is, not whose is the least.
bool is_tiny_distance(const Quantity& quantity) {
  return is_distance_from_another(quantity) && quantity.unit == "ppm";
}

/// Leaves the curves of what the others are compared with out, unless there are no others.
/// @return Whether there was one.
bool drop_compared_with(std::vector<ErrorLine>& curves) {
  const auto is_0 = [](const ErrorLine& curve) {
    return std::ranges::any_of(curve.mean, is_known) &&
           std::ranges::all_of(curve.mean,
                               [](double mean) { return mean == 0.0 || std::isnan(mean); });
  };
  return !std::ranges::all_of(curves, is_0) && std::erase_if(curves, is_0) > 0;
}

/// The curves of a block, those without a value left out; many, or of few groups of runs, are drawn
/// without bands, and those of many that are the same are joined.
Curves curves_of(const ResultsView& view, const ResultsBlock& block, const Quantity& quantity) {
  const std::vector<ResultsLine> lines = view.lines(block, quantity);
  const bool is_log = scale_of(block.levels) == Scale::kLog;
  Curves curves;
  curves.has_bands = lines.size() <= kMethodStyles && view.has_groups_for_intervals();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    ErrorLine curve = curve_of(view, block, quantity, lines[i], i);
    if (std::ranges::none_of(curve.mean, is_known)) continue;
    if (is_log) drop_level_0(curve);
    curves.lines.push_back(std::move(curve));
  }
  if (is_distance_from_another(quantity))
    curves.lacks_compared_with = drop_compared_with(curves.lines);
  if (lines.size() > kMostApart) join_same(curves);
  return curves;
}

/// In a unit in which the values of the curves need no power of ten; an MPE is in m everywhere.
/// @return The quantity with that unit.
Quantity scale_to_unit(const Quantity& quantity, Curves& curves, std::vector<ErrorPoint>& points) {
  if (quantity.label == "MPE") return quantity;
  double greatest = 0.0;
  const auto for_each_value = [&](std::vector<ErrorLine>& lines, auto&& visit) {
    for (ErrorLine& line : lines)
      for (std::vector<double>* values : {&line.mean, &line.low, &line.high})
        for (double& value : *values) visit(value);
    for (ErrorPoint& point : points) visit(point.y);
  };
  std::vector<ErrorLine> shown_lines = drawn(curves);
  for_each_value(shown_lines,
                 [&](double& value) { greatest = std::max(greatest, std::abs(value)); });
  const ScaledUnit unit = scaled_unit(quantity.unit, greatest);
  for_each_value(curves.lines, [&](double& value) { value *= unit.factor; });
  Quantity shown = quantity;
  shown.unit = unit.unit;
  return shown;
}

/// "Regret with anchors" as "regret with anchors", but "MPE" as it is; "MOE, reflection allowed" as
/// "MOE (reflection allowed)".
std::string in_sentence(std::string label) {
  if (const std::size_t comma = label.find(", "); comma != std::string::npos)
    label = fmt::format("{} ({})", label.substr(0, comma), label.substr(comma + 2));
  if (label.size() < 2 || lower_case(label.substr(1, 1)) != label.substr(1, 1)) return label;
  return lower_case(label.substr(0, 1)) + label.substr(1);
}

/// The coverage that 95 % ellipses are meant to have [%]: more is as wrong as less. Nothing of
/// other quantities.
std::optional<double> aim_of(const Quantity& quantity) {
  return quantity.id.ends_with("_covered_percent") ? std::optional(95.0) : std::nullopt;
}

/// Whether one side of the quantity is better: findings then name methods.
bool has_better_side(const Quantity& quantity) {
  return quantity.better != Better::kNeither && !aim_of(quantity);
}

/// Which method is best over the axis; empty of a quantity that has no better side.
std::string finding_of(const Curves& curves, const Quantity& quantity, const std::string& x_label) {
  if (!has_better_side(quantity) || curves.lines.size() < 2) return "";
  return best_over(curves.lines,
                   {in_sentence(quantity.label), quantity.unit, quantity.better == Better::kLower,
                    curves.joined},
                   line_axis(x_label));
}

/// What lines do where none of them is called the best: of one, how it goes from the first x to the
/// last; of several, why they are not ranked and between which values they lie; of tiny distances,
/// how much they are at most; of what is aimed at, the aim. Empty if nothing is known.
/// @param unit         Of the lines' values.
/// @param not_ranked   kIntervalsOverlap or kTooFewRuns.
std::string course_of(const std::vector<ErrorLine>& lines, const Quantity& quantity,
                      const std::string& unit, const std::string& not_ranked) {
  std::vector<double> known;
  for (const ErrorLine& line : lines)
    std::ranges::copy_if(line.mean, std::back_inserter(known), is_known);
  if (known.empty()) return "";
  const auto words = [&](double value) {
    if (const auto power = power_of(unit))
      return quantity_text(value * std::pow(10.0, *power), quantity.unit);
    return quantity_text(value, unit);
  };
  if (is_tiny_distance(quantity))
    return fmt::format("{} is at most {}", in_sentence(quantity.label),
                       words(std::ranges::max(known)));
  const std::string first = words(known.front()), last = words(known.back());
  if (lines.size() == 1)
    return first == last ? fmt::format("{} stays at {}", in_sentence(quantity.label), first)
           : ends_tie(lines.front())
               ? fmt::format("{} has no clear trend, {} and {} at the ends",
                             in_sentence(quantity.label), first, last)
               : fmt::format("{} {} from {} to {}", in_sentence(quantity.label),
                             known.back() < known.front() ? "falls" : "rises", first, last);
  const auto [least, greatest] = std::ranges::minmax(known);
  const std::string span = words(least) == words(greatest)
                               ? words(least)
                               : fmt::format("between {} and {}", words(least), words(greatest));
  if (const auto aim = aim_of(quantity))
    return fmt::format("{} {}, aimed at {}", in_sentence(quantity.label), span,
                       with_unit(data_number(*aim), unit));
  return fmt::format("{}{} {}", has_better_side(quantity) ? not_ranked : "",
                     in_sentence(quantity.label), span);
}

/// The label of the curve that shows a line; empty if none does.
std::string label_of_curve(const Curves& curves, const std::string& line) {
  const auto joined = curves.joined_by_first.find(line);
  const std::string& label = joined == curves.joined_by_first.end() ? line : joined->second;
  return std::ranges::find(curves.lines, label, &ErrorLine::label) == curves.lines.end() ? ""
                                                                                         : label;
}

/// The values of the runs that the curves are means of, if these are too few for intervals; none
/// of more curves than have styles of their own.
std::vector<ErrorPoint> runs_of(const ResultsView& view, const ResultsBlock& block,
                                const Quantity& quantity, const Curves& curves) {
  std::vector<ErrorPoint> points;
  if (view.has_groups_for_intervals() || curves.lines.size() > kMethodStyles) return points;
  const bool is_log = scale_of(block.levels) == Scale::kLog;
  for (const ResultsLine& line : view.lines(block, quantity)) {
    const std::string label = label_of_curve(curves, line.label);
    if (label.empty()) continue;
    for (std::size_t i = 0; i < block.levels.size(); ++i) {
      const double x = std::get<double>(block.levels[i].value);
      const auto values = view.numbers(block.conditions[i], line, quantity).values;
      if (values.size() < 2 || (is_log && x == 0.0)) continue;
      for (const auto& [run, value] : values)
        points.push_back({.label = kSingleRuns,
                          .line = label,
                          .x = x,
                          .y = value,
                          .marker = Marker::kCircle,
                          .size = 0.6});
    }
  }
  return points;
}

/// The legend's sample of points of several lines is grey: else it would be that of one line alone.
void add_sample_of_runs(Panel& panel, const std::vector<ErrorPoint>& points) {
  const auto is_other = [&](const ErrorPoint& point) { return point.line != points[0].line; };
  if (std::ranges::none_of(points, is_other)) return;
  panel.layers.insert(panel.layers.begin(), Scatter{.label = points[0].label,
                                                    .x = {kNaN},
                                                    .y = {kNaN},
                                                    .colour = ThemeColour::kMuted,
                                                    .marker = points[0].marker,
                                                    .filled = false,
                                                    .size = points[0].size});
}

/// A line at the value that is aimed at, below the others.
void add_aim(Panel& panel, double aim, const std::vector<ErrorLine>& lines) {
  const std::vector<double>& x = lines.front().x;
  panel.layers.insert(panel.layers.begin(), Polyline{.label = "aimed at",
                                                     .x = {x.front(), x.back()},
                                                     .y = {aim, aim},
                                                     .colour = ThemeColour::kMuted,
                                                     .dash = Dash::kDotted});
  if (!panel.y.limits) return;
  Range& limits = *panel.y.limits;
  const double margin = 0.05 * std::max(limits.high - aim, aim - limits.low);
  limits = {std::min(limits.low, aim - margin), std::max(limits.high, aim + margin)};
}

std::optional<Figure> curve_figure(const ResultsView& view, const ResultsBlock& block,
                                   const Quantity& quantity) {
  LevelCurveSpec spec;
  spec.id = figure_id(block.id, quantity.id);
  spec.x_label = view.factor_label(block.factor);
  spec.x_scale = scale_of(block.levels);
  spec.quantity = quantity.label;
  spec.great_errors = view.has_great_errors(quantity);
  spec.has_runs = view.runs() > 1;
  spec.record_ids = {record_of(block)};
  Curves curves = curves_of(view, block, quantity);
  if (!distinguishes(curves.lines)) return std::nullopt;
  spec.points = runs_of(view, block, quantity, curves);
  const Quantity shown = scale_to_unit(quantity, curves, spec.points);
  spec.y_label = label_with_unit(shown);
  if (!spec.points.empty()) spec.remark = kSingleRunsRemark;
  std::string finding = is_tiny_distance(quantity) ? "" : finding_of(curves, shown, spec.x_label);
  if (finding.empty())
    finding = course_of(curves.lines, quantity, shown.unit,
                        view.has_groups_for_intervals() ? kIntervalsOverlap : kTooFewRuns);
  spec.title = fmt::format("{}: {}", block.title, finding.empty() ? quantity.label : finding);
  if (quantity.unit == "%") spec.log_from = HUGE_VAL;
  spec.methods = drawn(std::move(curves));
  Figure figure = level_curve_figure(spec);
  add_sample_of_runs(figure.panels.front(), spec.points);
  if (const auto aim = aim_of(quantity)) add_aim(figure.panels.front(), *aim, spec.methods);
  if (spec.x_scale == Scale::kLog && std::get<double>(block.levels.front().value) == 0.0)
    figure.caption += " The table has the level 0, which a logarithmic axis has not.";
  if (curves.lacks_compared_with)
    figure.caption += " What the others are compared with is at 0 and has no line.";
  return figure;
}

/// Which method is best at most of the points of several panels: "ISOMAP has the lowest MPE at 7 of
/// 9 points". Empty of a quantity that has no better side.
/// @param joined  Labels of lines that are several.
std::string most_often_best(const std::vector<std::vector<ErrorLine>>& panels,
                            const Quantity& quantity, const std::vector<std::string>& joined) {
  if (!has_better_side(quantity)) return "";
  return best_of_points(panels, {in_sentence(quantity.label), quantity.unit,
                                 quantity.better == Better::kLower, joined});
}

/// The curves of several blocks, a panel each on one y axis.
std::optional<Figure> overview_figure(const ResultsView& view, const ResultsOverview& overview,
                                      const Quantity& quantity) {
  const bool has_axes = std::ranges::all_of(overview.blocks, &ResultsBlock::has_axis);
  if (!has_axes || overview.blocks.size() > kMostPanels) return std::nullopt;
  ErrorLinesSpec spec;
  spec.id = figure_id(overview.id, quantity.id);
  spec.y_label = label_with_unit(quantity);
  spec.quantity = quantity.label;
  spec.great_errors = view.has_great_errors(quantity);
  spec.has_runs = view.runs() > 1;
  spec.record_ids = {record_of(*overview.blocks.front())};
  std::vector<std::string> joined;
  std::vector<std::vector<ErrorLine>> judged;
  for (std::size_t i = 0; i < overview.blocks.size(); ++i) {
    const ResultsBlock& block = *overview.blocks[i];
    ErrorPanel& panel = spec.panels.emplace_back();
    panel.title = overview.names[i];
    panel.x.label = view.factor_label(block.factor);
    panel.x.scale = scale_of(block.levels);
    const Curves curves = curves_of(view, block, quantity);
    judged.push_back(curves.lines);
    panel.lines = drawn(curves);
    joined.insert(joined.end(), curves.joined.begin(), curves.joined.end());
    panel.points = runs_of(view, block, quantity, curves);
    if (!panel.points.empty()) spec.remark = kSingleRunsRemark;
  }
  if (std::ranges::all_of(spec.panels, [](const ErrorPanel& panel) { return panel.lines.empty(); }))
    return std::nullopt;
  const std::string finding = most_often_best(judged, quantity, joined);
  spec.title =
      finding.empty()
          ? fmt::format("{}: {}", overview.title, quantity.label)
          : fmt::format("{}: {}", overview.title.substr(0, overview.title.find(": ")), finding);
  spec.over = fmt::format(" over {} by {}", view.factor_label(overview.blocks.front()->factor),
                          overview.factors);
  Figure figure = error_lines_figure(spec);
  for (std::size_t i = 0; i < spec.panels.size(); ++i)
    add_sample_of_runs(figure.panels[i], spec.panels[i].points);
  return figure;
}

double median_of(const ValuesByRun& runs) {
  std::vector<double> values;
  for (const auto& [run, value] : runs) values.push_back(value);
  return median(values);
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

/// What distributions show: of one method the median and the greatest value, of several in one
/// panel which has the best median; else the quantity alone.
/// @param medians  Over the runs, of each line of the first panel.
std::string distribution_words(const std::vector<ErrorPanel>& panels,
                               const std::vector<double>& medians, const Quantity& quantity) {
  if (panels.size() != 1 || panels.front().lines.empty()) return quantity.label;
  const std::vector<ErrorLine>& lines = panels.front().lines;
  const auto words = [&](double value) { return quantity_text(value, quantity.unit); };
  const std::string name = in_sentence(quantity.label);
  if (lines.size() == 1)
    return fmt::format("the median {} is {}, the greatest {}", name, words(medians.front()),
                       words(lines.front().x.back()));
  std::vector<ErrorLine> of_lines;
  for (std::size_t i = 0; i < lines.size(); ++i)
    of_lines.push_back(
        {.label = lines[i].label, .key = lines[i].key, .x = {0.0}, .mean = {medians[i]}});
  const LineQuantity of_medians{"median " + name, quantity.unit,
                                quantity.better != Better::kHigher};
  const std::string best = best_of_points({of_lines}, of_medians);
  return !has_better_side(quantity) || best.empty() ? quantity.label : best;
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

/// Where no factor has numbers and the runs are too few for a distribution: each of them, a panel
/// per level. Of one method the table has as much.
std::optional<Figure> runs_figure(const ResultsView& view, const ResultsBlock& block,
                                  const Quantity& quantity) {
  const std::vector<ResultsLine> lines = view.lines(block, quantity);
  if (lines.size() < 2) return std::nullopt;
  ValueDotsSpec spec{.id = figure_id(block.id, quantity.id),
                     .caption = fmt::format("Filled: the median {} of each method; circles: single "
                                            "runs, which are too few for a distribution.",
                                            in_sentence(quantity.label)),
                     .x_label = label_with_unit(quantity),
                     .unit = quantity.unit,
                     .higher_is_better = quantity.better == Better::kHigher,
                     .record_ids = {record_of(block)}};
  std::vector<double> medians;
  for (std::size_t i = 0; i < block.conditions.size(); ++i) {
    ValueDotsPanel& panel = spec.panels.emplace_back();
    if (!block.factor.empty()) panel.title = view.level_words(block.levels[i]);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const auto runs = view.numbers(block.conditions[i], lines[k], quantity).values;
      if (runs.empty()) continue;
      MethodValue& method = panel.methods.emplace_back();
      method = {lines[k].label, key_of(k), lines[k].series, median_of(runs), {}};
      medians.push_back(method.value);
      for (const auto& [run, value] : runs) method.runs.push_back(value);
    }
  }
  if (medians.empty()) return std::nullopt;
  const auto [least, greatest] = std::ranges::minmax(medians);
  spec.title =
      fmt::format("{}: {}the median {} is between {} and {}", block.title,
                  has_better_side(quantity) ? kTooFewRuns : "", in_sentence(quantity.label),
                  quantity_text(least, quantity.unit), quantity_text(greatest, quantity.unit));
  return value_dots_figure(spec);
}

/// Where no factor has numbers: the distribution over runs, a panel per level. Steps between two
/// values would show nothing but a share, which the table has.
std::optional<Figure> distribution_figure(const ResultsView& view, const ResultsBlock& block,
                                          const Quantity& quantity) {
  if (!view.study().results.are_repeats || block.conditions.size() > kMostPanels ||
      !has_several_runs(view, block, quantity) || !has_different_values(view, block, quantity))
    return std::nullopt;
  if (!view.has_groups_for_intervals()) return runs_figure(view, block, quantity);
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
  std::vector<double> values, medians;
  for (std::size_t i = 0; i < block.conditions.size(); ++i) {
    ErrorPanel& panel = spec.panels.emplace_back();
    if (!block.factor.empty()) panel.title = view.level_words(block.levels[i]);
    panel.x.label = label_with_unit(quantity);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const auto runs = view.numbers(block.conditions[i], lines[k], quantity).values;
      ErrorLine curve = distribution_of(runs);
      if (curve.x.empty()) continue;
      if (i == 0) medians.push_back(median_of(runs));
      values.insert(values.end(), curve.x.begin(), curve.x.end());
      curve.label = lines[k].label;
      curve.key = key_of(k);
      curve.series = lines[k].series;
      panel.lines.push_back(std::move(curve));
    }
  }
  if (spans_widely(values))
    for (ErrorPanel& panel : spec.panels) panel.x.scale = Scale::kLog;
  spec.title =
      fmt::format("{}: {}", block.title, distribution_words(spec.panels, medians, quantity));
  return error_lines_figure(spec);
}

/// The methods' values by data set: of each method a marker beside those of the others.
class DataSetDots {
 public:
  DataSetDots(const ResultsView& view, const ResultsBlock& block, const Quantity& quantity)
      : view_(view), block_(block), quantity_(quantity) {
    // Of a method there is a line for each data set.
    for (const ResultsLine& line : view.lines(block, quantity)) {
      const std::string& label = view.study().methods[line.index].label;
      auto same = std::ranges::find(methods_, label, &OfMethod::label);
      if (same == methods_.end())
        same = methods_.insert(same, {line.method, label, line.series, {}});
      same->values.merge(view.numbers(block.conditions.front(), line, quantity).values);
    }
    cross_styles();
  }

  std::size_t methods() const { return methods_.size(); }

  Figure make() const {
    Figure figure;
    figure.id = data_sets_figure_id(block_, quantity_);
    figure.title = fmt::format("{}: {}", block_.title, finding());
    figure.caption = fmt::format(
        "Markers: {} of each method, by data set. Those of one data set stand side by side.{}",
        quantity_.label,
        crossed_ ? " Their colour is that of the name's part before the comma, their form that of "
                   "the part behind it."
                 : "");
    figure.alt = figure.caption;
    figure.record_ids = {record_of(block_)};
    Panel& panel = figure.panels.emplace_back();
    std::vector<double> all;
    for (std::size_t k = 0; k < methods_.size(); ++k) {
      Scatter dots = dots_of(k);
      all.insert(all.end(), dots.y.begin(), dots.y.end());
      if (!dots.x.empty()) panel.layers.emplace_back(std::move(dots));
    }
    add_crossed_legend(panel);
    panel.x.limits = Range{-0.5, static_cast<double>(view_.study().runs.size()) - 0.5};
    for (const Label& run : view_.study().runs) panel.x.names.push_back(run.label);
    panel.y = {.label = label_with_unit(quantity_),
               .scale = spans_widely(all) ? Scale::kLog : Scale::kLinear};
    require_valid(figure);
    return figure;
  }

 private:
  struct OfMethod {
    std::string id;
    std::string label;
    std::size_t series = 0;
    ValuesByRun values;
  };

  /// Names such as "Bearing, ISOMAP" have a colour and a form for each part. Not in a study with
  /// curves, in which a method would then have two colours, nor of mapproof's own methods.
  void cross_styles() {
    if (std::ranges::any_of(view_.blocks(), &ResultsBlock::has_axis)) return;
    std::vector<std::string> labels, of_study;
    for (const OfMethod& method : methods_) {
      if (is_mapping_method(method.id)) return;
      labels.push_back(method.label);
    }
    for (const Label& method : view_.study().methods) of_study.push_back(method.label);
    auto crossed = crossed_names(labels, of_study);
    if (!crossed || crossed->firsts.size() > kSeriesCount || crossed->seconds.size() > kMarkerCount)
      return;
    crossed_ = std::move(crossed);
  }

  SeriesStyle style_of(std::size_t k) const {
    if (!crossed_) return series_style(methods_[k].series);
    const auto [first, second] = crossed_->names[k];
    return {.colour = series_colour(first), .marker = series_style(second).marker};
  }

  /// The forms, then the colours.
  void add_crossed_legend(Panel& panel) const {
    if (!crossed_) return;
    std::set<std::size_t> firsts, seconds;
    for (const auto& [first, second] : crossed_->names) {
      firsts.insert(first);
      seconds.insert(second);
    }
    for (const std::size_t second : seconds)
      panel.layers.emplace_back(Scatter{.label = crossed_->seconds[second],
                                        .x = {kNaN},
                                        .y = {kNaN},
                                        .colour = ThemeColour::kText,
                                        .marker = series_style(second).marker});
    for (const std::size_t first : firsts)
      panel.layers.emplace_back(Segments{.label = crossed_->firsts[first],
                                         .x0 = {kNaN},
                                         .y0 = {kNaN},
                                         .x1 = {kNaN},
                                         .y1 = {kNaN},
                                         .colour = series_colour(first),
                                         .width = 4.0});
  }

  Scatter dots_of(std::size_t k) const {
    constexpr double kTaken = 0.7;  // Of the distance between two data sets.
    const SeriesStyle style = style_of(k);
    const double middle = (static_cast<double>(methods_.size()) - 1.0) / 2.0;
    const double aside =
        kTaken * (static_cast<double>(k) - middle) / static_cast<double>(methods_.size());
    Scatter dots{
        .label = crossed_ ? "" : methods_[k].label, .colour = style.colour, .marker = style.marker};
    const std::vector<Label>& runs = view_.study().runs;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const double* value = methods_[k].values.find(runs[i].id);
      if (value == nullptr) continue;
      dots.x.push_back(static_cast<double>(i) + aside);
      dots.y.push_back(*value);
      dots.marks.push_back(
          {fmt::format("{}-set-{}", key_of(k), i + 1),
           {{"curve", methods_[k].label},
            {"points", fmt::format("{}, {}", runs[i].label, data_number(*value))}}});
    }
    return dots;
  }

  /// On how many of the data sets one method is best.
  std::string finding() const {
    const double sign = quantity_.better == Better::kLower ? 1.0 : -1.0;
    std::map<std::size_t, int> wins;
    int sets = 0;
    for (const Label& run : view_.study().runs) {
      double least = HUGE_VAL;
      std::size_t best = methods_.size();
      for (std::size_t k = 0; k < methods_.size(); ++k)
        if (const double* value = methods_[k].values.find(run.id);
            value != nullptr && sign * *value < least) {
          least = sign * *value;
          best = k;
        }
      if (best == methods_.size()) continue;
      ++wins[best];
      ++sets;
    }
    const auto most =
        std::ranges::max_element(wins, {}, [](const auto& each) { return each.second; });
    return fmt::format("{} has the {} {} on {} of {}", methods_[most->first].label,
                       sign > 0.0 ? "lowest" : "highest", in_sentence(quantity_.label),
                       most->second, counted(sets, "data set"));
  }

  const ResultsView& view_;
  const ResultsBlock& block_;
  const Quantity& quantity_;
  std::vector<OfMethod> methods_;
  std::optional<CrossedNames> crossed_;
};

/// Of the quantity that the study judges by first, over two data sets or more by two methods or
/// more.
std::optional<Figure> data_sets_figure(const ResultsView& view, const ResultsBlock& block) {
  const ResultsStudy& study = view.study();
  if (study.results.are_repeats || study.runs.size() < 2 || block.has_axis() ||
      block.conditions.size() != 1)
    return std::nullopt;
  for (const Quantity* quantity : view.quantities(block)) {
    if (!has_better_side(*quantity)) continue;
    const DataSetDots dots(view, block, *quantity);
    return dots.methods() < 2 ? std::nullopt : std::optional(dots.make());
  }
  return std::nullopt;
}

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
      if (std::ranges::none_of(spec.values, is_known)) continue;
      spec.title = fmt::format("{}, {}: {}", setup.label, line.label,
                               heat_map_finding(spec, in_sentence(quantity.label)));
      group.figures.push_back(heat_map_figure(spec));
    }
  }
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
    const std::vector<ErrorLine> curves = curves_of(view, block, quantity).lines;
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
  if (!view.has_groups_for_intervals() && view.lines(block, quantity).size() < 2)
    return fmt::format(
        "{}: there is no figure of the runs of one method, which are too few for a "
        "distribution.",
        quantity.label);
  return "";
}

std::string data_sets_figure_id(const ResultsBlock& block, const Quantity& quantity) {
  return figure_id(block.id, "data-sets-" + quantity.id);
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
