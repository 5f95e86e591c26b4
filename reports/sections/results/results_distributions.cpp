#include "reports/sections/results/results_distributions.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/median.hpp"
#include "core/base/text/unit_text.hpp"
#include "render/figures/curves/best_line.hpp"
#include "render/figures/curves/diverged.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/diagrams/value_dots.hpp"
#include "render/figures/score_text.hpp"
#include "reports/sections/results/results_conventions.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {
namespace {

/// A distribution over more runs has steps of several: 0.2 % is less than the width of a line.
constexpr std::size_t kMostSteps = 500;
/// Fewer different values have no distribution.
constexpr std::size_t kFewestValues = 3;

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
/// @param medians       Over the runs, of each line of the first panel.
/// @param great_errors  See ResultsView::has_great_errors().
std::string distribution_words(const std::vector<ErrorPanel>& panels,
                               const std::vector<double>& medians, const Quantity& quantity,
                               bool great_errors) {
  if (panels.size() != 1 || panels.front().lines.empty()) return quantity.label;
  const std::vector<ErrorLine>& lines = panels.front().lines;
  const auto words = [&](double value) { return value_words(value, quantity.unit, great_errors); };
  const std::string name = in_sentence(quantity.label);
  if (lines.size() == 1)
    return fmt::format("the median {} is {}, the greatest {}", name, words(medians.front()),
                       words(lines.front().x.back()));
  std::vector<ErrorLine> of_lines;
  for (std::size_t i = 0; i < lines.size(); ++i)
    of_lines.push_back(
        {.label = lines[i].label, .key = lines[i].key, .x = {0.0}, .mean = {medians[i]}});
  const LineQuantity of_medians{.label = "median " + name,
                                .unit = quantity.unit,
                                .lower_is_better = quantity.better != Better::kHigher,
                                .great_errors = great_errors};
  const std::string best = best_of_points({of_lines}, of_medians);
  return !has_better_side(quantity) || best.empty() ? quantity.label : best;
}

/// Ends the axes where no run diverged, if some did and others not.
/// @param values  Of all runs.
/// @return Those that the axes have.
std::vector<double> leave_out_diverged(std::vector<double> values, double divergence,
                                       std::vector<ErrorPanel>& panels) {
  const std::size_t all = values.size();
  values = without_diverged(std::move(values), divergence);
  if (values.size() == all) return values;
  if (const auto [least, greatest] = std::ranges::minmax(values); least < greatest)
    for (ErrorPanel& panel : panels) panel.x.limits = Range{least, greatest};
  return values;
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

/// The runs of one method at a level.
std::vector<double> numbers_of(const ResultsView& view, const Condition& at,
                               const ResultsLine& line, const Quantity& quantity) {
  std::vector<double> numbers;
  for (const auto& [run, value] : view.numbers(at, line, quantity).values) numbers.push_back(value);
  return numbers;
}

/// Dots of a block's methods, a panel per level, without title and caption.
/// @param dot  What a method with runs shows at a condition: of its line, without its name.
template <typename Dot>
ValueDotsSpec dots_of(const ResultsView& view, const ResultsBlock& block, const Quantity& quantity,
                      const Dot& dot) {
  ValueDotsSpec spec{.id = id_below(block.id, quantity.id),
                     .x_label = label_with_unit(quantity),
                     .unit = quantity.unit,
                     .higher_is_better = quantity.better == Better::kHigher,
                     .great_errors = view.has_great_errors(quantity),
                     .record_ids = {record_of(block)}};
  const std::vector<ResultsLine> lines = view.lines(block, quantity);
  for (std::size_t i = 0; i < block.conditions.size(); ++i) {
    ValueDotsPanel& panel = spec.panels.emplace_back();
    if (!block.factor.empty()) panel.title = view.level_words(block.levels[i]);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      if (view.numbers(block.conditions[i], lines[k], quantity).values.empty()) continue;
      MethodValue& method = panel.methods.emplace_back(dot(block.conditions[i], lines[k]));
      method.label = lines[k].label;
      method.key = key_of(k);
      method.series = lines[k].series;
    }
  }
  return spec;
}

/// Where no factor has numbers and the runs are too few for a distribution: each of them, a panel
/// per level. Of one method the table has as much.
std::optional<Figure> runs_figure(const ResultsView& view, const ResultsBlock& block,
                                  const Quantity& quantity) {
  if (view.lines(block, quantity).size() < 2) return std::nullopt;
  std::vector<double> medians;
  std::vector<ErrorLine> of_methods;
  ValueDotsSpec spec =
      dots_of(view, block, quantity, [&](const Condition& at, const ResultsLine& line) {
        MethodValue method{.runs = numbers_of(view, at, line, quantity)};
        medians.push_back(method.value = median(method.runs));
        of_methods.push_back({.label = line.label, .key = "", .x = {0.0}, .mean = {method.value}});
        return method;
      });
  if (medians.empty()) return std::nullopt;
  spec.caption = fmt::format(
      "Filled: the median {} of each method; circles: single runs, which are too few for a "
      "distribution.",
      in_sentence(quantity.label));
  medians = without_diverged(std::move(medians), divergence_in(quantity.unit, spec.great_errors));
  const auto [least, greatest] = std::ranges::minmax(medians);
  const auto words = [&](double median) { return lone_value(median, quantity, spec.great_errors); };
  const std::string diverged =
      diverged_words(of_methods, {.unit = quantity.unit, .great_errors = spec.great_errors});
  spec.title = fmt::format(
      "{}: {}", block.title,
      range_title(fmt::format("the median {} is between {} and {}", in_sentence(quantity.label),
                              words(least), words(greatest)),
                  diverged, has_better_side(quantity) ? kTooFewRuns : ""));
  return value_dots_figure(spec);
}

}  // namespace

