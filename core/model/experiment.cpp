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

}  // namespace

std::string_view name(AffineFit fit) { return kFits[static_cast<std::size_t>(fit)].name; }

std::string_view label(AffineFit fit) { return kFits[static_cast<std::size_t>(fit)].label; }

std::optional<AffineFit> affine_fit_named(std::string_view name) {
  for (std::size_t i = 0; i < kFits.size(); ++i)
    if (kFits[i].name == name) return static_cast<AffineFit>(i);
  return std::nullopt;
}

std::vector<MethodSetting> settings_of(const SensorStudy& study) {
  std::vector<MethodSetting> settings;
  for (const MethodGrid& grid : study.methods) {
    if (grid.parameters.empty()) settings.push_back({grid.method, std::nullopt});
    for (const double parameter : grid.parameters) settings.push_back({grid.method, parameter});
  }
  return settings;
}

}  // namespace mapproof
