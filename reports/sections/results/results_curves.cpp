#include "reports/sections/results/results_curves.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/best_line.hpp"
#include "render/figures/curves/diverged.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/curves/level_curve.hpp"
#include "render/figures/curves/method_series.hpp"
#include "render/figures/score_text.hpp"
#include "render/figures/unit_scale.hpp"
#include "render/plot/layers.hpp"
#include "reports/sections/results/results_comparison.hpp"
#include "reports/sections/results/results_conventions.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {
namespace {

/// Of more lines some may hide others.
constexpr std::size_t kMostApart = 4;
constexpr const char* kSingleRuns = "single runs";
constexpr const char* kSingleRunsRemark =
    " Small circles: single runs, which are too few for an interval.";

/// Of levels: a 0 among them does not count, since no logarithmic axis has it.
bool spans_widely_above_0(std::vector<double> levels) {
  std::erase(levels, 0.0);
  return levels.size() > 1 && spans_widely(levels);
}

void drop_level_0(ErrorLine& line) {
  if (line.x.empty() || line.x.front() != 0.0) return;
  for (std::vector<double>* values : {&line.x, &line.mean, &line.low, &line.high})
    if (!values->empty()) values->erase(values->begin());
}

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

/// Whether both are known and equal, or neither is known.
bool are_same_means(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// Joins curves that are the same to one, in the style of the first: drawn each, the last would
/// hide the others.
void join_same(Curves& curves) {
  std::vector<ErrorLine> apart;
  for (const ErrorLine& first : curves.lines) {
    const auto is_same = [&](const ErrorLine& one) {
      return one.x == first.x && std::ranges::equal(one.mean, first.mean, are_same_means);
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

/// The curves of a block, those without a value left out, and those of many that are the same
/// joined. Of few groups of runs, or more than can have bars, they have no bands.
Curves curves_of(const ResultsView& view, const ResultsBlock& block, const Quantity& quantity) {
  const std::vector<ResultsLine> lines = view.lines(block, quantity);
  const bool is_log = scale_of(block.levels) == Scale::kLog;
  Curves curves;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    ErrorLine curve = curve_of(view, block, quantity, lines[i], i);
    if (std::ranges::none_of(curve.mean, is_known)) continue;
    if (is_log) drop_level_0(curve);
    curves.lines.push_back(std::move(curve));
  }
  if (is_distance_from_another(quantity))
    curves.lacks_compared_with = drop_compared_with(curves.lines);
  if (lines.size() > kMostApart) join_same(curves);
  curves.has_bands = curves.lines.size() <= kMostBars && view.has_groups_for_intervals();
  return curves;
}

/// Says where intervals are that have no room in a figure; nothing where there are none.
std::optional<Note> intervals_note(const ResultsView& view, const Curves& curves) {
  const auto has_interval = [](const ErrorLine& line) {
    return std::ranges::any_of(line.low, is_known);
  };
  if (curves.has_bands || !view.has_groups_for_intervals() ||
      std::ranges::none_of(curves.lines, has_interval))
    return std::nullopt;
  return Note{
      fmt::format("The table has the 95\u00A0% intervals, for which {} lines leave no room.",
                  curves.lines.size()),
      ThemeColour::kMuted};
}

/// In a unit in which the values of the curves need no power of ten.
/// @param great_errors  See ResultsView::has_great_errors(): what diverged asks for no unit.
/// @return The quantity with that unit.
Quantity scale_to_unit(const Quantity& quantity, bool great_errors, Curves& curves,
                       std::vector<ErrorPoint>& points) {
  double greatest = 0.0;
  const auto for_each_value = [&](std::vector<ErrorLine>& lines, auto&& visit) {
    for (ErrorLine& line : lines)
      for (std::vector<double>* values : {&line.mean, &line.low, &line.high})
        for (double& value : *values) visit(value);
    for (ErrorPoint& point : points) visit(point.y);
  };
  const double most = divergence_in(quantity.unit, great_errors);
  std::vector<ErrorLine> shown_lines = drawn(curves);
  for_each_value(shown_lines, [&](double& value) {
    if (std::abs(value) <= most) greatest = std::max(greatest, std::abs(value));
  });
  const ScaledUnit unit = scaled_unit(quantity, greatest);
  for_each_value(curves.lines, [&](double& value) { value *= unit.factor; });
  return in_unit(quantity, unit);
}

/// Whether repeated runs are too few for intervals: titles then rank no methods.
bool has_too_few_runs(const ResultsView& view) {
  return view.study().results.are_repeats && !view.has_groups_for_intervals();
}

/// Has the lines know how the paired tests that sentences state judge them at each level.
void judge_by_pairs(const ResultsView& view, const ResultsBlock& block, const Quantity& quantity,
                    std::vector<ErrorLine>& curves) {
  if (!view.study().results.are_repeats || has_too_few_runs(view) || !has_better_side(quantity) ||
      curves.size() < 2)
    return;
  const std::vector<ResultsLine> lines = view.lines(block, quantity);
  for (ErrorLine& curve : curves) curve.paired.assign(curve.x.size(), PairedWithBest::kUntested);
  for (std::size_t i = 0; i < block.levels.size(); ++i) {
    const auto comparison = compare_at(view, block, quantity, block.conditions[i]);
    if (!comparison || !has_groups_for_tests(*comparison)) continue;
    for (const ComparedMethod& method : comparison->methods) {
      const auto line = std::ranges::find(lines, method.method, &ResultsLine::index);
      const auto curve = std::ranges::find(
          curves, key_of(static_cast<std::size_t>(line - lines.begin())), &ErrorLine::key);
      if (curve == curves.end()) continue;  // Joined with another, or without a value.
      const auto at = std::ranges::find(curve->x, std::get<double>(block.levels[i].value));
      if (at == curve->x.end()) continue;
      curve->paired[static_cast<std::size_t>(at - curve->x.begin())] =
          judgement_of(*comparison, method.method);
    }
  }
}

/// Which method is best over the axis; empty of too few runs, and of a quantity that has no better
/// side.
/// @param great_errors  See ResultsView::has_great_errors().
std::string finding_of(const ResultsView& view, const Curves& curves, const Quantity& quantity,
                       bool great_errors, const std::string& x_label) {
  if (has_too_few_runs(view) || !has_better_side(quantity) || curves.lines.size() < 2) return "";
  return best_over(curves.lines,
                   {.label = in_sentence(quantity.label),
                    .unit = quantity.unit,
                    .lower_is_better = quantity.better == Better::kLower,
                    .plural = curves.joined,
                    .great_errors = great_errors},
                   line_axis(x_label));
}

/// The known values of one line in the words shown. What differs less than the words and the
/// intervals show counts as the same.
struct KnownValues {
  const ErrorLine& line;
  std::vector<std::size_t> at = {};  ///< Indices in the line.
  std::vector<std::string> words = {};

  double value(std::size_t i) const { return line.mean[at[i]]; }
  bool differ(std::size_t i, std::size_t k) const {
    return words[i] != words[k] && !intervals_overlap(line, at[i], at[k]);
  }
  /// Whether no value from the one to the other goes back.
  bool are_steady(std::size_t first, std::size_t last) const {
    const double sign = value(last) < value(first) ? -1.0 : 1.0;
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t k = i + 1; k <= last; ++k)
        if (sign * (value(k) - value(i)) < 0.0 && differ(i, k)) return false;
    return true;
  }
};

/// How a line with known values goes from the first x to the last: that it falls or rises if it
/// does so all the way, or up to one turn, which is named; else between which values it goes.
/// @param place  An x in words.
template <typename Place>
std::string course_of_one(const KnownValues& known, const Place& place) {
  const std::size_t last = known.at.size() - 1;
  const auto index_of = [&](auto better) {
    std::size_t best = 0;
    for (std::size_t i = 1; i <= last; ++i)
      if (better(known.value(i), known.value(best))) best = i;
    return best;
  };
  const std::size_t least = index_of(std::less<>()), most = index_of(std::greater<>());
  const auto is_turn = [&](std::size_t i) { return known.differ(i, 0) && known.differ(i, last); };
  const std::string &from = known.words.front(), &to = known.words.back();
  if (known.words[least] == known.words[most]) return "stays at " + from;
  if (!is_turn(least) && !is_turn(most)) {
    if (!known.differ(0, last))
      return fmt::format("has no clear trend, {} and {} at the ends", from, to);
    if (known.are_steady(0, last))
      return fmt::format("{} from {} to {}", known.value(last) < known.value(0) ? "falls" : "rises",
                         from, to);
  } else if (is_turn(least) != is_turn(most)) {
    const bool falls = is_turn(least);
    const std::size_t turn = falls ? least : most;
    if (known.are_steady(0, turn) && known.are_steady(turn, last))
      return fmt::format("{} from {} to {} at {}, then {} to {}", falls ? "falls" : "rises", from,
                         known.words[turn], place(known.line.x[known.at[turn]]),
                         falls ? "rises" : "falls", to);
  }
  return fmt::format("goes from {} to {}, between {} and {}", from, to, known.words[least],
                     known.words[most]);
}

/// What lines do where none of them is called the best: of one, see course_of_one(); of several,
/// between which values they lie, which diverged and why they are not ranked; of tiny distances,
/// how much they are at most; of what is aimed at, the aim. Empty if nothing is known.
/// @param unit         Of the lines' values.
/// @param great_errors  See ResultsView::has_great_errors().
/// @param x_label      Of the axis of one line.
/// @param not_ranked   Why; kNoneIsBest or kTooFewRuns of one panel.
std::string course_of(const std::vector<ErrorLine>& lines, const Quantity& quantity,
                      const std::string& unit, bool great_errors, const std::string& x_label,
                      const std::string& not_ranked) {
  std::vector<double> known;
  for (const ErrorLine& line : lines)
    std::ranges::copy_if(line.mean, std::back_inserter(known), is_known);
  if (known.empty()) return "";
  const auto words = [&](double value) { return value_words(value, unit, great_errors); };
  if (is_tiny_distance(quantity))
    return fmt::format("{} is at most {}", in_sentence(quantity.label),
                       words(std::ranges::max(known)));
  if (lines.size() == 1) {
    KnownValues values{lines.front()};
    for (std::size_t i = 0; i < values.line.mean.size(); ++i)
      if (is_known(values.line.mean[i])) {
        values.at.push_back(i);
        values.words.push_back(words(values.line.mean[i]));
      }
    const auto place = [&](double x) {
      return x_text(line_axis(x_label), x, {.label = quantity.label, .unit = unit});
    };
    return in_sentence(quantity.label) + " " + course_of_one(values, place);
  }
  known = without_diverged(std::move(known), divergence_in(unit, great_errors));
  const std::string diverged = diverged_words(lines, {.unit = unit, .great_errors = great_errors});
  const auto [least, greatest] = std::ranges::minmax(known);
  const Quantity shown = in_unit(quantity, {unit});
  const std::string low = lone_value(least, shown, great_errors),
                    high = lone_value(greatest, shown, great_errors);
  const std::string span = low == high ? low : fmt::format("between {} and {}", low, high);
  if (const auto aim = aim_of(quantity))
    return fmt::format("{} {}, aimed at {}", in_sentence(quantity.label), span,
                       with_unit(data_number(*aim), unit));
  return range_title(in_sentence(quantity.label) + " " + span, diverged,
                     has_better_side(quantity) ? not_ranked : "");
}

/// The label of the curve that shows a line; empty if none does.
std::string label_of_curve(const Curves& curves, const std::string& line) {
  const auto joined = curves.joined_by_first.find(line);
  const std::string& label = joined == curves.joined_by_first.end() ? line : joined->second;
  return std::ranges::find(curves.lines, label, &ErrorLine::label) == curves.lines.end() ? ""
                                                                                         : label;
}

/// Calls `visit` for each point of the curves, with the curve's label, x, and the values of the
/// runs that it is the mean of.
template <typename Visit>
void for_each_point(const ResultsView& view, const ResultsBlock& block, const Quantity& quantity,
                    const Curves& curves, const Visit& visit) {
  const bool is_log = scale_of(block.levels) == Scale::kLog;
  for (const ResultsLine& line : view.lines(block, quantity)) {
    const std::string label = label_of_curve(curves, line.label);
    if (label.empty()) continue;
    for (std::size_t i = 0; i < block.levels.size(); ++i)
      if (const double x = std::get<double>(block.levels[i].value); !is_log || x != 0.0)
        visit(label, x, view.numbers(block.conditions[i], line, quantity).values);
  }
}

/// The values of the runs that the curves are means of, if these are too few for intervals; none
/// of more curves than have styles of their own.
std::vector<ErrorPoint> runs_of(const ResultsView& view, const ResultsBlock& block,
                                const Quantity& quantity, const Curves& curves) {
  std::vector<ErrorPoint> points;
  if (view.has_groups_for_intervals() || curves.lines.size() > kMethodStyles) return points;
  for_each_point(view, block, quantity, curves,
                 [&](const std::string& label, double x, const ValuesByRun& values) {
                   if (values.size() < 2) return;
                   for (const auto& [run, value] : values)
                     points.push_back({.label = kSingleRuns,
                                       .line = label,
                                       .x = x,
                                       .y = value,
                                       .marker = Marker::kCircle,
                                       .size = 0.6});
                 });
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

/// From which greatest over least mean the y axis is logarithmic. Shares never have such an axis,
/// nor has what is 0 in half the runs of a point, as a difference from the best often is.
double log_from(const ResultsView& view, const ResultsBlock& block, const Quantity& quantity,
                const Curves& curves) {
  bool are_above_0 = true;
  for_each_point(view, block, quantity, curves,
                 [&](const std::string& /*label*/, double /*x*/, const ValuesByRun& values) {
                   const auto above = std::ranges::count_if(
                       values, [](const auto& run) { return run.second > 0.0; });
                   are_above_0 = are_above_0 && (values.empty() || 2 * above > std::ssize(values));
                 });
  return quantity.unit == "%" || !are_above_0 ? HUGE_VAL : LevelCurveSpec{}.log_from;
}

/// Which method is best at most of the points of several panels, see best_of_points(). Empty of too
/// few runs, and of a quantity that has no better side.
/// @param joined  Labels of lines that are several.
std::string most_often_best(const ResultsView& view,
                            const std::vector<std::vector<ErrorLine>>& panels,
                            const Quantity& quantity, const std::vector<std::string>& joined) {
  if (has_too_few_runs(view) || !has_better_side(quantity)) return "";
  return best_of_points(panels, {.label = in_sentence(quantity.label),
                                 .unit = quantity.unit,
                                 .lower_is_better = quantity.better == Better::kLower,
                                 .plural = joined,
                                 .great_errors = view.has_great_errors(quantity)});
}

/// What the lines of several panels do where none is the best: see course_of().
/// @param x_label  Of the first panel.
std::string course_over(const ResultsView& view, const std::vector<std::vector<ErrorLine>>& panels,
                        const Quantity& quantity, const std::string& x_label) {
  std::vector<ErrorLine> all;
  bool has_rivals = false;
  for (const std::vector<ErrorLine>& lines : panels) {
    all.insert(all.end(), lines.begin(), lines.end());
    has_rivals = has_rivals || lines.size() > 1;
  }
  return course_of(all, quantity, quantity.unit, view.has_great_errors(quantity), x_label,
                   !has_rivals              ? ""
                   : has_too_few_runs(view) ? kTooFewRuns
                                            : "no method is clearly the best at most points");
}

}  // namespace

std::optional<Figure> curve_figure(const ResultsView& view, const ResultsBlock& block,
                                   const Quantity& quantity) {
  LevelCurveSpec spec;
  spec.id = id_below(block.id, quantity.id);
  spec.x_label = view.factor_label(block.factor);
  spec.x_scale = scale_of(block.levels);
  spec.quantity = quantity.label;
  spec.great_errors = view.has_great_errors(quantity);
  spec.has_runs = view.runs() > 1;
  spec.record_ids = {record_of(block)};
  Curves curves = curves_of(view, block, quantity);
  if (!distinguishes(curves.lines)) return std::nullopt;
  spec.points = runs_of(view, block, quantity, curves);
  const Quantity shown = scale_to_unit(quantity, spec.great_errors, curves, spec.points);
  spec.y_label = label_with_unit(shown);
  if (!spec.points.empty()) spec.remark = kSingleRunsRemark;
  judge_by_pairs(view, block, quantity, curves.lines);
  std::string finding = is_tiny_distance(quantity)
                            ? ""
                            : finding_of(view, curves, shown, spec.great_errors, spec.x_label);
  if (finding.empty())
    finding = course_of(curves.lines, quantity, shown.unit, spec.great_errors, spec.x_label,
                        view.has_groups_for_intervals() ? kNoneIsBest : kTooFewRuns);
  spec.title = fmt::format("{}: {}", block.title, finding.empty() ? quantity.label : finding);
  spec.log_from = log_from(view, block, quantity, curves);
  const std::optional<Note> of_intervals = intervals_note(view, curves);
  spec.methods = drawn(std::move(curves));
  Figure figure = level_curve_figure(spec);
  if (of_intervals) figure.notes.push_back(*of_intervals);
  add_sample_of_runs(figure.panels.front(), spec.points);
  if (const auto aim = aim_of(quantity)) add_aim(figure.panels.front(), *aim, spec.methods);
  if (spec.x_scale == Scale::kLog && std::get<double>(block.levels.front().value) == 0.0)
    figure.caption += " The table has the level 0, which a logarithmic axis has not.";
  if (curves.lacks_compared_with)
    figure.caption += " What the others are compared with is at 0 and has no line.";
  return figure;
}

std::optional<Figure> overview_figure(const ResultsView& view, const ResultsOverview& overview,
                                      const Quantity& quantity) {
  const bool has_axes = std::ranges::all_of(overview.blocks, &ResultsBlock::has_axis);
  if (!has_axes || overview.blocks.size() > kMostPanels) return std::nullopt;
  ErrorLinesSpec spec;
  spec.id = id_below(overview.id, quantity.id);
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
    judge_by_pairs(view, block, quantity, judged.emplace_back(curves.lines));
    panel.lines = drawn(curves);
    if (const auto note = intervals_note(view, curves); note && spec.notes.empty())
      spec.notes.push_back(*note);
    joined.insert(joined.end(), curves.joined.begin(), curves.joined.end());
    panel.points = runs_of(view, block, quantity, curves);
    spec.log_from = std::max(spec.log_from, log_from(view, block, quantity, curves));
    if (!panel.points.empty()) spec.remark = kSingleRunsRemark;
  }
  if (std::ranges::all_of(spec.panels, [](const ErrorPanel& panel) { return panel.lines.empty(); }))
    return std::nullopt;
  std::string finding = most_often_best(view, judged, quantity, joined);
  if (finding.empty()) finding = course_over(view, judged, quantity, spec.panels.front().x.label);
  spec.title =
      finding.empty()
          ? fmt::format("{}: {}", overview.title, quantity.label)
          : fmt::format("{}: {}", overview.title.substr(0, overview.title.find(": ")), finding);
  spec.over = fmt::format(" over {} by {}", view.factor_label(overview.blocks.front()->factor),
                          overview.factors);
  Figure figure = error_lines_figure(spec);
  // The label of equal axes stands once, with more room.
  figure.shared_x = std::ranges::all_of(overview.blocks, [&](const ResultsBlock* block) {
    return block->levels == overview.blocks.front()->levels;
  });
  for (std::size_t i = 0; i < spec.panels.size(); ++i)
    add_sample_of_runs(figure.panels[i], spec.panels[i].points);
  return figure;
}

namespace {

/// The levels of a block at which any of the curves has a value.
std::vector<Level> levels_with_values(const ResultsBlock& block,
                                      const std::vector<ErrorLine>& curves) {
  std::vector<Level> levels;
  for (const Level& level : block.levels) {
    const double x = std::get<double>(level.value);
    const auto has_value = [&](const ErrorLine& curve) {
      for (std::size_t i = 0; i < curve.x.size(); ++i)
        if (curve.x[i] == x && is_known(curve.mean[i])) return true;
      return false;
    };
    if (std::ranges::any_of(curves, has_value)) levels.push_back(level);
  }
  return levels;
}

}  // namespace

std::string why_no_curve(const ResultsView& view, const ResultsBlock& block,
                         const Quantity& quantity) {
  const std::vector<ErrorLine> curves = curves_of(view, block, quantity).lines;
  if (curves.empty())
    return fmt::format("{}: there is no curve, since no run gave a value.", quantity.label);
  if (distinguishes(curves)) return "";
  const std::string value = value_words(*std::ranges::find_if(curves.front().mean, is_known),
                                        quantity.unit, view.has_great_errors(quantity));
  const bool are_repeats = view.study().results.are_repeats;
  const std::string what = are_repeats ? "mean" : "value";
  const std::string of_all = curves.size() == 1 ? ""
                             : are_repeats      ? ", for every method"
                                                : ", for every method and run";
  const std::vector<Level> levels = levels_with_values(block, curves);
  if (levels.size() == 1 && block.levels.size() > 1)
    return fmt::format(
        "{}: there is no curve, since one level alone has values ({}): the {} is {}{}.",
        quantity.label, view.level_words(levels.front()), what, value, of_all);
  std::vector<std::string> places;
  for (const Level& level : levels) places.push_back(view.level_words(level));
  constexpr std::size_t kMostNamed = 4;
  return fmt::format(
      "{}: there is no curve, since the {} is {} at {}{}.", quantity.label, what, value,
      levels.size() == block.levels.size() ? "every level" : listed(places, kMostNamed), of_all);
}

}  // namespace mapproof