/// Steps between two values would show nothing but a share, which the table has.
std::optional<Figure> distribution_figure(const ResultsView& view, const ResultsBlock& block,
                                          const Quantity& quantity) {
  if (!view.study().results.are_repeats || block.conditions.size() > kMostPanels ||
      !has_several_runs(view, block, quantity) || !has_different_values(view, block, quantity))
    return std::nullopt;
  if (!view.has_groups_for_intervals()) return runs_figure(view, block, quantity);
  ErrorLinesSpec spec;
  spec.id = id_below(block.id, quantity.id);
  spec.title = block.title + ": " + quantity.label;
  spec.y_label = "runs at or below [%]";
  spec.quantity = "share of runs whose " + quantity.label + " is at or below a value";
  spec.caption =
      fmt::format("Lines: the share of runs whose {} is at or below a value.", quantity.label);
  spec.record_ids = {record_of(block)};
  spec.log_from = HUGE_VAL;
  const std::vector<ResultsLine> lines = view.lines(block, quantity);
  const bool great_errors = view.has_great_errors(quantity);
  const double divergence = divergence_in(quantity.unit, great_errors);
  std::vector<double> values, medians;
  std::vector<DivergedCount> counts;
  for (const ResultsLine& line : lines) counts.push_back({.label = line.label});
  for (std::size_t i = 0; i < block.conditions.size(); ++i) {
    ErrorPanel& panel = spec.panels.emplace_back();
    if (!block.factor.empty()) panel.title = view.level_words(block.levels[i]);
    panel.x.label = label_with_unit(quantity);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const auto runs = view.numbers(block.conditions[i], lines[k], quantity).values;
      ErrorLine curve = distribution_of(runs);
      if (curve.x.empty()) continue;
      if (i == 0) medians.push_back(median_of(runs));
      for (const auto& [run, value] : runs) counts[k].see(value, divergence);
      values.insert(values.end(), curve.x.begin(), curve.x.end());
      curve.label = lines[k].label;
      curve.key = key_of(k);
      curve.series = lines[k].series;
      panel.lines.push_back(std::move(curve));
    }
  }
  note_diverged(counts, "in", "runs", spec.notes);
  values = leave_out_diverged(std::move(values), divergence, spec.panels);
  if (spans_widely(values))
    for (ErrorPanel& panel : spec.panels) panel.x.scale = Scale::kLog;
  spec.title = fmt::format("{}: {}", block.title,
                           distribution_words(spec.panels, medians, quantity, great_errors));
  return error_lines_figure(spec);
}

std::optional<Figure> means_figure(const ResultsView& view, const ResultsBlock& block,
                                   const Quantity& quantity) {
  if (block.conditions.size() > kMostPanels) return std::nullopt;
  const bool has_intervals = view.has_groups_for_intervals();
  ValueDotsSpec spec =
      dots_of(view, block, quantity, [&](const Condition& at, const ResultsLine& line) {
        MethodValue method{.value = view.mean(at, line, quantity)->mean};
        if (!has_intervals) method.runs = numbers_of(view, at, line, quantity);
        if (const auto spread = view.spread(at, line, quantity); spread && has_intervals)
          method.interval = Range{spread->low, spread->high};
        return method;
      });
  if (std::ranges::all_of(spec.panels, &std::vector<MethodValue>::empty, &ValueDotsPanel::methods))
    return std::nullopt;
  spec.ranked = false;
  spec.title = fmt::format("{}: {}", block.title, quantity.label);
  spec.caption =
      fmt::format("Filled: the mean {} over runs; {}.", in_sentence(quantity.label),
                  has_intervals ? "bars: its 95\u00A0% interval"
                                : "circles: single runs, which are too few for an interval");
  // Shares are seen as parts of a whole, with room for half a marker at both ends.
  if (quantity.unit == "%") spec.x_limits = Range{-3.0, 103.0};
  return value_dots_figure(spec);
}

std::string why_no_distribution(const ResultsView& view, const ResultsBlock& block,
                                const Quantity& quantity) {
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

}  // namespace mapproof
