#include "reports/sections/figures/figure_builders.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/best_line.hpp"
#include "render/figures/curves/error_curve.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/curves/level_curve.hpp"
#include "render/figures/curves/method_series.hpp"
#include "reports/sections/figures/line_findings.hpp"
#include "reports/sections/figures/line_judgement.hpp"
#include "reports/sections/figures/method_styles.hpp"
#include "reports/sections/run_scores.hpp"
#include "reports/sections/variation_summary.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

void add_point(ErrorLine& line, double x, const std::optional<MeanEstimate>& estimate) {
  const auto interval = interval_of(estimate);
  line.x.push_back(x);
  line.mean.push_back(estimate ? estimate->mean : kNaN);
  line.low.push_back(interval ? interval->low : kNaN);
  line.high.push_back(interval ? interval->high : kNaN);
}

ErrorLine line_over_levels(const Experiment& experiment, const Variation& variation,
                           const VariedSetting& setting) {
  ErrorLine line;
  line.label = label(setting.setting);
  line.key = lower_case(slug(setting.setting));
  line.series = series_of_method(experiment, setting.setting.method);
  std::ranges::replace(line.key, '.', '-');
  for (std::size_t i = 0; i < variation.levels.size(); ++i)
    add_point(line, shown_level(variation, variation.levels[i]), setting.mpe_m[i]);
  return line;
}

std::string record_of(const Variation& variation) {
  return fmt::format("variation {} of all runs, {} after {} observations", variation.id,
                     name(variation.sensor), variation.step);
}

/// Whether a variation tries several parameters of its methods.
bool has_grids(const Variation& variation) {
  return grids_of(variation.settings).size() < variation.settings.size();
}

std::string level_title(const Variation& variation, double level) {
  if (variation.factor == Factor::kOnlySeenTogether) return level_text(variation, level);
  return fmt::format("{}: {}", level_words(variation), level_text(variation, level));
}

bool is_of_fall(const Variation& variation) {
  return variation.factor == Factor::kSmacofKnnFall || variation.factor == Factor::kSmacofFall;
}

/// What a sentence calls the last level, "at 40° bearing noise", and the first, "at 0°".
std::pair<std::string, std::string> ends_of(const Variation& variation) {
  const double first = variation.levels.front(), last = variation.levels.back();
  if (variation.factor == Factor::kOnlySeenTogether)
    return {"with " + level_text(variation, last), "with " + level_text(variation, first)};
  const LineAxis axis = line_axis(level_words(variation));
  const auto value = [&](double level) {
    return with_unit(data_number(shown_level(variation, level)), axis.unit);
  };
  return {axis.unit.empty() ? fmt::format("at {} = {}", axis.name, value(last))
                            : fmt::format("at {} {}", value(last), axis.name),
          "at " + value(first)};
}

/// Has the lines of settings know how the paired test judges them at each level.
void judge_levels(const Study& study, const std::vector<VariedSetting>& settings,
                  std::vector<ErrorLine>& lines) {
  const GroupsByRun layouts = layouts_by_run(study);
  for (std::size_t level = 0; level < lines.front().x.size(); ++level) {
    std::vector<PointOfRuns> points;
    for (std::size_t i = 0; i < lines.size(); ++i)
      points.push_back({&lines[i], level, settings[i].mpe_by_run[level].by_run()});
    judge(std::move(points), layouts);
  }
}

/// What came out over the levels; empty if nothing did.
std::string level_finding(const Variation& variation, const std::vector<ErrorLine>& lines) {
  const LineAxis axis = line_axis(level_words(variation));
  if (std::string best = best_over(lines, {}, axis); !best.empty()) return best;
  const auto [last, first] = ends_of(variation);
  return change_finding(lines, {}, last, first);
}

/// "K" where all methods are tuned by it; "parameter" where they differ.
std::string parameter_words(const Variation& variation) {
  std::string words;
  for (const MethodSetting& setting : variation.settings) {
    const auto& parameter = info(setting.method).parameter;
    const std::string shown = parameter ? std::string(parameter->shown) : "parameter";
    if (!words.empty() && words != shown) return "parameter";
    words = shown;
  }
  return words;
}

/// Each method's least error over its parameter, over the levels, with its interval.
std::vector<ErrorLine> best_lines(const Variation& variation, const ErrorLinesSpec& spec) {
  std::vector<ErrorLine> lines;
  for (std::size_t level = 0; level < spec.panels.size(); ++level)
    for (std::size_t k = 0; k < spec.panels[level].lines.size(); ++k) {
      const ErrorLine& from = spec.panels[level].lines[k];
      if (lines.size() == k) lines.push_back({.label = from.label, .key = from.key});
      ErrorLine& line = lines[k];
      line.x.push_back(shown_level(variation, variation.levels[level]));
      std::size_t best = 0;
      for (std::size_t i = 1; i < from.mean.size(); ++i)
        if (!(from.mean[best] <= from.mean[i]) && !std::isnan(from.mean[i])) best = i;
      line.mean.push_back(from.mean[best]);
      line.low.push_back(from.low[best]);
      line.high.push_back(from.high[best]);
    }
  return lines;
}

