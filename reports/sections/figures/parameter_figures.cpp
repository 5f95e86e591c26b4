#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "render/figures/error_by_parameter.hpp"
#include "reports/sections/figures/builders.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using Estimate = std::optional<MeanEstimate> SettingSummary::*;

ParameterLine parameter_line(const std::vector<SettingSummary>& values, Estimate estimate,
                             double PublishedValue::*printed) {
  const MethodInfo& method = info(values.front().setting.method);
  ParameterLine line;
  line.line.label = std::string(method.label);
  line.line.key = std::string(method.name);
  for (const SettingSummary& summary : values) {
    const auto& mean = summary.*estimate;
    const auto interval = interval_of(mean);
    line.line.x.push_back(*summary.setting.parameter);
    line.line.mean.push_back(mean ? mean->mean : kNan);
    line.line.low.push_back(interval ? interval->low : kNan);
    line.line.high.push_back(interval ? interval->high : kNan);
  }
  if (const SettingSummary* best = best_of(values))
    line.ours = ParameterValue{*best->setting.parameter, kNan};
  if (const auto& published = values.front().published; published && published->setting.parameter)
    line.published = ParameterValue{*published->setting.parameter, (*published).*printed};
  return line;
}

/// The group of that parameter, made if it is new.
ParameterGroup& group_of(const ParameterInfo& parameter, std::vector<ParameterGroup>& groups) {
  const std::string symbol(parameter.shown);
  const auto found = std::ranges::find(groups, symbol, &ParameterGroup::symbol);
  if (found != groups.end()) return *found;
  return groups.emplace_back(
      ParameterGroup{.symbol = symbol,
                     .title = fmt::format("{}: {}", symbol, parameter.meaning),
                     .scale = parameter.integer ? Scale::kLinear : Scale::kLog,
                     .whole = parameter.integer,
                     .methods = {}});
}

void add_figure(const SensorStudy& sensor, const std::vector<SettingSummary>& all, bool of_mpe,
                std::vector<Figure>& figures) {
  ErrorByParameterSpec spec;
  spec.id = fmt::format("parameter-{}-{}", of_mpe ? "mpe" : "moe", name(sensor.sensor.sensor));
  spec.title = fmt::format("{}: {} over the parameter", title_of(sensor.sensor.sensor),
                           of_mpe ? "MPE" : "MOE");
  if (!of_mpe) {
    spec.y_label = "MOE [%]";
    spec.quantity = "mean orientation error";
  }
  for (const MethodGrid& grid : sensor.methods) {
    std::vector<SettingSummary> values;
    for (const SettingSummary& summary : all)
      if (summary.setting.method == grid.method && summary.setting.parameter)
        values.push_back(summary);
    if (values.size() < 2 || best_of(values) == nullptr) continue;
    group_of(*info(grid.method).parameter, spec.groups)
        .methods.push_back(
            of_mpe ? parameter_line(values, &SettingSummary::mpe_m, &PublishedValue::mpe_m)
                   : parameter_line(values, &SettingSummary::moe_percent,
                                    &PublishedValue::moe_percent));
    for (const SettingSummary& value : values) spec.record_ids.push_back(source_of(value));
  }
  if (!spec.groups.empty()) figures.push_back(error_by_parameter_figure(spec));
}

}  // namespace

std::vector<Figure> parameter_figures(FigureSource& source) {
  std::vector<Figure> figures;
  for (const SensorStudy& sensor : source.study().experiment.sensors) {
    const auto all = summarize(source.study(), sensor, last_step(sensor));
    for (const bool of_mpe : {true, false}) add_figure(sensor, all, of_mpe, figures);
  }
  return figures;
}

}  // namespace mapproof
