#include "core/model/experiment.hpp"

#include <array>

namespace mapproof {
namespace {

struct FitNames {
  std::string_view name;
  std::string_view label;
};

constexpr std::array kFits = {FitNames{"least_distances", "least distances"},
                              FitNames{"least_squares", "least squares"}};

constexpr std::array kKinds = {std::string_view("idea"), std::string_view("measurement"),
                               std::string_view("error_curve"), std::string_view("map")};

}  // namespace

std::string_view name(AffineFit fit) { return kFits[static_cast<std::size_t>(fit)].name; }

std::string_view label(AffineFit fit) { return kFits[static_cast<std::size_t>(fit)].label; }

std::string_view name(FigureKind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

const SensorStudy* find_sensor(const Experiment& experiment, Sensor sensor) {
  for (const SensorStudy& study : experiment.sensors)
    if (study.sensor.sensor == sensor) return &study;
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
