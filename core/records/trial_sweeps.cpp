#include "core/records/trial_sweeps.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/records/experiment_values.hpp"
#include "core/records/json_values.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostSweeps = 100;
constexpr std::size_t kMostSweptFactors = 2;

SweptLevels read_levels(const SweptFactor& factor, const JsonCursor& array) {
  SweptLevels swept{.factor = std::string(factor.name), .levels = {}};
  swept.levels = read_ascending<double>(array, [&](const JsonCursor& item) {
    const double level = item.number(factor.minimum(), factor.maximum);
    if (info(factor.factor).integer && level != std::floor(level)) item.fail("expected an integer");
    return level;
  });
  return swept;
}

Sweep read_sweep(const JsonCursor& object) {
  std::vector<std::string_view> names;
  for (const SweptFactor& factor : swept_factors()) names.push_back(factor.name);
  object.allow_only(names);
  Sweep sweep;
  for (const auto& [name, levels] : object.members())
    sweep.push_back(read_levels(*swept_factor_named(name), levels));
  if (sweep.empty() || sweep.size() > kMostSweptFactors)
    object.fail(fmt::format("expected one factor or two, got {}", sweep.size()));
  return sweep;
}

/// "landmarks = 50, side_m = 0.1".
std::string text_of(const Sweep& sweep, const std::vector<double>& levels) {
  std::string text;
  for (std::size_t i = 0; i < sweep.size(); ++i)
    text += fmt::format("{}{} = {:g}", i == 0 ? "" : ", ", sweep[i].factor, levels[i]);
  return text;
}

/// Every combination of a sweep's levels, the first factor's outermost.
std::vector<std::vector<double>> combinations_of(const Sweep& sweep) {
  std::vector<std::vector<double>> all = {{}};
  for (const SweptLevels& swept : sweep) {
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& levels : all)
      for (const double level : swept.levels) {
        longer.push_back(levels);
        longer.back().push_back(level);
      }
    all = std::move(longer);
  }
  return all;
}

void check_sweep(const TrialExperiment& experiment, const Sweep& sweep, const JsonCursor& object) {
  bool has_sensor = false;
  for (const SensorStudy& sensor : experiment.sensors) {
    if (!has_factors(sensor.sensor.sensor, sweep)) continue;
    has_sensor = true;
    for (const std::vector<double>& levels : combinations_of(sweep))
      if (const std::string problem = run_problem(at_levels(experiment, sensor, sweep, levels));
          !problem.empty())
        object.fail(text_of(sweep, levels) + ": " + problem);
  }
  if (!has_sensor) object.fail("no sensor of the experiment has these factors");
}

}  // namespace

void read_sweeps(const JsonCursor& document, TrialExperiment& experiment) {
  experiment.sensors = read_sensors(document.at("sensors"), experiment.steps);
  const JsonCursor sweeps = document.at("sweeps");
  for (const JsonCursor& item : sweeps.elements(1, kMostSweeps))
    experiment.sweeps.push_back(read_sweep(item));
  for (std::size_t i = 0; i < experiment.sweeps.size(); ++i)
    check_sweep(experiment, experiment.sweeps[i], sweeps.element(i));
}

void put_sweeps(nlohmann::ordered_json& value, const TrialExperiment& experiment) {
  if (experiment.sweeps.empty()) return;
  value["sensors"] = sensors_value(experiment.sensors, experiment.steps);
  value["sweeps"] = nlohmann::ordered_json::array();
  for (const Sweep& sweep : experiment.sweeps) {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    for (const SweptLevels& swept : sweep)
      for (const double level : swept.levels) object[swept.factor].push_back(number_value(level));
    value["sweeps"].push_back(std::move(object));
  }
}

}  // namespace mapproof
