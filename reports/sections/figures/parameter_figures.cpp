#include "reports/sections/figures/figure_builders.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/best_line.hpp"
#include "render/figures/curves/error_curve.hpp"
#include "reports/sections/figures/line_findings.hpp"
#include "reports/sections/figures/line_judgement.hpp"
#include "reports/sections/figures/method_styles.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

/// A map with an error of this many sides of the room carries no information but that it is wrong.
constexpr double kOffTheRoom = 10.0;

/// Of a parameter: two or three points are no curve, and the table has them.
constexpr std::size_t kFewestValues = 4;

using Estimate = std::optional<MeanEstimate> SettingSummary::*;

/// The index of a line's least value; its size if none is known.
std::size_t index_of_least(const ErrorLine& line) {
  std::size_t least = line.mean.size();
  for (std::size_t i = 0; i < line.mean.size(); ++i)
    if (std::isfinite(line.mean[i]) &&
        (least == line.mean.size() || line.mean[i] < line.mean[least]))
      least = i;
  return least;
}

/// The least errors of lines.
/// @param methods  Of the lines.
std::vector<PointOfSetting> least_points(const std::vector<Method>& methods,
                                         std::vector<ErrorLine>& lines) {
  std::vector<PointOfSetting> points;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (const std::size_t least = index_of_least(lines[i]); least < lines[i].x.size())
      points.push_back({&lines[i], least, {methods[i], lines[i].x[least]}});
  return points;
}

ParameterLine parameter_line(const Experiment& experiment,
                             const std::vector<SettingSummary>& values, Estimate estimate,
                             double PublishedValue::*printed) {
  const MethodInfo& method = info(values.front().setting.method);
  ParameterLine line;
  line.line.label = std::string(method.label);
  line.line.key = std::string(method.name);
  line.line.series = series_of_method(experiment, method.method);
  for (const SettingSummary& summary : values) {
    const auto& mean = summary.*estimate;
    const auto interval = interval_of(mean);
    line.line.x.push_back(*summary.setting.parameter);
    line.line.mean.push_back(mean ? mean->mean : kNaN);
    line.line.low.push_back(interval ? interval->low : kNaN);
    line.line.high.push_back(interval ? interval->high : kNaN);
  }
  if (const SettingSummary* best = best_of(values))
    line.ours = ParameterValue{*best->setting.parameter, kNaN};
  if (const auto& published = values.front().published; published && published->setting.parameter)
    line.published = ParameterValue{*published->setting.parameter, (*published).*printed};
  return line;
}

/// Which method is best, and at which value; where several are, how much they depend on it.
/// @param methods  Of the group's lines.
std::string finding_of(FigureSource& source, const SensorStudy& sensor, const ParameterGroup& group,
                       const std::vector<Method>& methods, bool of_mpe) {
  std::vector<ErrorLine> lines;
  for (const ParameterLine& method : group.methods) lines.push_back(method.line);
  judge(least_points(methods, lines), of_mpe ? &Score::mpe_m : &Score::moe_percent, sensor, source);
  const LineQuantity quantity = of_mpe ? LineQuantity{} : LineQuantity{"MOE", "%"};
  const std::string best = best_of_all(lines, quantity, {group.symbol});
  return best.empty() ? dependence_finding(lines, quantity, group.symbol, of_mpe) : best;
}

/// "; above 25 m at 8 of 9 values"; empty if none is above.
std::string above_words(const ParameterGroup& group, double ceiling_m) {
  std::ptrdiff_t above = 0, all = 0;
  for (const ParameterLine& method : group.methods) {
    all += std::ssize(method.line.mean);
    above += std::ranges::count_if(method.line.mean,
                                   [ceiling_m](double mean_m) { return mean_m > ceiling_m; });
  }
  return above == 0 ? ""
                    : fmt::format("; above {} m at {} of {} values", significant(ceiling_m, 2),
                                  above, all);
}

/// The figure of all methods with that parameter: methods of different ones err on different
/// scales. Empty if no method has enough values of it for a curve.
std::optional<Figure> parameter_figure(FigureSource& source, const SensorStudy& sensor,
                                       const std::vector<SettingSummary>& all,
                                       const ParameterInfo& parameter, bool of_mpe) {
  ParameterGroup group{
      .symbol = std::string(parameter.shown),
      .title = std::string(parameter.meaning),
      .scale = parameter.integer || parameter.minimum <= 0.0 ? Scale::kLinear : Scale::kLog,
      .whole = parameter.integer,
      .methods = {}};
  ErrorByParameterSpec spec;
  const std::string file_symbol = lower_case(std::string(parameter.symbol));
  spec.id = fmt::format("parameter-{}-{}-{}", of_mpe ? "mpe" : "moe", name(sensor.sensor.sensor),
                        file_symbol);
  spec.title = fmt::format("{}: {} over {}", title_of(sensor.sensor.sensor), of_mpe ? "MPE" : "MOE",
                           parameter.shown);
  if (!of_mpe) {
    spec.y_label = "MOE [%]";
    spec.quantity = "mean orientation error";
  }
  std::vector<Method> methods;
  for (const MethodGrid& grid : sensor.methods) {
    if (!info(grid.method).parameter || info(grid.method).parameter->symbol != parameter.symbol)
      continue;
    std::vector<SettingSummary> values;
    for (const SettingSummary& summary : all)
      if (summary.setting.method == grid.method && summary.setting.parameter)
        values.push_back(summary);
    if (values.size() < kFewestValues || best_of(values) == nullptr) continue;
    const Experiment& experiment = source.study().experiment;
    methods.push_back(grid.method);
    group.methods.push_back(
        of_mpe ? parameter_line(experiment, values, &SettingSummary::mpe_m, &PublishedValue::mpe_m)
               : parameter_line(experiment, values, &SettingSummary::moe_percent,
                                &PublishedValue::moe_percent));
    for (const SettingSummary& value : values) spec.record_ids.push_back(source_of(value));
  }
  if (group.methods.empty()) return std::nullopt;
  if (const std::string finding = finding_of(source, sensor, group, methods, of_mpe);
      !finding.empty())
    spec.title = fmt::format("{}: {}", title_of(sensor.sensor.sensor), finding);
  if (of_mpe) {
    spec.ceiling = kOffTheRoom * source.study().experiment.world.side_m;
    spec.title += above_words(group, spec.ceiling);
  }
  spec.groups.push_back(std::move(group));
  return error_by_parameter_figure(spec);
}

/// The parameters of the sensor's methods, each once.
std::vector<const ParameterInfo*> parameters_of(const SensorStudy& sensor) {
  std::vector<const ParameterInfo*> parameters;
  for (const MethodGrid& grid : sensor.methods)
    if (const auto& parameter = info(grid.method).parameter;
        parameter && std::ranges::find(parameters, parameter->symbol, &ParameterInfo::symbol) ==
                         parameters.end())
      parameters.push_back(&*parameter);
  return parameters;
}

}  // namespace

std::vector<Figure> parameter_figures(FigureSource& source) {
  std::vector<Figure> figures;
  for (const SensorStudy& sensor : source.study().experiment.sensors) {
    const auto all = summarize(source.study(), sensor, last_step(sensor));
    for (const ParameterInfo* parameter : parameters_of(sensor))
      for (const bool of_mpe : {true, false})
        if (auto figure = parameter_figure(source, sensor, all, *parameter, of_mpe))
          figures.push_back(std::move(*figure));
  }
  return figures;
}

}  // namespace mapproof