/// A panel a method in place of one a level: what two levels change is seen within a panel.
std::vector<ErrorPanel> panels_of_methods(const std::vector<ErrorPanel>& levels) {
  std::vector<ErrorPanel> panels;
  for (std::size_t k = 0; k < levels.front().lines.size(); ++k) {
    ErrorPanel panel;
    panel.title = levels.front().lines[k].label;
    panel.x = levels.front().x;
    for (std::size_t level = 0; level < levels.size(); ++level) {
      ErrorLine line = levels[level].lines[k];
      line.label = levels[level].title;
      line.key += fmt::format("-{}", level + 1);
      line.series = series_of_methods({fmt::format("level-{}", level + 1)}).front();
      panel.lines.push_back(std::move(line));
    }
    panels.push_back(std::move(panel));
  }
  return panels;
}

/// Error over the parameter: a panel per level, or per method where there are two levels.
Figure grid_figure(const Study& study, const Variation& variation) {
  const std::vector<VariedSetting> settings = summarize(study, variation);
  ErrorLinesSpec spec;
  spec.id = "level-" + variation.id;
  spec.title = fmt::format("{}: MPE by {}", title_of(variation.sensor), level_words(variation));
  for (std::size_t level = 0; level < variation.levels.size(); ++level) {
    ErrorPanel panel;
    panel.title = level_title(variation, variation.levels[level]);
    panel.x = {.label = parameter_words(variation), .limits = {}};
    for (const MethodGrid& grid : grids_of(variation.settings)) {
      ErrorLine line;
      line.label = std::string(info(grid.method).label);
      line.key = std::string(info(grid.method).name);
      line.series = series_of_method(study.experiment, grid.method);
      for (const VariedSetting& setting : settings)
        if (setting.setting.method == grid.method)
          add_point(line, setting.setting.parameter.value_or(0.0), setting.mpe_m[level]);
      panel.lines.push_back(std::move(line));
    }
    spec.panels.push_back(std::move(panel));
  }
  const auto [last, first] = ends_of(variation);
  if (const std::string change = change_finding(best_lines(variation, spec), {}, last, first);
      !change.empty())
    spec.title = fmt::format(
        "{}{}: {}", title_of(variation.sensor),
        has_grids(variation) ? ", at each method\u2019s best " + parameter_words(variation) : "",
        change);
  spec.record_ids = {record_of(variation)};
  if (spec.panels.size() == 2) spec.panels = panels_of_methods(spec.panels);
  return error_lines_figure(spec);
}

/// Empty if there is nothing to be seen: of a method that the levels do not change, which its table
/// says.
std::optional<Figure> level_figure(const Study& study, const Variation& variation) {
  // The levels of a choice are names, which titles of panels show and an axis does not.
  if (has_grids(variation) || variation.factor == Factor::kOnlySeenTogether)
    return grid_figure(study, variation);
  const std::vector<VariedSetting> settings = summarize(study, variation);
  if (settings.size() == 1 && all_overlap(settings.front().mpe_m)) return std::nullopt;
  LevelCurveSpec spec;
  spec.id = "level-" + variation.id;
  spec.title = fmt::format("{}: MPE by {}", title_of(variation.sensor), level_words(variation));
  spec.x_label = level_words(variation);
  for (const VariedSetting& setting : settings)
    spec.methods.push_back(line_over_levels(study.experiment, variation, setting));
  if (!settings.empty()) judge_levels(study, settings, spec.methods);
  if (const std::string finding = level_finding(variation, spec.methods); !finding.empty())
    spec.title = fmt::format("{}: {}", title_of(variation.sensor), finding);
  spec.record_ids = {record_of(variation)};
  if (is_of_fall(variation) && variation.levels.front() > 0.0) spec.x_scale = Scale::kLog;
  return level_curve_figure(spec);
}

/// All placements of one sensor's anchors, one panel per method.
void add_anchors(const Study& study, Sensor sensor, std::vector<Figure>& figures) {
  AnchorCountSpec spec;
  spec.id = fmt::format("anchors-{}", name(sensor));
  spec.title = fmt::format("{}: MPE by number and placement of anchors", title_of(sensor));
  for (const Variation& variation : study.experiment.variations) {
    if (variation.sensor != sensor || variation.factor != Factor::kAnchors) continue;
    const AnchorPlacement placement =
        variation.placement.value_or(study.experiment.anchor_placement);
    for (const VariedSetting& setting : summarize(study, variation)) {
      const std::string title = label(setting.setting);
      auto panel = std::ranges::find(spec.panels, title, &AnchorPanel::title);
      if (panel == spec.panels.end()) panel = spec.panels.insert(panel, {title, {}});
      ErrorLine line = line_over_levels(study.experiment, variation, setting);
      line.label = std::string(name(placement));
      line.key = variation.id;
      line.series = series_of_methods({fmt::format("anchors-{}", name(placement))}).front();
      panel->placements.push_back(std::move(line));
    }
    spec.record_ids.push_back(record_of(variation));
  }
  if (spec.panels.empty()) return;
  if (const std::string finding = placement_finding(spec.panels); !finding.empty())
    spec.title = fmt::format("{}: {}", title_of(sensor), finding);
  figures.push_back(anchor_count_figure(spec));
}

}  // namespace

std::vector<Figure> condition_figures(FigureSource& source) {
  const Study& study = source.study();
  std::vector<Figure> figures;
  for (const SensorStudy& sensor : study.experiment.sensors)
    add_anchors(study, sensor.sensor.sensor, figures);
  for (const Variation& variation : study.experiment.variations)
    if (variation.factor != Factor::kAnchors)
      if (auto figure = level_figure(study, variation)) figures.push_back(std::move(*figure));
  return figures;
}

}  // namespace mapproof
