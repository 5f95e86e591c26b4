#include "reports/sections/results/results_data_sets.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/diverged.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/curves/method_series.hpp"
#include "render/figures/layer_shapes.hpp"
#include "reports/sections/results/results_conventions.hpp"

namespace mapproof {
namespace {

/// The names of methods that are crossed with something else, as "Bearing, ISOMAP", taken apart.
struct CrossedNames {
  std::vector<std::string> firsts, seconds;  ///< Of all of the study, in its order, each once.
  std::vector<std::pair<std::size_t, std::size_t>> names;  ///< Both parts of each label.
};

using Parts = std::pair<std::string, std::string>;

std::optional<Parts> parts_of(const std::string& label) {
  const std::size_t comma = label.find(", ");
  if (comma == std::string::npos || comma == 0 || comma + 2 == label.size()) return std::nullopt;
  return Parts{label.substr(0, comma), label.substr(comma + 2)};
}

std::size_t index_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

/// Whether one of them occurs twice.
bool any_repeats(const std::vector<std::string>& names) {
  return std::set<std::string>(names.begin(), names.end()).size() < names.size();
}

/// Empty unless every label has two parts with a comma between, one second part stands behind
/// several first ones, and one first part before several second ones, with no more parts than
/// labels.
/// @param labels    Those that are shown.
/// @param of_study  All of the study, those shown among them.
std::optional<CrossedNames> crossed_names(const std::vector<std::string>& labels,
                                          const std::vector<std::string>& of_study) {
  std::vector<Parts> shown;
  std::vector<std::string> firsts, seconds;
  for (const std::string& label : labels) {
    const auto parts = parts_of(label);
    if (!parts) return std::nullopt;
    shown.push_back(*parts);
    firsts.push_back(parts->first);
    seconds.push_back(parts->second);
  }
  if (!any_repeats(firsts) || !any_repeats(seconds)) return std::nullopt;
  CrossedNames crossed;
  for (const std::string& label : of_study) {
    const auto parts = parts_of(label);
    if (!parts) continue;
    if (index_of(crossed.firsts, parts->first) == crossed.firsts.size())
      crossed.firsts.push_back(parts->first);
    if (index_of(crossed.seconds, parts->second) == crossed.seconds.size())
      crossed.seconds.push_back(parts->second);
  }
  std::set<std::size_t> first_parts, second_parts;
  for (const auto& [first, second] : shown) {
    crossed.names.emplace_back(index_of(crossed.firsts, first), index_of(crossed.seconds, second));
    first_parts.insert(crossed.names.back().first);
    second_parts.insert(crossed.names.back().second);
  }
  if (first_parts.size() + second_parts.size() > labels.size()) return std::nullopt;
  return crossed;
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
    const std::vector<double> all = values();
    const Scale scale =
        spans_widely(without_diverged(all, divergence())) ? Scale::kLog : Scale::kLinear;
    const DotAxis axis = dot_axis(all, scale, divergence());
    for (std::size_t k = 0; k < methods_.size(); ++k) add_dots(k, axis, panel);
    add_crossed_legend(panel);
    note_diverged(count_diverged(), "in", "data sets", figure.notes);
    panel.x.limits = Range{-0.5, static_cast<double>(view_.study().runs.size()) - 0.5};
    for (const Label& run : view_.study().runs) panel.x.names.push_back(run.label);
    panel.y = {.label = label_with_unit(quantity_), .scale = scale, .limits = axis.limits};
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

  double divergence() const {
    return divergence_in(quantity_.unit, view_.has_great_errors(quantity_));
  }

  /// Of all methods in all data sets.
  std::vector<double> values() const {
    std::vector<double> all;
    for (const OfMethod& method : methods_)
      for (const auto& [run, value] : method.values) all.push_back(value);
    return all;
  }

  std::vector<DivergedCount> count_diverged() const {
    std::vector<DivergedCount> counts;
    for (const OfMethod& method : methods_) {
      DivergedCount& count = counts.emplace_back(DivergedCount{.label = method.label});
      for (const auto& [run, value] : method.values) count.see(value, divergence());
    }
    return counts;
  }

  /// A method's dots, and triangles for what diverged.
  void add_dots(std::size_t k, const DotAxis& axis, Panel& panel) const {
    constexpr double kTaken = 0.7;  // Of the distance between two data sets.
    const SeriesStyle style = style_of(k);
    const double middle = (static_cast<double>(methods_.size()) - 1.0) / 2.0;
    const double aside =
        kTaken * (static_cast<double>(k) - middle) / static_cast<double>(methods_.size());
    Scatter dots{
        .label = crossed_ ? "" : methods_[k].label, .colour = style.colour, .marker = style.marker};
    Scatter diverged = diverged_dots(style.colour);
    const std::vector<Label>& runs = view_.study().runs;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const double* value = methods_[k].values.find(runs[i].id);
      if (value == nullptr) continue;
      const double x = static_cast<double>(i) + aside;
      Mark mark{fmt::format("{}-set-{}", key_of(k), i + 1),
                {{"curve", methods_[k].label},
                 {"points", fmt::format("{}, {}", runs[i].label, data_number(*value))}}};
      const bool has_diverged = *value > axis.ceiling;
      if (has_diverged) mark.data.emplace_back("over", data_number(axis.ceiling));
      Scatter& at = has_diverged ? diverged : dots;
      add_point(at, {x, axis.place_of(*value)});
      at.marks.push_back(std::move(mark));
    }
    if (dots.x.empty() && !diverged.x.empty()) dots.x = dots.y = {kNaN};  // For the legend.
    for (Scatter* some : {&dots, &diverged})
      if (!some->x.empty()) panel.layers.emplace_back(std::move(*some));
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

}  // namespace

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

std::string data_sets_figure_id(const ResultsBlock& block, const Quantity& quantity) {
  return id_below(block.id, "data-sets-" + quantity.id);
}

}  // namespace mapproof
