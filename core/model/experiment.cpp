#include "core/model/experiment.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr std::array kFactors = {
    FactorInfo{Factor::kNoise, "noise", false, 0.0, 1000.0, false},
    FactorInfo{Factor::kDropoutShare, "dropout_share", false, 0.0, 0.99, false},
    FactorInfo{Factor::kAnchors, "anchors", true, 3.0, 1000.0, false},
    FactorInfo{Factor::kSmacofFall, "smacof_relative_fall", false, 0.0, 1.0, false},
    FactorInfo{Factor::kSmacofKnnFall, "smacof_knn_relative_fall", false, 0.0, 1.0, false},
    FactorInfo{Factor::kOnlySeenTogether, "only_seen_together", true, 0.0, 1.0, false},
    FactorInfo{Factor::kSide, "side_m", false, 0.01, 1000.0, true},
    FactorInfo{Factor::kLandmarks, "landmarks", true, 4.0, 5000.0, true},
    FactorInfo{Factor::kDiameter, "landmark_diameter_m", false, 1e-6, 1000.0, true},
    FactorInfo{Factor::kReach, "reach_m", false, 1e-6, 1000.0, true},
    FactorInfo{Factor::kSteps, "steps", true, 3.0, 1e6, true},
};

struct FitNames {
  std::string_view name;
  std::string_view label;
};

constexpr std::array kFits = {FitNames{"least_distances", "least distances"},
                              FitNames{"least_squares", "least squares"}};

constexpr std::array kKinds = {std::string_view("idea"), std::string_view("measurement"),
                               std::string_view("error_curve"), std::string_view("map")};

}  // namespace

const FactorInfo& info(Factor factor) { return kFactors[static_cast<std::size_t>(factor)]; }

std::vector<std::string_view> factor_names() {
  std::vector<std::string_view> names;
  for (const FactorInfo& factor : kFactors)
    if (!factor.of_world) names.push_back(factor.name);
  return names;
}

void set_level(Experiment& experiment, Sensor sensor, Factor factor, double level) {
  const auto study = std::ranges::find(experiment.sensors, sensor,
                                       [](const SensorStudy& one) { return one.sensor.sensor; });
  if (study == experiment.sensors.end())
    throw InvalidInput("a level of a sensor that the experiment does not have");
  const auto whole = static_cast<int>(level);
  switch (factor) {
    case Factor::kNoise:
      study->sensor.noise = level;
      break;
    case Factor::kDropoutShare:
      study->sensor.dropout_share = level;
      break;
    case Factor::kAnchors:
      experiment.anchors = whole;
      break;
    case Factor::kSmacofFall:
      experiment.solver.smacof_relative_fall = level;
      break;
    case Factor::kSmacofKnnFall:
      experiment.solver.smacof_knn_relative_fall = level;
      break;
    case Factor::kOnlySeenTogether:
      experiment.solver.only_seen_together = level > 0.0;
      break;
    case Factor::kSide:
      experiment.world.side_m = level;
      break;
    case Factor::kLandmarks:
      experiment.world.landmarks = whole;
      break;
    case Factor::kDiameter:
      experiment.world.landmark_diameter_m = level;
      break;
    case Factor::kReach:
      if (sensor == Sensor::kVisibility)
        study->sensor.visual_angle_rad =
            2.0 * std::asin(std::min(1.0, experiment.world.landmark_diameter_m / 2.0 / level));
      else
        study->sensor.reach_m = level;
      break;
    case Factor::kSteps:
      study->checkpoints = {whole};
      break;
  }
}

std::string_view name(AffineFit fit) { return kFits[static_cast<std::size_t>(fit)].name; }

std::string_view label(AffineFit fit) { return kFits[static_cast<std::size_t>(fit)].label; }

std::string_view name(FigureKind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

const SensorStudy* find_sensor(const Experiment& experiment, Sensor sensor) {
  for (const SensorStudy& study : experiment.sensors)
    if (study.sensor.sensor == sensor) return &study;
  return nullptr;
}

std::string_view name(ExternalInput input) {
  constexpr std::array<std::string_view, 3> kNames = {"distances", "features", "history"};
  return kNames[static_cast<std::size_t>(input)];
}

Method method_of(const ExternalMethod& method) {
  return external_method({.name = method.name,
                          .label = method.label,
                          .source = method.source,
                          .symbol = method.symbol});
}

void add_external_methods(Experiment& experiment, const std::vector<ExternalMethod>& methods) {
  for (const ExternalMethod& method : methods) {
    experiment.external_methods.push_back(method);
    for (SensorStudy& study : experiment.sensors)
      study.methods.push_back({method_of(method), method.values});
  }
}

const ExternalMethod* find_external(const Experiment& experiment, Method method) {
  for (const ExternalMethod& external : experiment.external_methods)
    if (method_of(external) == method) return &external;
  return nullptr;
}

std::vector<MethodSetting> settings_of(const std::vector<MethodGrid>& grids) {
  std::vector<MethodSetting> settings;
  for (const MethodGrid& grid : grids) {
    if (grid.parameters.empty()) settings.push_back({grid.method, std::nullopt});
    for (const double parameter : grid.parameters) settings.push_back({grid.method, parameter});
  }
  return settings;
}

std::vector<MethodGrid> grids_of(const std::vector<MethodSetting>& settings) {
  std::vector<MethodGrid> grids;
  for (const MethodSetting& setting : settings) {
    if (grids.empty() || grids.back().method != setting.method)
      grids.push_back({setting.method, {}});
    if (setting.parameter) grids.back().parameters.push_back(*setting.parameter);
  }
  return grids;
}

std::vector<MethodSetting> settings_of(const SensorStudy& study) {
  return settings_of(study.methods);
}

}  // namespace mapproof
